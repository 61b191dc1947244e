# SPDX-License-Identifier: MIT
"""Libration of Mercury: a century, and the part that is driven once per revolution."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
REVOLUTION = 87.9693496  # d

run = polhode.load(EXAMPLES / "mercury.toml").run()
libration = 3600 * np.degrees(np.unwrap(np.radians(run["phi"] + run["psi"])))
periods = [5800, *(REVOLUTION / k for k in range(1, 5))]
fit = polhode.analysis.harmonic_fit(
    run.t, libration, periods, degree=0, adjust=[True, False, False, False, False]
)
angle = 2 * np.pi * run.t / fit.periods[0]
free = fit.polynomial[0] + fit.cosine[0] * np.cos(angle) + fit.sine[0] * np.sin(angle)

with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.36 * figures.DOUBLE_COLUMN)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, layout="constrained")
    left.plot(run.t / 365.25, libration / 60, **figures.series(0).line)
    left.set_xlabel("time (yr)")
    left.set_ylabel("libration (arcmin)")
    first = run.t < 8 * REVOLUTION
    right.plot(run.t[first], (libration - free)[first], **figures.series(0).line)
    right.set_xlabel("time (d)")
    right.set_ylabel("driven part (arcsec)")
    for ax in (left, right):
        ax.margins(x=0)
figures.save(figure, "mercury.png")
