# SPDX-License-Identifier: MIT
"""Hyperion: rate of spin, tilt, and how two runs part that begin almost alike."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
TEXT = (EXAMPLES / "hyperion.toml").read_text(encoding="utf-8")
N = 360 / 21.277  # deg/d: the mean motion
MORE = "30.000000001"  # deg


def run(omega, theta="30"):
    text = TEXT.replace("[0, 0, 22.0]", f"[0, 0, {omega}]")
    return polhode.Scenario.from_text(text.replace("theta = 30", f"theta = {theta}")).run()


def parted(omega):
    """Times, and the angle (rad) between the attitudes of two runs."""
    one, other = run(omega), run(omega, MORE)
    q, p = one.groups["q"], other.groups["q"]
    apart = np.minimum(np.linalg.norm(q - p, axis=1), np.linalg.norm(q + p, axis=1))
    return one.t, 4 * np.arcsin(apart / 2)


tumbling = run(22.0)
first = tumbling.t < 400
t = tumbling.t[first]

with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.42 * figures.DOUBLE_COLUMN)
    figure = plt.figure(figsize=size, layout="constrained")
    axes = figure.subplot_mosaic([["spin", "parted"], ["tilt", "parted"]])
    rate = np.linalg.norm(tumbling.groups["omega"][first], axis=1) / N
    axes["spin"].plot(t, rate, **figures.series(0).line)
    axes["spin"].set_ylabel("turns per revolution")
    axes["tilt"].plot(t, tumbling["theta"][first], **figures.series(0).line)
    axes["tilt"].set_ylabel("tilt (deg)")
    axes["tilt"].set_ylim(0, 180)
    axes["tilt"].set_yticks([0, 90, 180])
    axes["tilt"].set_xlabel("time (d)")
    axes["spin"].tick_params(labelbottom=False)
    for k, (omega, label) in enumerate(((22.0, "tumbling"), (60.0, "regular"))):
        times, angle = parted(omega)
        axes["parted"].semilogy(times, angle, label=label, **figures.series(k).line)
    axes["parted"].set_ylim(1e-12, 10)
    axes["parted"].set_xlim(0, 1200)
    axes["parted"].set_xlabel("time (d)")
    axes["parted"].set_ylabel("two attitudes apart (rad)")
    axes["parted"].legend(loc="center right")
    for name in ("spin", "tilt"):
        axes[name].margins(x=0)
figures.save(figure, "hyperion.png")
