#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/figures/work-precision.png from the table in docs/accuracy/perturbed-rotation.md.

Needs the Python package (PYTHONPATH)."""

import pathlib

import matplotlib

matplotlib.use("Agg")
from polhode import figures  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Series in the picture: name in the table, label, colour (Okabe and Ito), marker, line.
SERIES = [
    ("Adaptive", "Adaptive", "#0072B2", "o", "-"),
    ("VariationOfConstants", "VariationOfConstants", "#D55E00", "s", "-"),
    ("Collocation", "Collocation", "#000000", "P", "-"),
    ("Splitting order4", "Splitting, order 4", "#999999", "v", "-"),
    ("Splitting ABA864", "Splitting, ABA864", "#009E73", "^", "-"),
    ("Splitting order8", "Splitting, order 8", "#666666", "D", "-"),
    ("Boost.Odeint RKF78", "Boost.Odeint RKF78", "#56B4E9", "x", "--"),
    ("Boost.Odeint Bulirsch-Stoer", "Boost.Odeint Bulirsch-Stoer", "#E69F00", "+", "--"),
    ("heyoka", "heyoka (Taylor, compiled)", "#CC79A7", "*", "--"),
]


def rows():
    """(method, tolerance or step, seconds, error) of the first table of the page."""
    page = (ROOT / "docs/accuracy/perturbed-rotation.md").read_text(encoding="utf-8")
    for line in page.split("\n## ")[0].splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and len(cells) >= 4:
            try:
                yield cells[0], cells[1], float(cells[2]), float(cells[3])
            except ValueError:
                continue


def main():
    table = list(rows())
    with figures.style.style():
        axes = figures.style.axes_or_new(None, 0.8 * figures.DOUBLE_COLUMN, 3.7)
        for name, label, colour, marker, line in SERIES:
            points = [row[2:] for row in table if named(row[0], name)]
            if not points:
                raise SystemExit(f"work_precision.py: no rows of {name}")
            look = {"color": colour, "marker": marker, "markersize": 4, "label": label}
            axes.loglog(*zip(*points), line, **look)
        axes.set_xlabel("CPU time of one thread (s)")
        axes.set_ylabel("final attitude error (rad)")
        axes.set_ylim(1e-13, 10)
        axes.grid(True, which="major")
        axes.legend(loc="upper right", frameon=True, edgecolor="none")
        axes.set_title("W1: 1000 orbits, 62 000 rad of rotation")
    figures.save(axes, ROOT / "docs/figures/work-precision.png")


def named(method, name):
    """heyoka's rows also say how it was compiled."""
    return method == name or (name == "heyoka" and method.startswith("heyoka "))


if __name__ == "__main__":
    main()
