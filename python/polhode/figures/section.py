# SPDX-License-Identifier: MIT
"""Poincare sections: the points where runs pass a surface, such as one value of an angle."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from numpy.typing import NDArray

import polhode
from polhode._core import _number, _numbers
from polhode._output_files import OutputFile
from polhode.figures.columns import ANGLES, angle_axis, axis_label, symbol, turn_in
from polhode.figures.map_data import MapData, motions_of
from polhode.figures.style import SINGLE_COLUMN, axes_or_new, series, styled

SPIN_ORBIT = {
    "angle": "angle of the long axis from the pericentre",
    "spin": "spin / mean motion",
    "tilt": "tilt of the axis against the normal",
}
"""What the columns of a section of spin and orbit are."""


@styled
def poincare_section(
    runs: Any,
    x: Any = None,
    y: Any = None,
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
    runs : one run or a list of runs, each with its own colour. A run is an AndoyerSection or a
        SpinOrbitSection, a Trajectory or Results (their events are the points), a list of
        EventRecord, an array of states, or a mapping with the arrays x and y. A map of sections,
        MapResults or the file that `polhode map` wrote, is a run for each of its cells.
    x, y : the coordinates: fields of Andoyer's or Euler's variables ("l", "theta"), a ratio of two
        ("L/G" is cos J), or a function of the states that returns an array; of a section of spin
        and orbit also "angle", "spin" and "tilt". None: l and L, or angle and spin.
    event : the event to take, by name; None takes all. direction : 1 takes the crossings where the
        event's function rises, -1 where it falls, None both.
    elements : a function of states whose result has the fields x and y, in place of to_andoyer.
    label : what the runs are, for the legend. color : of every run. size : of points, in points.

    ValueError for an event that no run met."""
    size = _number(size, "size")
    groups = [_points_of(run, event, direction) for run in _listed(runs)]
    if all(group is None for group in groups):
        named = "an event" if event is None else f'the event "{event}"'
        raise ValueError(f"poincare_section: no run met {named}; expected points")
    axis = axes_or_new(ax, SINGLE_COLUMN, 0.85 * SINGLE_COLUMN)
    first = len(axis.get_lines())
    met = [group for group in groups if group is not None]
    spin_orbit = _is_spin_orbit(met[0])
    x = x or ("angle" if spin_orbit else "l")
    y = y or ("spin" if spin_orbit else "L")
    for k, group in enumerate(met):
        points = [_coordinate(group, of, elements) for of in (x, y)]
        shade = series(first + k).color if color is None else color
        axis.plot(
            *points, linestyle="None", marker="o", markersize=size, markeredgewidth=0, color=shade,
            label=label if k == 0 else None, rasterized=points[0].size > 5000,
        )  # fmt: skip
    units = met[0].units if isinstance(met[0], MapData) else {}
    for of, which in ((x, axis.xaxis), (y, axis.yaxis)):
        if not callable(of):
            _dress(which, of, units, spin_orbit)
    if axis.get_legend_handles_labels()[1]:
        axis.legend(loc="best", markerscale=3)
    return axis


def _listed(runs: Any) -> Iterable[Any]:
    """The runs: a list of runs as it is, one run as a list of one; of a map those of its cells."""
    if not isinstance(runs, (list, tuple)) or (
        runs and isinstance(runs[0], polhode.types.EventRecord)
    ):
        runs = [runs]
    listed: list[Any] = []
    for run in runs:
        is_map = isinstance(run, (str, os.PathLike, OutputFile, polhode.MapResults))
        listed += motions_of(run) if is_map else [run]
    return listed


def _is_spin_orbit(points: Any) -> bool:
    if isinstance(points, MapData):
        return "spin" in points.columns
    return isinstance(points, polhode.analysis.SpinOrbitSection)


def _points_of(run: Any, event: str | None, direction: int | None) -> Any:
    if isinstance(run, (MapData, polhode.analysis.SpinOrbitSection)):
        return run if _length(run) else None
    if isinstance(run, polhode.analysis.AndoyerSection):
        return run.states if len(run) else None
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


def _length(points: Any) -> int:
    return len(points.columns["t"] if isinstance(points, MapData) else points)


def _coordinate(states: Any, of: Any, elements: Callable[[Any], Any] | None) -> NDArray[np.float64]:
    if isinstance(states, MapData):
        states = states.columns
    if callable(of):
        states = states.states if isinstance(states, polhode.analysis.SpinOrbitSection) else states
        return np.ravel(_numbers(of(states), "coordinate"))
    if isinstance(states, Mapping) and of in states:
        return np.ravel(_numbers(states[of], of))
    over, _, under = of.partition("/")
    numbers = _field(states, over, elements)
    return np.ravel(numbers / _field(states, under, elements) if under else numbers)


def _field(states: Any, name: str, elements: Callable[[Any], Any] | None) -> NDArray[np.float64]:
    if isinstance(states, Mapping):
        if name not in states:
            raise ValueError(f'no column "{name}"; there are: {", ".join(map(str, states))}')
        return _numbers(states[name], name)
    if isinstance(states, polhode.analysis.SpinOrbitSection):
        if name in SPIN_ORBIT:
            return np.asarray(getattr(states, name))
        states = states.states
    for chart in (elements,) if elements else (polhode.to_andoyer, polhode.to_euler):
        held = chart(states)
        if hasattr(held, name):
            return np.asarray(getattr(held, name))
    raise ValueError(
        f'poincare_section: no coordinate "{name}"; expected one of l, g, h, L, G, H, phi, theta, '
        "psi, Phi, Theta, Psi, a ratio such as L/G, or a function of the states"
    )


def _dress(which: Axis, of: str, units: Mapping[str, str], spin_orbit: bool) -> None:
    """The label of an axis and, for angles, its ticks."""
    angle = of in ANGLES or (spin_orbit and of in ("angle", "tilt"))
    unit = units.get(of, "rad" if angle else "")
    if "/" in of:
        text = " / ".join(map(symbol, of.split("/")))
    elif spin_orbit and of in SPIN_ORBIT:
        text = SPIN_ORBIT[of] + (f" ({unit})" if angle else "")
    else:
        text = axis_label([of], unit)
    which.set_label_text(text)
    if angle:
        if spin_orbit and of == "angle":
            quarter = (turn_in(unit) or 2 * np.pi) / 4
            which.set_view_interval(-quarter, quarter, ignore=True)
        angle_axis(which, unit)
