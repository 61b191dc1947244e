# SPDX-License-Identifier: MIT
"""Columns of a run against time, one panel above the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from polhode.figures.bands import drawn_as_band, legends
from polhode.figures.columns import Table, angle_axis, axis_label, symbol, table, turn_in
from polhode.figures.style import DOUBLE_COLUMN, panels, series, styled

PANEL_HEIGHT = 1.05
"""Inches of each panel of a new figure."""


@styled
def time_series(
    source: Any,
    columns: str | Sequence[str | Sequence[str]],
    ax: Any = None,
    *,
    system: Any = None,
    units: Mapping[str, str] | None = None,
    label: str | None = None,
) -> Any:
    """Columns of a run against time.

    Parameters
    ----------
    source : a Trajectory, Results, DataFrame, or a mapping of arrays with the times as "t".
    columns : a name: one panel. A list: a panel for each entry, with one time axis; an entry that
        is a tuple of names of one unit shares a panel: `["theta", ("w1", "w2", "w3")]`.
    ax : Axes, as many as panels; None for a new figure. Drawing twice on the same Axes compares
        runs: every curve takes the next look.
    system : the System of a Trajectory, for columns other than t, q and g.
    units : unit of a column by name ("t" too), in place of those of the source. Angles without a
        unit are in radians.
    label : what the run is, for the legend.

    Returns
    -------
    The Axes, or an array of them where `columns` is a list.

    A curve that would fill its panel, up and down more often than 1.5 times in four points of the
    paper, is shown by a band from its least to its largest value in each bin of time, with a line
    of the mean; of an angle that turns so fast the legend says that it goes round.
    For single swings draw a part of the run.

    Wrapped angles go to the edge of their range and on from the other edge, without a vertical
    line. ValueError for a column that is not there, and for units that differ within a panel."""
    rows = [[columns]] if isinstance(columns, str) else [_names(entry) for entry in columns]
    if not rows:
        raise ValueError("time_series: got no columns; expected at least one")
    run = table(source, [name for row in rows for name in row], system, units)
    height = 0.5 + PANEL_HEIGHT * len(rows)
    axes = panels(ax, len(rows), 1, (DOUBLE_COLUMN, height), sharex=True).ravel()
    for axis, names in zip(axes, rows):
        _draw(axis, run, names, label)
    legends(axes, borderaxespad=0.2)
    axes[-1].set_xlabel(axis_label(["t"], run.units["t"]))
    if ax is None:
        axes[0].get_figure().align_ylabels()
    return axes[0] if isinstance(columns, str) else axes


def _names(entry: str | Sequence[str]) -> list[str]:
    return [entry] if isinstance(entry, str) else list(entry)


def _draw(axis: Axes, run: Table, names: list[str], label: str | None) -> None:
    units = {run.units[name] for name in names}
    if len(units) > 1:
        listed = ", ".join(f"{name} ({run.units[name]})" for name in names)
        raise ValueError(f"time_series: {listed} share a panel; expected one unit")
    for name in names:
        look = series(curves_of(axis))
        parts = [text for text in (symbol(name) if len(names) > 1 else None, label) if text]
        said, values = ", ".join(parts), run.columns[name]
        turn = turn_if_wrapped(values, run.turn(name))
        if not drawn_as_band(axis, run.t, values, look, turn, said or symbol(name), name):
            line = unbroken(run.t, values, turn)
            axis.plot(*line, label=said or None, gid=name, **look.line)
    unit = units.pop()
    axis.set_ylabel(axis_label(names, unit))
    axis.margins(x=0)
    if turn_in(unit) is not None:
        angle_axis(axis.yaxis, unit)


def curves_of(axis: Axes) -> int:
    """How many curves there are: lines, and bands that have none."""
    bands = [c.get_gid() for c in axis.collections if c.get_gid()]
    return len(axis.get_lines()) + sum(not gid.endswith("-band") for gid in bands)


def turn_if_wrapped(values: NDArray[np.float64], turn: float | None) -> float | None:
    """The turn of an angle that stays within one; None for what is no angle, or is not wrapped."""
    finite = values[np.isfinite(values)]
    if turn is None or finite.size == 0 or np.ptp(finite) > turn * (1 + 1e-9):
        return None
    return turn


def unbroken(
    t: NDArray[np.float64], values: NDArray[np.float64], turn: float | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A wrapped angle as a line to draw: cut (by NaN) at each wrap, both ends on the edges.

    An angle that is not wrapped (it leaves the range of one turn) and a column that is no angle
    (turn None) are returned as they are."""
    turn = turn_if_wrapped(values, turn)
    if turn is None:
        return t, values
    finite = values[np.isfinite(values)]
    low = -turn / 2 if finite.min() < 0 else 0.0
    with np.errstate(invalid="ignore"):
        step = np.diff(values)
        wraps = np.nonzero(np.abs(step) > turn / 2)[0]
    # Going up over the top edge looks like a jump down, by nearly a turn.
    up = step[wraps] < 0
    leave = np.where(up, low + turn, low)
    enter = np.where(up, low, low + turn)
    whole = step[wraps] + np.where(up, turn, -turn)
    part = np.divide(leave - values[wraps], whole, out=np.full(wraps.size, 0.5), where=whole != 0)
    crossing = t[wraps] + np.clip(part, 0, 1) * (t[wraps + 1] - t[wraps])
    at = np.repeat(wraps + 1, 3)
    return (
        np.insert(t, at, np.repeat(crossing, 3)),
        np.insert(values, at, np.stack([leave, np.full(wraps.size, np.nan), enter], 1).ravel()),
    )
