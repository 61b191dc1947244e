# SPDX-License-Identifier: MIT
"""Poincare sections: the points where runs pass a surface, such as one value of an angle."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

import polhode
from polhode.figures.columns import ANGLES, angle_axis, axis_label, symbol
from polhode.figures.style import SINGLE_COLUMN, axes_or_new, series, styled


@styled
def poincare_section(
    runs: Any,
    x: Any = "l",
    y: Any = "L",
    ax: Axes | None = None,
    *,
    event: str | None = None,
    direction: int | None = None,
    elements: Callable[[Any], Any] | None = None,
    label: str | None = None,
    color: Any = None,
    size: float = 1.0,
) -> Axes:
    """The points where runs pass a surface of section.

    Parameters
    ----------
    runs : one run or a list of runs, each with its own colour. A run is a Trajectory or Results
        (their events are the points), a list of EventRecord, an array of states, or a mapping with
        the arrays x and y.
    x, y : the coordinates: fields of Andoyer's or Euler's variables ("l", "theta"), a ratio of two
        ("L/G" is cos J), or a function of the states that returns an array.
    event : the event to take, by name; None takes all. direction : 1 takes the crossings where the
        event's function rises, -1 where it falls, None both.
    elements : a function of states whose result has the fields x and y, in place of to_andoyer.
    label : what the runs are, for the legend. color : of every run. size : of points, in points.

    ValueError for an event that no run met."""
    groups = [_points_of(run, event, direction) for run in _listed(runs)]
    if all(group is None for group in groups):
        named = "an event" if event is None else f'the event "{event}"'
        raise ValueError(f"poincare_section: no run met {named}; expected points")
    axis = axes_or_new(ax, SINGLE_COLUMN, 0.85 * SINGLE_COLUMN)
    first = len(axis.get_lines())
    met = [group for group in groups if group is not None]
    for k, group in enumerate(met):
        points = [_coordinate(group, of, elements) for of in (x, y)]
        shade = series(first + k).color if color is None else color
        axis.plot(
            *points, linestyle="None", marker="o", markersize=size, markeredgewidth=0, color=shade,
            label=label if k == 0 else None, rasterized=points[0].size > 5000,
        )  # fmt: skip
    _dress(axis, x, y)
    return axis


def _listed(runs: Any) -> Iterable[Any]:
    """The runs: a list of runs as it is; one run as a list of one."""
    if not isinstance(runs, (list, tuple)) or (runs and isinstance(runs[0], polhode.EventRecord)):
        return [runs]
    return runs


def _points_of(run: Any, event: str | None, direction: int | None) -> Any:
    # Results are a mapping too: of their rows, which are no section.
    if isinstance(run, Mapping) and not hasattr(run, "events"):
        return run
    return states_of(run, event, direction)


def states_of(run: Any, event: str | None = None, direction: int | None = None) -> Any:
    """The states at the events of a run, as one RotorState; None where it met none.

    An array of states is returned as it is."""
    if isinstance(run, polhode.RotorState):
        return run
    records = [
        record
        for record in getattr(run, "events", run)
        if event in (None, record.name) and direction in (None, record.direction)
    ]
    if not records:
        return None
    return polhode.RotorState([r.s.q for r in records], [r.s.g for r in records])


def _coordinate(states: Any, of: Any, elements: Callable[[Any], Any] | None) -> NDArray[np.float64]:
    if callable(of):
        return np.ravel(np.asarray(of(states), dtype=float))
    if isinstance(states, Mapping) and of in states:
        return np.ravel(np.asarray(states[of], dtype=float))
    over, _, under = of.partition("/")
    numbers = _field(states, over, elements)
    return np.ravel(numbers / _field(states, under, elements) if under else numbers)


def _field(states: Any, name: str, elements: Callable[[Any], Any] | None) -> NDArray[np.float64]:
    if isinstance(states, Mapping):
        if name not in states:
            raise ValueError(f'no column "{name}"; there are: {", ".join(map(str, states))}')
        return np.asarray(states[name], dtype=float)
    for chart in (elements,) if elements else (polhode.to_andoyer, polhode.to_euler):
        held = chart(states)
        if hasattr(held, name):
            return np.asarray(getattr(held, name))
    raise ValueError(
        f'poincare_section: no coordinate "{name}"; expected one of l, g, h, L, G, H, phi, theta, '
        "psi, Phi, Theta, Psi, a ratio such as L/G, or a function of the states"
    )


def _dress(axis: Axes, x: Any, y: Any) -> None:
    for of, which, set_label in (
        (x, axis.xaxis, axis.set_xlabel),
        (y, axis.yaxis, axis.set_ylabel),
    ):
        if callable(of):
            continue
        angle = of in ANGLES
        set_label(
            " / ".join(map(symbol, of.split("/"))) if "/" in of
            else axis_label([of], "rad" if angle else "")
        )  # fmt: skip
        if angle:
            angle_axis(which)
    if axis.get_legend_handles_labels()[1]:
        axis.legend(loc="best", markerscale=3)
