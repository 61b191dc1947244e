#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/figures/yorp.png: YORP of random convex bodies against the obliquity.

    tools/figures/yorp.py [BODIES]

Needs the Python package (PYTHONPATH) and SciPy."""

import pathlib
import sys

import matplotlib
import numpy as np
from scipy.spatial import ConvexHull

matplotlib.use("Agg")
import polhode  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402
from polhode import figures  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEGREES = np.linspace(0, 180, 73)


def stone(draw, corners=24):
    """The convex hull of points on an ellipsoid."""
    x = draw.normal(size=(corners, 3))
    x *= [1.2, 1, 0.8] / np.linalg.norm(x, axis=1, keepdims=True)
    hull = ConvexHull(x)
    a, b, c = x[hull.simplices.T]
    outward = np.sum(np.cross(b - a, c - a) * hull.equations[:, :3], axis=1) > 0
    faces = np.where(outward[:, None], hull.simplices, hull.simplices[:, ::-1])
    return polhode.shape.FacetShape(x, faces)


def torques(shape):
    """Along the spin axis and towards larger obliquity, over the cube of the size."""
    mass = polhode.shape.mass_properties(shape, 1.0)
    shortest = np.linalg.eigh(mass.inertia)[1][:, 2]
    surface = polhode.Surface.of_shape(shape, mass.centre, emitted=1.0)
    size = np.cbrt(3 * mass.volume / (4 * np.pi))
    return polhode.shape.yorp_torque(surface, np.radians(DEGREES), axis=shortest)[:, :2] / size**3


def main():
    draw = np.random.default_rng(1)
    bodies = np.array([torques(stone(draw)) for _ in range(int((sys.argv[1:] or ["200"])[0]))])
    o = np.radians(DEGREES)
    # over the strength of the term of degree 2, by least squares over both components
    terms = np.column_stack([1.5 * np.cos(o) ** 2 - 0.5, np.sin(o) * np.cos(o)])
    strength = np.sum(bodies * terms, axis=(1, 2)) / np.sum(terms**2)
    strong = np.abs(strength) > 0.2 * np.median(np.abs(strength))
    scaled = bodies[strong] / strength[strong, None, None]
    with figures.style.style():
        figures.save(drawn(scaled, terms), ROOT / "docs/figures/yorp.png")


def drawn(scaled, terms):
    size = (figures.DOUBLE_COLUMN, 0.38 * figures.DOUBLE_COLUMN)
    figure, panels = plt.subplots(1, 2, figsize=size, layout="constrained")
    labels = ("spin torque", "obliquity torque")
    for k, (axes, label) in enumerate(zip(panels, labels)):
        low, middle, high = np.percentile(scaled[:, :, k], [16, 50, 84], axis=0)
        axes.axhline(0, color=figures.style.GREY, linewidth=0.6)
        pale = {"color": figures.style.SKY, "linewidth": 0.4, "linestyle": "-"}
        axes.plot(DEGREES, scaled[:40, :, k].T, **pale)
        blue = {"color": figures.style.BLUE, "linestyle": "-"}
        axes.plot(DEGREES, np.array([low, high]).T, linewidth=0.9, **blue)
        axes.plot(DEGREES, middle, linewidth=1.8, label="median of all", **blue)
        black = {"color": figures.style.BLACK, "linestyle": "--", "linewidth": 1.4}
        axes.plot(DEGREES, terms[:, k], label="first term of the series", **black)
        axes.set_ylim(-1.1, 1.6)
        axes.set_xticks(range(0, 181, 30))
        axes.set_xlabel("obliquity (deg)")
        axes.set_ylabel(label + " (scaled)")
        axes.margins(x=0)
    panels[0].legend(loc="upper center")
    return figure


if __name__ == "__main__":
    main()
