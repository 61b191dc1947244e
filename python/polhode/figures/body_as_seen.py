# SPDX-License-Identifier: MIT
"""A body as its observer sees it at some times, lit by the Sun."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Polygon
from numpy.typing import ArrayLike, NDArray

from polhode._core import _number, _numbers
from polhode.figures.style import BLACK, DOUBLE_COLUMN, GREY, new_figure, panels, styled
from polhode.fit import LightScenarioSolution
from polhode.light import LightModel, LightSolution

ACROSS = 6
"""Most pictures side by side in a new figure."""
PIXELS = 240
WHITE = 0.99
"""Part of the places that is not white."""
ALONG_SIGHT = 0.02
"""Sine of the angle from the line of sight below which the Sun has no direction on the sky."""
DARK = 0.07
"""Brightness of what is seen and not lit: the limb shows."""


@styled
def body_as_seen(
    body: LightSolution | LightScenarioSolution | LightModel,
    times: ArrayLike,
    to_sun: ArrayLike,
    to_observer: ArrayLike,
    ax: Any = None,
    *,
    unit: str = "",
    scale: float = 1.0,
) -> Any:
    """A body on the sky of its observer at some times, shaded by its law of scattering.

    Parameters
    ----------
    body : a solution of fit_light, search_light or fit_scenario, or its
        body; it moves freely. Facets are drawn one by one, those of a convex body on its mesh;
        shadows that they throw on each other are not.
    times : (N,).
    to_sun, to_observer : (3,) or (N, 3), from the body, along inertial axes.
    ax : N Axes, or None for a new figure.
    unit : of time, for the titles. scale : how many of it are a unit of time of the body.

    Returns
    -------
    An array (N,) of Axes. The third inertial axis is up. Brightness is on one scale in all
    pictures, whose brightest hundredth is white; the arrow points to where the Sun is on the sky,
    and is not there where that is behind the observer or the body."""
    bright = body.body if isinstance(body, (LightSolution, LightScenarioSolution)) else body
    if not isinstance(bright, LightModel):
        raise TypeError(
            f"body_as_seen: got {body!r}; expected a solution or a LightModel"
        )
    at = np.atleast_1d(np.asarray(_numbers(times, "times"), float))
    scale = float(_number(scale, "scale"))
    sun = _directions(to_sun, "to_sun", len(at))
    eye = _directions(to_observer, "to_observer", len(at))
    axes = _axes(ax, len(at))
    picture = _ellipsoid if bright.kind == "ellipsoid" else _facets(bright.mesh)
    pictures = [picture(bright, t, s, o) for t, s, o in zip(at, sun, eye)]
    lit = np.concatenate([light[np.isfinite(light)] for light, *_ in pictures])
    brightest = float(np.quantile(lit, WHITE)) or 1.0
    for axis, t, (light, edge, arrow) in zip(axes, at, pictures):
        _draw(axis, light / brightest, edge, arrow)
        axis.set_title(f"$t$ = {scale * t:.4g}" + (f" {unit}" if unit else ""))
    return axes


def _axes(ax: Any, count: int) -> NDArray[Any]:
    if ax is not None:
        return panels(ax, 1, count, (0.0, 0.0)).ravel()
    columns = min(ACROSS, count)
    rows = -(-count // columns)
    side = DOUBLE_COLUMN / max(columns, 3)
    grid = new_figure(side * columns, (side + 0.2) * rows).subplots(rows, columns, squeeze=False)
    for unused in grid.ravel()[count:]:
        unused.remove()
    return grid.ravel()[:count]


def _directions(given: Any, name: str, count: int) -> NDArray[np.float64]:
    vectors = np.asarray(_numbers(given, name), float)
    if vectors.shape not in ((3,), (count, 3)):
        raise ValueError(f"{name}: got shape {vectors.shape}; expected (3,) or ({count}, 3)")
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    if not np.all(length > 0.0):
        raise ValueError(f"{name}: expected vectors that are not 0")
    return np.broadcast_to(vectors / length, (count, 3))


def _paper(eye: NDArray[np.float64]) -> NDArray[np.float64]:
    """(2, 3): right and up of the sky as the observer sees it."""
    up = np.array([0.0, 0.0, 1.0]) if abs(eye[2]) < 0.999 else np.array([0.0, 1.0, 0.0])
    up = up - (up @ eye) * eye
    up /= np.linalg.norm(up)
    return np.stack([np.cross(up, eye), up])


def _turn(body: Any, t: float) -> NDArray[np.float64]:
    """Columns: axes F in space."""
    motion = body.spin.free_rotation
    return _matrix(motion.at(float(t)).q) @ _matrix(motion.body.q_FB).T


def _light(law: tuple[float, float], mu: Any, mu0: Any) -> Any:
    """What a detector sees of a place is the brightness of its surface over mu."""
    single, multiple = law
    lit, seen = np.clip(mu0, 0.0, None), np.clip(mu, 1e-12, None)
    return single * lit / (seen + lit) + multiple * lit


def _facets(mesh: Any) -> Any:
    """What _ellipsoid gives, of a mesh: light (n,) of facets that are seen, the farthest first, and
    their corners on paper (n, 3, 2)."""
    vertices = np.asarray(mesh.vertices)
    corners = (vertices / np.linalg.norm(vertices, axis=1).max())[np.asarray(mesh.triangles)]
    normals = np.asarray(mesh.normals)

    def picture(body: Any, t: float, sun: Any, eye: Any) -> tuple[Any, Any, Any]:
        turn, paper = _turn(body, t), _paper(eye)
        mu, mu0 = normals @ (turn.T @ eye), normals @ (turn.T @ sun)
        seen = np.flatnonzero(mu > 0.0)
        near = corners[seen].mean(axis=1) @ (turn.T @ eye)
        seen = seen[np.argsort(near, kind="stable")]
        light = _light(body.law, mu[seen], mu0[seen])
        return light, corners[seen] @ turn.T @ paper.T, paper @ sun

    return picture


def _ellipsoid(body: LightModel, t: float, sun: Any, eye: Any) -> tuple[Any, Any, Any]:
    """Light (PIXELS, PIXELS), NaN off the body; the edge (n, 2); the Sun on paper (2,)."""
    turn = _turn(body, t)
    axes = body.shape / body.shape.max()
    paper = _paper(eye)
    grid = np.linspace(-1.0, 1.0, PIXELS)
    x, y = np.meshgrid(grid, grid)
    base = (x[..., None] * paper[0] + y[..., None] * paper[1]) @ turn / axes
    sight = (turn.T @ eye) / axes
    a, b, c = sight @ sight, base @ sight, np.sum(base * base, axis=-1) - 1.0
    inside = b * b - a * c
    with np.errstate(invalid="ignore"):
        s = (-b + np.sqrt(inside)) / a
    normal = (base + s[..., None] * sight) / axes
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    mu, mu0 = normal @ (turn.T @ eye), normal @ (turn.T @ sun)
    light = np.where(inside > 0.0, _light(body.law, mu, mu0), np.nan)
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    shadow = paper @ turn @ np.diag(axes**2) @ turn.T @ paper.T
    values, vectors = np.linalg.eigh(shadow)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return light, ring * np.sqrt(values) @ vectors.T, paper @ sun


def _matrix(q: Any) -> NDArray[np.float64]:
    """Body axes to space."""
    from polhode.charts import attitude_matrix

    return np.asarray(attitude_matrix(np.asarray(q))).T


def _draw(axis: Any, light: Any, edge: Any, arrow: Any) -> None:
    shade = np.clip(DARK + (1.0 - DARK) * light, 0.0, 1.0)
    if edge.ndim == 3:  # facets; their own edges close the gaps between them
        axis.add_collection(PolyCollection(
            edge, array=shade, cmap="gray", clim=(0.0, 1.0), edgecolor="face", linewidth=0.4,
            zorder=1, gid="light",
        ))  # fmt: skip
    else:
        picture = axis.imshow(
            shade, extent=(-1, 1, -1, 1), origin="lower", cmap="gray", vmin=0.0, vmax=1.0,
            interpolation="bilinear", zorder=1, gid="light",
        )  # fmt: skip
        border = Polygon(
            edge, closed=True, facecolor="none", edgecolor=GREY, linewidth=0.5, zorder=2
        )
        axis.add_patch(border)
        picture.set_clip_path(border)
    size = float(np.hypot(*arrow))
    if size > ALONG_SIGHT:
        axis.annotate(
            "", 1.42 * arrow / size, 1.06 * arrow / size, zorder=3,
            arrowprops={"arrowstyle": "->", "color": BLACK, "linewidth": 0.8, "shrinkA": 0.0,
                        "shrinkB": 0.0},
        )  # fmt: skip
    axis.set(xlim=(-1.45, 1.45), ylim=(-1.45, 1.45), xticks=[], yticks=[], aspect="equal")
    axis.set_axis_off()
