# SPDX-License-Identifier: MIT
"""Envisat over a year: period of the spin, and angle of its momentum from minus the normal."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
NODE, NODE_RATE, INCLINATION = np.radians(196.5510), np.radians(0.9819795), np.radians(98.4303)


def from_normal(run):
    """Angle (deg) of the angular momentum from minus the normal of the orbit."""
    tilt, longitude = np.arccos(run["H"] / run["G"]), np.radians(run["h"])
    node = NODE + NODE_RATE * run.t / 86400
    cosine = np.sin(tilt) * np.sin(INCLINATION) * np.cos(longitude - node)
    return np.degrees(np.arccos(-cosine - np.cos(tilt) * np.cos(INCLINATION)))


run = polhode.load(EXAMPLES / "envisat.toml").run()
days = run.t / 86400
period = 360 / np.linalg.norm(run.groups["omega"], axis=1)

with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.4 * figures.DOUBLE_COLUMN)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, layout="constrained")
    left.plot(days, period, label="this run", **figures.series(0).line)
    seen = period[0] * np.exp(4.5095e-4 * days)
    left.plot(days, seen, label="observed (Lin and Zhao 2018)", **figures.series(1).line)
    left.set_ylabel("period of the spin (s)")
    left.legend(loc="upper left")
    right.plot(days, from_normal(run), **figures.series(0).line)
    right.set_ylabel("momentum from minus the normal (deg)")
    for axes in (left, right):
        axes.set_xlabel("time (d)")
        axes.margins(x=0)
figures.save(figure, "envisat.png")
