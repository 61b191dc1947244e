# SPDX-License-Identifier: MIT
"""Outcomes of an ensemble over two of the numbers that were drawn."""

from __future__ import annotations

from matplotlib.axes import Axes

from polhode.figures.ensemble_data import Source, draw_points, read_ensemble
from polhode.figures.style import SINGLE_COLUMN, axes_or_new, styled


@styled
def outcomes(
    source: Source,
    value: str = "mode",
    ax: Axes | None = None,
    *,
    x: str | None = None,
    y: str | None = None,
    limits: tuple[float, float] | None = None,
    size: float | None = None,
) -> Axes:
    """Each member as a point over two drawn numbers, its colour what became of it.

    Parameters
    ----------
    source : EnsembleResults of keep="final", its file, or columns by name.
    value : the column to show. "mode" has the looks of its regimes and a legend; any other one is a
        number, with a colour bar.
    x, y : columns; None takes the first two keys that were drawn.
    limits : the numbers of the two ends of the colour bar; None: what there is.
    size : of points, in points of the paper; None: by their number.

    Where an event stops members, their last rows are at different times: the column t is when, and
    EVENT_first when an event first happened. Members that failed are crosses. ValueError for a
    column that is not there."""
    data = read_ensemble(source, "outcomes")
    if (x is None or y is None) and len(data.keys) < 2:
        many = "1 column" if len(data.keys) == 1 else f"{len(data.keys)} columns"
        raise ValueError(
            f"outcomes: {many} of keys that were drawn{data.other_keep('final')}; expected two, or "
            "x and y, names of columns"
        )
    across, up = data.keys[0] if x is None else x, data.keys[1] if y is None else y
    data.require((across, up, value), "final")
    axis = axes_or_new(ax, SINGLE_COLUMN, 0.8 * SINGLE_COLUMN)
    draw_points(axis, data, data.columns[across], data.columns[up], value, limits, size)
    axis.set(xlabel=data.label(across), ylabel=data.label(up))
    return axis
