# SPDX-License-Identifier: MIT
"""A body as one sees it: an ellipsoid or a box of its moments, with axes, momentum and spin."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from numpy.typing import ArrayLike, NDArray

from polhode import Body, RotorState
from polhode.charts import attitude_matrix, inertial_angular_velocity, inertial_momentum
from polhode.figures import arrows, style
from polhode.figures.labels import HALO
from polhode.figures.view import Ellipsoid, View, parts

SHAPES = ("ellipsoid", "box")
THINNEST = 0.03
"""Least half thickness that is drawn, of a body that is flat (I3 = I1 + I2) or a rod."""
DEFAULT_VIEW = View(22.0, 36.0)
REACH = 1.3
"""Length of the momentum and the angular velocity; the largest half size of the body is 1."""
BOX_CORNER = 1.15
"""How far the corners of a box are: nearer than the tips of the vectors."""
BEYOND = 0.3
"""Length of the body axes outside the body."""


def half_sizes(body: Body) -> NDArray[np.float64]:
    """Half axes (3,) of the homogeneous ellipsoid, or half edges of the box, with these moments.

    Both follow a_1^2 : a_2^2 : a_3^2 = I2 + I3 - I1 : I3 + I1 - I2 : I1 + I2 - I3; the largest is
    1."""
    I = body.moments
    squares = np.maximum(I.sum() - 2.0 * I, 0.0)
    return np.maximum(np.sqrt(squares / squares.max()), THINNEST)


class EllipsoidPicture:
    """An ellipsoid with its three principal sections; `move` turns it."""

    def __init__(self, ax: Axes, view: View, sizes: NDArray[np.float64]) -> None:
        self.view, self.sizes = view, sizes
        self.border, self.light = Ellipsoid(tuple(sizes)).draw(ax, view)
        look = {"color": style.BLACK, "lw": 0.6, "ls": "-"}
        self.near = [ax.plot([], [], **look, zorder=1.2)[0] for _ in range(3)]
        self.far = [ax.plot([], [], **look, alpha=0.25, zorder=0.6)[0] for _ in range(3)]

    def move(self, axes: NDArray[np.float64]) -> None:
        """axes (3, 3): rows are the body axes in space."""
        surface = Ellipsoid(tuple(self.sizes), axes)
        edge = self.view.paper(surface.outline(self.view))
        self.border.set_xy(edge)
        low, high = edge.min(axis=0), edge.max(axis=0)
        self.light.set_data(surface.light(self.view, low, high))
        self.light.set_extent((low[0], high[0], low[1], high[1]))
        self.light.set_clip_path(self.border)
        turn = np.linspace(0.0, 2.0 * np.pi, 181)[:, None]
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            ring = np.cos(turn) * self.sizes[i] * axes[i] + np.sin(turn) * self.sizes[j] * axes[j]
            seen, hidden = parts(self.view.paper(ring), surface.facing(self.view, ring) < 0.0)
            self.near[k].set_data(*seen.T)
            self.far[k].set_data(*hidden.T)

    def hides(self, axes: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.bool_]:
        return Ellipsoid(tuple(self.sizes), axes).hides(self.view, points)


class BoxPicture:
    """A box: its near faces, each with the light that falls on it, and the far edges pale."""

    def __init__(self, ax: Axes, view: View, sizes: NDArray[np.float64]) -> None:
        self.view, self.sizes = view, sizes
        self.faces = {}
        for k, sign in itertools.product(range(3), (1.0, -1.0)):
            face = Polygon(
                np.zeros((4, 2)), closed=True, edgecolor="black", lw=0.7, joinstyle="round"
            )
            self.faces[k, sign] = ax.add_patch(face)

    def corners(self, axes: NDArray[np.float64], k: int, sign: float) -> NDArray[np.float64]:
        i, j = (k + 1) % 3, (k + 2) % 3
        own = np.zeros((4, 3))
        own[:, k] = sign * self.sizes[k]
        own[:, i] = self.sizes[i] * np.array([1.0, 1.0, -1.0, -1.0])
        own[:, j] = self.sizes[j] * np.array([1.0, -1.0, -1.0, 1.0])
        return own @ axes

    def move(self, axes: NDArray[np.float64]) -> None:
        for (k, sign), face in self.faces.items():
            normal = sign * axes[k]
            seen = normal @ self.view.toward > 0.0
            bright = 0.72 + 0.26 * max(float(normal @ self.view.lamp), 0.0)
            face.set_xy(self.view.paper(self.corners(axes, k, sign)))
            face.set_facecolor(3 * (bright,) if seen else "none")
            face.set_edgecolor((0.0, 0.0, 0.0, 1.0 if seen else 0.15))
            face.set_zorder(1.0 if seen else 0.5)

    def hides(self, axes: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Inside, or behind: the ray to the eye is in the slabs of all three axes at once."""
        own, sight = points @ axes.T, axes @ self.view.toward
        sight = np.where(np.abs(sight) < 1e-12, 1e-12, sight)
        bounds = np.stack([(-self.sizes - own) / sight, (self.sizes - own) / sight])
        enter = bounds.min(axis=0).max(axis=-1)
        leave = bounds.max(axis=0).min(axis=-1)
        return (leave > np.maximum(enter, 0.0)) & (leave > 1e-9)


