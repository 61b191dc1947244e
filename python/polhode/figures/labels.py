# SPDX-License-Identifier: MIT
"""Where labels go: next to what they name, clear of the lines and of one another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.text import Text
from numpy.typing import ArrayLike, NDArray

HALO = [patheffects.withStroke(linewidth=2.0, foreground="white")]


@dataclass(frozen=True)
class Label:
    """A text, the point (2,) that it names, and the side (2,) of the point where it is best."""

    text: str
    anchor: NDArray[np.float64]
    outward: NDArray[np.float64]
    color: str = "black"

    def half_size(self, em: float) -> NDArray[np.float64]:
        """Half width and half height: TeX commands and braces count as one letter or none."""
        letters = sum(c.isalnum() for c in self.text.replace("\\mathbf", "").replace("\\", " "))
        plain = len(self.text) if "$" not in self.text else (1 if "\\" in self.text else letters)
        return np.array([0.5 * em * (0.55 * max(plain, 1) + 0.25), 0.5 * em])


def candidates(label: Label, em: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places (n, 2) round the anchor, and what each costs: distance, and the wrong side."""
    angle, radius = np.meshgrid(
        np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False),
        em * np.array([0.75, 0.95, 1.2, 1.5, 1.9]),
    )
    ray = np.stack([np.cos(angle).ravel(), np.sin(angle).ravel()], axis=-1)
    side = label.outward / max(float(np.linalg.norm(label.outward)), 1e-12)
    cost = 0.35 * (radius.ravel() - radius.min()) + 0.12 * em * (1.0 - ray @ side)
    return label.anchor + radius.ravel()[:, None] * ray, cost


def clearance(
    places: NDArray[np.float64], half: NDArray[np.float64], obstacles: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distance (n,) from boxes about `places` to the nearest obstacle: negative when inside."""
    if len(obstacles) == 0:
        return np.full(len(places), np.inf)
    gap = np.abs(places[:, None, :] - obstacles[None, :, :]) - half
    return np.min(np.max(gap, axis=-1), axis=-1)


def place(labels: list[Label], obstacles: ArrayLike, em: float) -> list[NDArray[np.float64]]:
    """A place (2,) for the centre of each label. em: height of the text; obstacles (n, 2): points
    of the lines drawn, closer together than half an em. Labels listed first choose first."""
    obstacles = np.asarray(obstacles, dtype=float)
    obstacles = obstacles[np.all(np.isfinite(obstacles), axis=-1)]
    boxes: list[tuple[NDArray[np.float64], NDArray[np.float64]]] = []
    for label in labels:
        half = label.half_size(em)
        places, cost = candidates(label, em)
        reach = half + 2.5 * em  # farther obstacles touch no candidate
        near = obstacles[np.all(np.abs(obstacles - label.anchor) < reach, axis=-1)]
        lines = np.minimum(clearance(places, half, near), 0.25 * em)
        texts = np.full(len(places), 0.3 * em)
        for centre, other in boxes:
            texts = np.minimum(texts, clearance(places, half + other, centre[None, :]))
        best = int(np.argmax(lines + 4.0 * np.minimum(texts, 0.3 * em) - cost))
        boxes.append((places[best], half))
    return [centre for centre, _ in boxes]


def write(
    ax: Axes, labels: list[Label], obstacles: ArrayLike, em: float, fontsize: float = 9.0
) -> list[Text]:
    """Places the labels and draws them, each on a white halo."""
    return [
        ax.text(
            *centre,
            label.text,
            color=label.color,
            fontsize=fontsize,
            ha="center",
            va="center",
            zorder=8.0,
            path_effects=HALO,
        )
        for label, centre in zip(labels, place(labels, obstacles, em))
    ]
