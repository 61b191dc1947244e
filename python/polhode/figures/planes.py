# SPDX-License-Identifier: MIT
"""Discs through one centre that cut and hide one another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from polhode.figures.arrows import turned
from polhode.figures.view import View


@dataclass(frozen=True)
class Disc:
    """The unit disc about the origin with this unit normal (3,)."""

    normal: NDArray[np.float64]
    fill: str

    def start(self) -> NDArray[np.float64]:
        """Some unit vector in the plane."""
        across = np.cross(self.normal, np.eye(3)[np.argmin(np.abs(self.normal))])
        return across / np.linalg.norm(across)

    def rim(self, count: int = 361) -> NDArray[np.float64]:
        return turned(self.normal, self.start(), np.linspace(0.0, 2.0 * np.pi, count))

    def hides(self, view: View, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """True where the ray from a point (n, 3) to the eye goes through the disc."""
        slope = self.normal @ view.toward
        if abs(slope) < 1e-9:
            return np.zeros(len(points), dtype=bool)
        s = -(points @ self.normal) / slope
        through = points + s[:, None] * view.toward
        return (s > 1e-7) & (np.sum(through * through, axis=-1) < 1.0)

    def sectors(self, others: list[Disc], count: int = 60) -> list[NDArray[np.float64]]:
        """The disc cut along the planes of the others: polygons (n, 3) that cross none of them."""
        first = self.start()
        second = np.cross(self.normal, first)
        cuts: set[float] = set()
        for other in others:
            line = np.cross(self.normal, other.normal)
            if np.linalg.norm(line) > 1e-9:
                angle = float(np.arctan2(line @ second, line @ first)) % np.pi
                cuts |= {angle, angle + np.pi}
        edges = sorted(cuts or {0.0})
        edges.append(edges[0] + 2.0 * np.pi)
        centre = np.zeros((1, 3))
        return [
            np.concatenate([centre, turned(self.normal, first, np.linspace(a, b, count))])
            for a, b in zip(edges[:-1], edges[1:])
        ]


def hidden(view: View, discs: list[Disc], points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """True where any of the discs hides a point (n, 3)."""
    return np.any([disc.hides(view, points) for disc in discs], axis=0)


def back_to_front(view: View, discs: list[Disc]) -> list[tuple[NDArray[np.float64], Disc]]:
    """Sectors of all discs in the order of painting: what is behind a plane comes before it."""
    pieces = [
        (sector, disc)
        for disc in discs
        for sector in disc.sectors([other for other in discs if other is not disc])
    ]

    def order(rest: list[tuple[NDArray[np.float64], Disc]], planes: list[Disc]) -> list:
        if not planes or not rest:
            return rest
        plane, left = planes[0], planes[1:]
        eye = plane.normal @ view.toward
        side = [np.mean(sector[1:], axis=0) @ plane.normal * eye for sector, _ in rest]
        own = [piece for piece in rest if piece[1] is plane]
        far = [p for p, s in zip(rest, side) if p[1] is not plane and s < 0.0]
        near = [p for p, s in zip(rest, side) if p[1] is not plane and s >= 0.0]
        return [*order(far, left), *own, *order(near, left)]

    return order(pieces, discs)


def paint(ax: Axes, view: View, discs: list[Disc], alpha: float = 0.82) -> list[Polygon]:
    """Fills the discs, so that what is behind shows through faintly."""
    polygons = []
    for sector, disc in back_to_front(view, discs):
        polygon = Polygon(
            view.paper(sector),
            closed=True,
            facecolor=disc.fill,
            edgecolor="none",
            alpha=alpha,
            zorder=1.0,
        )
        polygons.append(ax.add_patch(polygon))
    return polygons
