#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/figures/work-precision.png from the table in docs/accuracy/perturbed-rotation.md."""

import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Series in the picture: name in the table, label, colour (Okabe and Ito), marker, line.
SERIES = [
    ("Adaptive", "Adaptive", "#0072B2", "o", "-"),
    ("VariationOfConstants", "VariationOfConstants", "#D55E00", "s", "-"),
    ("Splitting order4", "Splitting, order 4", "#999999", "v", "-"),
    ("Splitting ABA864", "Splitting, ABA864", "#009E73", "^", "-"),
    ("Splitting order8", "Splitting, order 8", "#000000", "D", "-"),
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
    figure, axes = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
    for name, label, colour, marker, line in SERIES:
        points = [(s, e) for method, _, s, e in table if method == name or method.startswith(name + " ") and name == "heyoka"]
        if not points:
            raise SystemExit(f"work_precision.py: no rows of {name}")
        seconds, errors = zip(*points)
        axes.loglog(seconds, errors, line, color=colour, marker=marker, markersize=5, linewidth=1.2, label=label)
    axes.set_xlabel("CPU time of one thread (s)")
    axes.set_ylabel("final attitude error (rad)")
    axes.set_ylim(1e-13, 10)
    axes.grid(True, which="major", linewidth=0.3)
    axes.legend(fontsize=7.5, loc="upper right")
    axes.set_title("W1: 1000 orbits, 62 000 rad of rotation", fontsize=10)
    figure.savefig(ROOT / "docs/figures/work-precision.png", dpi=150, metadata={"Software": None})


if __name__ == "__main__":
    main()
