# SPDX-License-Identifier: MIT
"""Corner plots: each column of an ensemble against every other one; needs the package corner."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import matplotlib
import numpy as np

from polhode._tables import imported
from polhode.figures.ensemble_data import EnsembleData, Source, read_ensemble
from polhode.figures.style import DOUBLE_COLUMN, new_figure, panels, series, styled

MARGIN = 0.7
"""Inches below and on the left of a new figure."""
MANY = 4
"""Columns above which names of the horizontal axes take two lines."""
SAME = 1e-9
"""Relative difference below which numbers are the same but for rounding."""
QUATERNIONS = frozenset(("qw", "qx", "qy", "qz", "Qw", "Qx", "Qy", "Qz"))


@styled
def corner_plot(
    source: Source,
    columns: Sequence[str] | None = None,
    ax: Any = None,
    **keywords: Any,
) -> Any:
    """What was drawn and what became of it: histograms, and every pair as points with contours.

    Parameters
    ----------
    source : EnsembleResults of keep="final", its file, or columns by name.
    columns : which ones; None: the keys that were drawn and what of the last rows differs between
        members, but for member, t and quaternions.
    ax : (n, n) Axes for n columns, or None for a new figure.
    keywords : of corner.corner (https://corner.readthedocs.io): bins, range, truths, quantiles, ...

    Returns
    -------
    An (n, n) array of Axes. Members without all of these numbers (they failed) are left out. Where
    an event stops members, their last rows are at different times, which the column t has.

    ImportError without the package corner; ValueError for a column that is not there or is the same
    for all, and for fewer members than columns."""
    corner = imported("corner", "corner_plot")
    data = read_ensemble(source, "corner_plot")
    names = _that_differ(data) if columns is None else list(columns)
    data.require(names, "final")
    if not names:
        raise ValueError("corner_plot: got no columns that differ between members")
    table = np.column_stack([data.columns[name] for name in names])
    table = table[np.isfinite(table).all(axis=1)]
    if len(table) <= len(names):
        raise ValueError(
            f"corner_plot: got {len(table)} members; expected more than the {len(names)} columns"
        )
    for name, column in zip(names, table.T):
        if np.ptp(column) == 0.0:
            raise ValueError(f"corner_plot: {name} is {column[0]:.10g} for all; expected a spread")
    axes = _new_axes(len(names)) if ax is None else panels(ax, len(names), len(names), (0.0, 0.0))
    labels = [data.label(name) for name in names]
    given = {"labels": labels, "color": series(0).color, "max_n_ticks": 4, "smooth": 0.8}
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "This figure was using a layout engine")
        corner.corner(table, fig=axes[0, 0].figure, **{**given, **keywords})
    if ax is None:
        _set_margins(axes)
    return axes


def _new_axes(n: int) -> Any:
    with matplotlib.rc_context({"figure.constrained_layout.use": False}):  # it has margins
        return new_figure(DOUBLE_COLUMN, DOUBLE_COLUMN).subplots(n, n, squeeze=False)


def _set_margins(axes: Any) -> None:
    """Room for slanted numbers and names, whatever the size of a panel."""
    figure, n = axes[0, 0].figure, len(axes)
    size = figure.get_size_inches()[0]
    least, most = MARGIN / size, 1.0 - 0.1 / size
    figure.subplots_adjust(least, least, most, most, 0.06, 0.06)
    inch = n / (size - MARGIN)  # in heights of a panel, nearly
    for k in range(n):
        below, beside = axes[-1, k].xaxis, axes[k, 0].yaxis
        below.set_label_coords(0.5, -0.36 * inch)
        below.label.set_verticalalignment("top")
        beside.set_label_coords(-0.45 * inch, 0.5)
        if n > MANY:  # panels are narrow
            below.label.set_text(below.label.get_text().replace(" (", "\n("))


def _that_differ(data: EnsembleData) -> list[str]:
    """Drawn keys, then what else differs between members and is not one of those before again."""
    left_out = {"member", "t", "mode", *QUATERNIONS}
    names: list[str] = []
    for name in [*data.keys, *(name for name in data.columns if name not in data.keys)]:
        x = data.columns[name]
        there = np.isfinite(x)
        size = np.abs(x[there]).max(initial=0.0)
        if name in left_out or np.count_nonzero(there) < 2 or np.ptp(x[there]) <= SAME * size:
            continue
        away = (np.nanmax(np.abs(x - data.columns[one]), initial=0.0) for one in names)
        if all(distance > SAME * size for distance in away):
            names.append(name)
    return names