class Pointer:
    """A vector from the centre: the part that the body hides is pale, and so is a hidden tip."""

    def __init__(
        self, ax: Axes, view: View, name: str, color: str, width: float, size: float
    ) -> None:
        self.view = view
        (self.near,) = ax.plot(
            [], [], "-", color=color, lw=width, zorder=3.0, solid_capstyle="butt"
        )
        (self.far,) = ax.plot([], [], "-", color=color, lw=0.6 * width, alpha=0.3, zorder=2.0)
        self.color = color
        self.head = arrows.arrow(ax, (0.0, 0.0), (0.0, 1.0), color, size, linewidth=0.0)
        self.label = ax.text(
            0.0,
            0.0,
            name,
            color=color,
            ha="center",
            va="center",
            fontsize=9.0,
            path_effects=HALO,
            zorder=6.0,
            clip_on=True,
        )

    def move(self, tip: NDArray[np.float64], hides: Any) -> None:
        points = tip * np.linspace(0.0, 1.0, 121)[:, None]
        hidden = hides(points)
        near, far = parts(self.view.paper(points), hidden)
        self.near.set_data(*near.T)
        self.far.set_data(*far.T)
        end = self.view.paper(tip)
        length = float(np.linalg.norm(end))
        self.head.xy = tuple(end)
        self.head.set_position(tuple(end * (1.0 - 1e-3 / max(length, 1e-3))))
        self.head.arrow_patch.set_color(style.faded(self.color, 0.3) if hidden[-1] else self.color)
        self.label.set_position(tuple(end + 0.13 * end / max(length, 1e-9)))

    def set_visible(self, visible: bool) -> None:
        for artist in (self.near, self.far, self.head, self.label):
            artist.set_visible(visible)


class BodyPicture:
    """A body on Axes that can be moved: `show(state)` turns it to a state. For animations.

    body: its moments give the shape; shape: "ellipsoid" or "box"; vectors: draw the directions of
    the momentum and of the angular velocity."""

    def __init__(
        self,
        ax: Axes,
        body: Body,
        shape: str = "ellipsoid",
        view: View = DEFAULT_VIEW,
        vectors: bool = True,
    ) -> None:
        if shape not in SHAPES:
            raise ValueError(
                f"BodyPicture: got shape = {shape!r}; expected one of {', '.join(SHAPES)}"
            )
        self.ax, self.body, self.view = ax, body, view
        sizes = half_sizes(body)
        if shape == "box":
            sizes *= BOX_CORNER / np.linalg.norm(sizes)
        with style.style():
            kind = EllipsoidPicture if shape == "ellipsoid" else BoxPicture
            self.solid = kind(ax, view, sizes)
            self.axes = [
                Pointer(ax, view, rf"$\mathbf{{b}}_{k + 1}$", style.VERMILLION, 1.3, 8.0)
                for k in range(3)
            ]
            self.momentum = Pointer(ax, view, r"$\mathbf{G}$", style.BLUE, 1.9, 11.0)
            self.spin = Pointer(ax, view, r"$\omega$", style.BLACK, 1.0, 8.0)
        self.vectors = vectors
        limit = REACH + 0.2
        ax.set(xlim=(-limit, limit), ylim=(-limit, limit))

    def show(self, state: RotorState) -> None:
        """Turns the picture to one state."""
        if state.shape != ():
            raise ValueError(
                f"BodyPicture.show: got states of shape {state.shape}; expected one state"
            )
        rows = attitude_matrix(state.q)
        self.solid.move(rows)

        def hides(points: NDArray[np.float64]) -> NDArray[np.bool_]:
            return self.solid.hides(rows, points)

        for k, pointer in enumerate(self.axes):
            pointer.move((self.solid.sizes[k] + BEYOND) * rows[k], hides)
        omega = inertial_angular_velocity(self.body, state)
        for pointer, vector in ((self.momentum, inertial_momentum(state)), (self.spin, omega)):
            self._point(pointer, vector, hides)

    def _point(self, pointer: Pointer, vector: ArrayLike, hides: Any) -> None:
        vector = np.asarray(vector, dtype=float)
        length = float(np.linalg.norm(vector))
        shown = self.vectors and length > 0.0
        pointer.set_visible(shown)
        if shown:
            pointer.move(REACH * vector / length, hides)


@style.styled
def attitude_of_body(
    state: RotorState,
    body: Body,
    shape: str = "ellipsoid",
    view: View = DEFAULT_VIEW,
    vectors: bool = True,
    ax: Axes | None = None,
) -> Axes:
    """The body in the attitude of a state, seen from `view` in the inertial axes.

    shape: the homogeneous "ellipsoid" or "box" with the moments of the body. Arrows: the body axes
    b1, b2, b3 and, with vectors, the directions of the momentum G and of the angular velocity omega
    [SA (8)]. What the body hides is pale. For moving pictures see BodyPicture. Returns the Axes."""
    ax = style.plane_axes(ax)
    BodyPicture(ax, body, shape, view, vectors).show(state)
    return ax
