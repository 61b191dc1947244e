# SPDX-License-Identifier: MIT
"""The Moon near its Cassini state: the pole in axes that turn with the node, and the longitude."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
NODE = -0.0529537919  # deg/d

run = polhode.load(EXAMPLES / "moon.toml").run()
pole = np.degrees(np.sin(np.radians(run["I_f"])))
angle = np.radians(run["h_f"] - NODE * run.t)
longitude = np.degrees(np.unwrap(np.radians(run["phi"] + run["psi"])))
longitude -= longitude.mean()

with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.4 * figures.DOUBLE_COLUMN)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, layout="constrained")
    x, y = pole * np.cos(angle), pole * np.sin(angle)
    left.plot(x, y, ".", ms=0.6, mec="none", color=figures.style.BLACK)
    left.plot(x.mean(), y.mean(), "+", color=figures.style.VERMILLION, ms=10, mew=1.5)
    left.set_aspect("equal", adjustable="datalim")
    left.set_xlabel("obliquity, towards the node of the orbit (deg)")
    left.set_ylabel("across (deg)")
    first = run.t < 12 * 365.25
    right.plot(run.t[first] / 365.25, longitude[first], **figures.series(0).line)
    right.set_xlabel("time (yr)")
    right.set_ylabel("libration in longitude (deg)")
    right.margins(x=0)
figures.save(figure, "moon.png")
