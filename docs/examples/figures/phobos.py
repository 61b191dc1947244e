# SPDX-License-Identifier: MIT
"""Libration of Phobos, next to the direction to Mars."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"

scenario = polhode.load(EXAMPLES / "phobos.toml")
run = scenario.run()
orbit = scenario.orbits["mars"]
first = run.t <= 24
t = run.t[first]
libration = (run["phi"] + run["psi"] + 180)[first] % 360 - 180
x, y, _ = orbit.position(t).T
even = orbit.mean_motion * t
mars = np.degrees(np.angle((x + 1j * y) * np.exp(-1j * even)))

with figures.style.style():
    size = (figures.SINGLE_COLUMN, 2.4)
    figure, ax = plt.subplots(figsize=size, layout="constrained")
    ax.plot(t, libration, label="long axis", **figures.series(0).line)
    ax.plot(t, mars, label="Mars", **figures.series(1).line)
    ax.set_xlabel("time (h)")
    ax.set_ylabel("ahead of the even turn (deg)")
    ax.margins(x=0)
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
figures.save(figure, "phobos.png")
