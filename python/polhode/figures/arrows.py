# SPDX-License-Identifier: MIT
"""Arrow heads on curves, vectors and arcs of angles, all of a fixed size on paper."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.text import Annotation
from matplotlib.transforms import Transform
from numpy.typing import ArrayLike, NDArray

HEAD_LENGTH = 0.42
"""Length of a head in units of its size in points."""
HEAD = f"-|>,head_length={HEAD_LENGTH},head_width=0.17"


def head(
    ax: Axes,
    point: ArrayLike,
    direction: ArrayLike,
    color: str = "black",
    size: float = 9.0,
    at: float = 0.5,
    **keywords: Any,
) -> Annotation:
    """An arrow head alone, pointing along `direction` (data coordinates): `point` is its middle, or
    (at = 1) its tip.

    The limits and the aspect of the Axes must be set before: the head has its size on paper."""
    point, direction = np.asarray(point, dtype=float), np.asarray(direction, dtype=float)
    length = np.linalg.norm(direction)
    if not length > 0.0:
        raise ValueError(
            f"arrows.head: got direction {direction.tolist()}; expected a vector that is not 0"
        )
    to_paper = settled(ax)
    middle = to_paper.transform(point)
    along = to_paper.transform(point + 1e-3 * direction / length * np.ptp(ax.get_xlim())) - middle
    along *= HEAD_LENGTH * size * ax.figure.dpi / 72.0 / np.linalg.norm(along)
    back = to_paper.inverted()
    tip = back.transform(middle + (1.0 - at) * along)
    tail = back.transform(middle + (0.95 - at) * along)
    return arrow(ax, tail, tip, color=color, size=size, linewidth=0.0, **keywords)


def settled(ax: Axes) -> Transform:
    """The transform from data to pixels once limits and aspect have been applied."""
    ax.get_xlim(), ax.get_ylim()
    ax.apply_aspect()
    return ax.transData


def data_per_point(ax: Axes) -> float:
    """Data units in a point (1/72 inch) of paper, along x."""
    scale = settled(ax).transform([[0.0, 0.0], [1.0, 0.0]])
    return ax.figure.dpi / 72.0 / abs(scale[1, 0] - scale[0, 0])


def arrow(
    ax: Axes,
    tail: ArrayLike,
    tip: ArrayLike,
    color: str = "black",
    size: float = 9.0,
    linewidth: float = 0.9,
    zorder: float = 4.0,
    linestyle: Any = "-",
) -> Annotation:
    """A straight arrow from `tail` to `tip` (data coordinates); the Annotation, which has both."""
    drawn = ax.annotate(
        "",
        xy=tuple(np.asarray(tip, dtype=float)),
        xytext=tuple(np.asarray(tail, dtype=float)),
        arrowprops={
            "arrowstyle": HEAD,
            "mutation_scale": size,
            "shrinkA": 0.0,
            "shrinkB": 0.0,
            "color": color,
            "linewidth": linewidth,
            "linestyle": linestyle,
            "joinstyle": "miter",
        },
        annotation_clip=False,
        zorder=zorder,
    )
    drawn.set_in_layout(False)
    return drawn


def turned(axis: ArrayLike, start: ArrayLike, angle: ArrayLike) -> NDArray[np.float64]:
    """`start` (3,) turned about the unit vector `axis` (3,) by angles (n,): (n, 3)."""
    axis, start = np.asarray(axis, dtype=float), np.asarray(start, dtype=float)
    angle = np.atleast_1d(np.asarray(angle, dtype=float))[:, None]
    along = axis * (axis @ start)
    return along + np.cos(angle) * (start - along) + np.sin(angle) * np.cross(axis, start)
