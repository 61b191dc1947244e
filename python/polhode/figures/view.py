# SPDX-License-Identifier: MIT
"""Parallel projection with hidden lines: what a 3-D Axes cannot do, and what print needs.

A View turns points of space into points of paper; an Ellipsoid is the surface (momentum sphere,
energy ellipsoid, body) that hides what is behind it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from numpy.typing import ArrayLike, NDArray

from polhode._core import _number, _numbers
from polhode.figures import style


class View:
    """A direction of sight: elevation above the plane of axes 1, 2 and azimuth from 1, degrees.

    right, up, toward (3,): unit vectors of the paper, and from the paper to the eye; lamp: to the
    light, which comes from the upper left."""

    def __init__(self, elevation: float = 24.0, azimuth: float = 38.0) -> None:
        self.elevation = _number(elevation, "elevation")
        self.azimuth = _number(azimuth, "azimuth")
        e, a = np.radians(self.elevation), np.radians(self.azimuth)
        self.toward = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        self.right = np.array([-np.sin(a), np.cos(a), 0.0])
        self.up = np.cross(self.toward, self.right)
        lamp = self.toward + 0.6 * self.up - 0.5 * self.right
        self.lamp = lamp / np.linalg.norm(lamp)

    def __repr__(self) -> str:
        return f"View(elevation={self.elevation}, azimuth={self.azimuth})"

    def paper(self, points: ArrayLike) -> NDArray[np.float64]:
        """(..., 3) in space to (..., 2) on paper."""
        points = _numbers(points, "points")
        return np.stack([points @ self.right, points @ self.up], axis=-1)


@dataclass(frozen=True)
class Ellipsoid:
    """The surface sum (x_i / semi_axes_i)^2 = 1, turned by `axes`: rows are its axes in space."""

    semi_axes: tuple[float, float, float]
    axes: Any = None

    @property
    def frame(self) -> NDArray[np.float64]:
        return np.eye(3) if self.axes is None else np.asarray(self.axes, dtype=float)

    def facing(self, view: View, points: ArrayLike) -> NDArray[np.float64]:
        """Positive where a point (..., 3) of the surface is on the side of the eye."""
        own = np.asarray(points, dtype=float) @ self.frame.T
        return (own / np.square(self.semi_axes)) @ (self.frame @ view.toward)

    def hides(self, view: View, points: ArrayLike) -> NDArray[np.bool_]:
        """True where a point (..., 3) on or outside the surface is behind it, or inside it."""
        own = (np.asarray(points, dtype=float) @ self.frame.T) / self.semi_axes
        sight = (self.frame @ view.toward) / self.semi_axes
        a, b = sight @ sight, own @ sight
        c = np.sum(own * own, axis=-1) - 1.0
        # The ray p + s toward, s > 0, meets the surface: a s^2 + 2 b s + c = 0. A point of the
        # surface itself (c of rounding size) is hidden when the ray enters there, b < 0.
        surface = np.abs(c) < 1e-9
        return np.where(surface, b < 0.0, (c < 0.0) | ((b < 0.0) & (b * b > a * c)))

    def outline(self, view: View, count: int = 361) -> NDArray[np.float64]:
        """The contour (count, 3) that the eye sees: points whose normal is across the view."""
        normal = (
            self.frame @ view.toward
        ) / self.semi_axes  # in the axes where it is a unit sphere
        first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
        first /= np.linalg.norm(first)
        second = np.cross(normal / np.linalg.norm(normal), first)
        turn = np.linspace(0.0, 2.0 * np.pi, count)[:, None]
        return ((np.cos(turn) * first + np.sin(turn) * second) * self.semi_axes) @ self.frame

    def draw(self, ax: Axes, view: View, zorder: float = 0.0) -> list[Any]:
        """Outline and a pale shaded body; the artists."""
        edge = view.paper(self.outline(view))
        border = Polygon(
            edge,
            closed=True,
            facecolor="none",
            edgecolor=style.GREY,
            linewidth=0.5,
            zorder=zorder + 0.2,
        )
        ax.add_patch(border)
        low, high = edge.min(axis=0), edge.max(axis=0)
        picture = ax.imshow(
            self.light(view, low, high),
            extent=(low[0], high[0], low[1], high[1]),
            origin="lower",
            cmap="gray",
            vmin=0.0,
            vmax=1.0,
            interpolation="bilinear",
            zorder=zorder,
            aspect=ax.get_aspect(),
        )
        picture.set_clip_path(border)
        return [border, picture]

    def light(
        self, view: View, low: NDArray[np.float64], high: NDArray[np.float64], pixels: int = 160
    ) -> NDArray[np.float64]:
        """Brightness (pixels, pixels) of the near side, lit from the upper left: 0.86 to 1."""
        x, y = np.meshgrid(
            np.linspace(low[0], high[0], pixels), np.linspace(low[1], high[1], pixels)
        )
        base = (x[..., None] * view.right + y[..., None] * view.up) @ self.frame.T / self.semi_axes
        sight = (self.frame @ view.toward) / self.semi_axes
        a, b = sight @ sight, base @ sight
        c = np.sum(base * base, axis=-1) - 1.0
        s = (-b + np.sqrt(np.maximum(b * b - a * c, 0.0))) / a
        normal = ((base + s[..., None] * sight) / self.semi_axes) @ self.frame
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        cosine = np.clip(normal @ view.lamp, 0.0, 1.0)
        return 0.86 + 0.14 * cosine


def sphere(radius: float) -> Ellipsoid:
    """The sphere of this radius about the origin."""
    return Ellipsoid((radius, radius, radius))


def parts(
    points: NDArray[np.float64], hidden: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The visible and the hidden part of a curve (n, ...): NaN where it is the other's.

    The two share the point where they meet, so that no gap opens."""
    seen = ~hidden
    near = seen.copy()
    near[1:] |= seen[:-1]
    shape = (-1,) + (1,) * (points.ndim - 1)
    return (
        np.where(near.reshape(shape), points, np.nan),
        np.where(hidden.reshape(shape), points, np.nan),
    )
