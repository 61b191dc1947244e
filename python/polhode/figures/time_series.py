# SPDX-License-Identifier: MIT
"""Columns of a run against time, one panel above the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

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
        look = series(len(axis.get_lines()))
        said = [text for text in (symbol(name) if len(names) > 1 else None, label) if text]
        t, values = unbroken(run.t, run.columns[name], run.turn(name))
        axis.plot(t, values, label=", ".join(said) or None, **look.line)
    unit = units.pop()
    axis.set_ylabel(axis_label(names, unit))
    axis.margins(x=0)
    if turn_in(unit) is not None:
        angle_axis(axis.yaxis, unit)
    if axis.get_legend_handles_labels()[1]:
        axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)


def unbroken(
    t: NDArray[np.float64], values: NDArray[np.float64], turn: float | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A wrapped angle as a line to draw: cut (by NaN) at each wrap, both ends on the edges.

    An angle that is not wrapped (it leaves the range of one turn) and a column that is no angle
    (turn None) are returned as they are."""
    finite = values[np.isfinite(values)]
    if turn is None or finite.size == 0 or np.ptp(finite) > turn * (1 + 1e-9):
        return t, values
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
