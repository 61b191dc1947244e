#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/figures/satellite-stability.png from runs.

    tools/figures/satellite_stability.py PROGRAM [CELLS ORBITS]

PROGRAM is examples/satellite_stability.cpp, compiled. Needs the Python package (PYTHONPATH)."""

import pathlib
import subprocess
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
from polhode import figures  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]


def borders(axes):
    """The borders of the linear theory, where they are borders of a stable region."""
    line = np.linspace(0, 1, 2)
    style = {"color": "black", "linestyle": "-", "linewidth": 1.2}
    axes.plot(line, line, **style)  # I1 = I2: pitch
    axes.plot([0, 1], [0, 0], **style)  # k_yaw = 0
    axes.plot([1, 1], [0, 1], **style)
    # b = 4 sqrt(c) for k_roll, k_yaw < 0: with s = sqrt(k_roll k_yaw), 1 + 3 k_roll + s^2 = 4 s
    s = np.linspace(0, 1, 20001)[1:]
    k_roll = (4 * s - 1 - s * s) / 3
    with np.errstate(divide="ignore"):
        k_yaw = s * s / k_roll
    there = (k_roll < 0) & (k_yaw >= -1) & (k_yaw < k_roll)
    axes.plot(k_roll[there], k_yaw[there], **style)
    axes.plot([0, 0], [-1, 0], **style)  # k_roll = 0
    corner = k_roll[there][np.argmin(k_yaw[there])] if there.any() else 0
    axes.plot([corner, 0], [-1, -1], **style)
    diagonal = k_roll[there].min()
    axes.plot([diagonal, 0], [diagonal, 0], **style)


def main():
    program, *grid = sys.argv[1:]
    cells, orbits = grid or ("120", "60")
    ran = subprocess.run([program, cells, orbits], check=True, stdout=subprocess.PIPE, text=True)
    rows = np.array([line.split(",") for line in ran.stdout.splitlines()[1:]], dtype=float)
    n = int(cells)
    tilt = rows[:, 2].reshape(n, n).T  # rows of k_yaw, columns of k_roll
    with figures.style.style():
        axes = drawn(tilt, orbits)
    figures.save(axes, ROOT / "docs/figures/satellite-stability.png")


def drawn(tilt, orbits):
    axes = figures.style.axes_or_new(None, 0.75 * figures.DOUBLE_COLUMN, 3.8)
    limits = {"vmin": -3, "vmax": np.log10(0.5)}
    image = axes.imshow(np.log10(tilt), origin="lower", extent=(-1, 1, -1, 1), **limits)
    borders(axes)
    axes.set_xlabel(r"$k_\mathrm{roll} = (I_3 - I_1)/I_2$")
    axes.set_ylabel(r"$k_\mathrm{yaw} = (I_3 - I_2)/I_1$")
    axes.text(0.62, 0.25, "Lagrange", ha="center", color="white")
    arrow = {"arrowstyle": "->"}
    axes.annotate("DeBra & Delp", (-0.03, -0.6), (-0.75, -0.75), arrowprops=arrow)
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.8, aspect=15)
    bar.set_ticks(np.log10([1e-3, 1e-2, 1e-1, 0.5]), labels=["0.001", "0.01", "0.1", "0.5 or more"])
    bar.set_label(f"largest tilt within {orbits} orbits (rad)")
    return axes


if __name__ == "__main__":
    main()
