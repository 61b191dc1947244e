# SPDX-License-Identifier: MIT
"""Nutation of Mars: the run, and the first-order formula integrated along the orbit."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
GM, A, E = 132712440041.94 * 86400**2, 1.52371034 * 149597870.7, 0.0934  # km, d
H, SPIN, TILT, PERIHELION = 0.00538017, *np.radians([350.89198226, 25.1893, 251])
YEARS = 2 * np.pi * np.sqrt(A**3 / GM) / 365.25 / np.arange(1, 5)  # a Martian one, and parts of it


def theory(day):
    """Node and inclination (arcsec) by quadrature along the orbit."""
    elements = polhode.KeplerElements(GM, pericentre=A * (1 - E), eccentricity=E)
    x, y, _ = polhode.KeplerOrbit(elements).position(day).T
    strength = 3 * GM / np.hypot(x, y) ** 3 * H / SPIN
    longitude = np.arctan2(y, x) + PERIHELION
    rates = np.array([
        -strength * np.cos(TILT) * np.sin(longitude) ** 2,
        -strength / 2 * np.sin(TILT) * np.sin(2 * longitude),
    ])  # fmt: skip
    steps = (rates[:, 1:] + rates[:, :-1]) / 2 * np.diff(day)
    return 3600 * np.degrees(np.insert(np.cumsum(steps, axis=1), 0, 0, axis=1)).T


def nutation(day, curves):
    """What is left of node and inclination without their drift."""
    fit = polhode.analysis.harmonic_fit(day / 365.25, curves, YEARS)
    return curves - fit.polynomial[0] - fit.polynomial[1] * (day / 365.25)[:, None]


run = polhode.load(EXAMPLES / "mars.toml").run()
node = np.degrees(np.unwrap(np.radians(run["h_f"])))
found = nutation(run.t, 3600 * np.column_stack([node, run["I_f"]]))
fine = np.linspace(0, run.t[-1], 20001)
formula = nutation(fine, theory(fine))

with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.36 * figures.DOUBLE_COLUMN)
    figure, panels = plt.subplots(1, 2, figsize=size, layout="constrained")
    for k, (ax, label) in enumerate(zip(panels, ("node (arcsec)", "inclination (arcsec)"))):
        ax.plot(run.t / 365.25, found[:, k], label="run", **figures.series(0).line)
        ax.plot(fine[::400] / 365.25, formula[::400, k], "o", ms=2.5, label="formula",
                color=figures.style.VERMILLION)  # fmt: skip
        ax.set_xlabel("time (yr)")
        ax.set_ylabel(label)
        ax.margins(x=0)
    panels[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
figures.save(figure, "mars.png")
