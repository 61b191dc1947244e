# SPDX-License-Identifier: MIT
"""Nutation of a rigid Earth over two turns of the Moon's node, and the path of its pole."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
PUBLISHED = -17.2806, 9.2279  # arcsec, REN-2000: longitude and obliquity, 18.6 yr

run = polhode.load(EXAMPLES / "earth.toml").run()
year = run.t / 365.25
psi = 3600 * (180 - np.degrees(np.unwrap(np.radians(run["h_f"]))))
eps = 3600 * run["I_f"]
node, sun = (
    np.radians([[125.04455501], [280.46646]]) + np.radians([[-19.341361849], [360.0076983]]) * year
)
arguments = [node, 2 * node, sun, 2 * sun]
columns = [np.ones_like(year), year, *(f(x) for x in arguments for f in (np.cos, np.sin))]
curves = np.column_stack([psi, eps])
fit = np.linalg.lstsq(np.column_stack(columns), curves, rcond=None)[0]
in_longitude, in_obliquity = (curves - fit[0] - np.outer(year, fit[1])).T
tilt = np.radians(eps.mean() / 3600)

with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.42 * figures.DOUBLE_COLUMN)
    figure, (left, right) = plt.subplots(
        1, 2, figsize=size, layout="constrained", width_ratios=(3, 2)
    )
    left.plot(2000 + year, in_longitude, "-", lw=0.8, color=figures.style.BLUE, label="longitude")
    left.plot(2000 + year, in_obliquity, "-", lw=0.8, color=figures.style.VERMILLION,
              label="obliquity")  # fmt: skip
    left.set_xlabel("year")
    left.set_ylabel("nutation (arcsec)")
    left.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    left.margins(x=0)
    right.plot(in_longitude * np.sin(tilt), in_obliquity, linewidth=0.5,
               color=figures.style.SKY, label="the pole")  # fmt: skip
    turn = np.linspace(0, 2 * np.pi, 200)
    right.plot(PUBLISHED[0] * np.sin(turn) * np.sin(tilt), PUBLISHED[1] * np.cos(turn),
               color=figures.style.BLACK, label="18.6 yr alone, REN-2000")  # fmt: skip
    right.set_aspect("equal", adjustable="datalim")
    right.set_xlabel("in longitude, times sine of obliquity (arcsec)")
    right.set_ylabel("in obliquity (arcsec)")
    right.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
figures.save(figure, "earth.png")
