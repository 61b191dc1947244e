# SPDX-License-Identifier: MIT
"""A run at a glance: the momentum in the body, the angles and the angular velocity over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from polhode import Body, angular_velocity, to_euler
from polhode._core import _number
from polhode.figures import style
from polhode.figures.bands import drawn_as_band, legends
from polhode.figures.columns import radians_in
from polhode.figures.momentum_sphere import DEFAULT_VIEW, momentum_sphere
from polhode.figures.run_data import RunData, run_data
from polhode.figures.time_series import unbroken
from polhode.figures.view import View

COARSE = np.pi / 3.0
"""Turn (rad) from row to row above which rows are not joined by lines."""


def rates_with_unit(data: RunData) -> tuple[NDArray[np.float64], str]:
    """Angular velocities (n, 3) and their unit: the run's own, or I^-1 g in the unit of w1."""
    unit = data.units.get("w1", "")
    if data.omega is not None:
        return data.omega, unit
    omega = angular_velocity(data.body, data.states)
    radians = radians_in(unit.partition("/")[0])
    if radians is not None:
        return omega / radians, unit
    return omega, f"rad/{data.time_unit}" if data.time_unit else ""


def is_coarse(data: RunData) -> bool:
    """Whether the body turns so far from row to row that a line between the rows would mislead."""
    q = np.asarray(data.states.q)
    cosines = np.abs(np.sum(q[1:] * q[:-1], axis=-1))  # of half the angle of the turn
    return len(q) > 1 and bool(2.0 * np.arccos(np.clip(np.median(cosines), 0.0, 1.0)) > COARSE)


def shown_rows(data: RunData, span: float | None) -> RunData:
    """The rows of the first `span` of the run; all where it is None."""
    if span is None:
        return data
    elapsed = np.abs(data.t - data.t[0])  # a run may go back in time
    # one row more, so that lines reach the edge
    last = min(int(np.searchsorted(elapsed, _number(span, "span"), side="right")) + 1, len(data.t))
    omega = None if data.omega is None else data.omega[:last]
    return replace(data, t=data.t[:last], states=data.states[:last], omega=omega)


def shown_end(data: RunData, span: float | None) -> float:
    """Where the axes of time end: after `span`, or else with the run."""
    whole = data.t[-1] - data.t[0]
    shown = abs(whole) if span is None else min(_number(span, "span"), abs(whole))
    return float(data.t[0] + np.copysign(shown, whole))


def time_label(data: RunData, end: float) -> str:
    """Names the axis of time, and says so where it does not show the whole run."""
    unit = f" ({data.time_unit})" if data.time_unit else ""
    shown, whole = abs(end - data.t[0]), abs(data.t[-1] - data.t[0])
    if shown >= whole:
        return f"Time{unit}"
    return f"Time{unit}: the first {float(f'{shown:.3g}'):.6g} of {whole:.6g}"


def look_of(data: RunData, k: int) -> dict[str, Any]:
    """Lines, or small markers where rows are far apart."""
    look = style.series(k)
    return {**look.point, "markersize": 1.6} if is_coarse(data) else look.line


def draw_angles(ax: Axes, data: RunData) -> None:
    """phi, theta, psi in degrees. [SA (1), (2)]"""
    euler = to_euler(data.states)
    for k, (name, symbol) in enumerate((("phi", r"\phi"), ("theta", r"\theta"), ("psi", r"\psi"))):
        degrees = np.degrees(getattr(euler, name))
        turn = None if name == "theta" else 360.0
        if drawn_as_band(ax, data.t, degrees, style.series(k), turn, f"${symbol}$", name):
            continue
        line = (data.t, degrees) if is_coarse(data) else unbroken(data.t, degrees, 360.0)
        ax.plot(*line, **look_of(data, k), label=f"${symbol}$", gid=name)
    ax.set_ylabel("Euler angles (deg)")
    ax.set_ylim(-190.0, 190.0)
    ax.set_yticks([-180, -90, 0, 90, 180])


def draw_rates(ax: Axes, data: RunData) -> None:
    """The angular velocity along the body axes. [SA (24)]"""
    omega, unit = rates_with_unit(data)
    for k in range(3):
        label, gid = rf"$\omega_{k + 1}$", f"w{k + 1}"
        if not drawn_as_band(ax, data.t, omega[:, k], style.series(k), None, label, gid):
            ax.plot(data.t, omega[:, k], **look_of(data, k), label=label, gid=gid)
    ax.set_ylabel("Angular velocity" + (f" ({unit})" if unit else ""))


@style.styled
def overview(
    results: Any,
    body: Body | None = None,
    view: View = DEFAULT_VIEW,
    span: float | None = None,
    ax: Sequence[Axes] | None = None,
) -> NDArray[Any]:
    """A run at a glance: momentum on its sphere, Euler angles and angular velocity over time.

    results: Results of a run, a Trajectory, the path of a file that polhode wrote, or
    RunData(t, states, body, units). body: needed where the source has none.

    Left: the momentum g of the run (thick) among the polhodes of the body [SA Fig. 1, (12)]; where
    the size of g changes, the sphere is that of the first row and g is drawn by its direction.
    Right: the 3-1-3 angles phi, theta, psi [SA (1)] in degrees and the angular velocity along the
    body axes: the columns w1, w2, w3 of the run, else I^-1 g [SA (24)].

    A curve that would fill its panel, up and down more often than 1.5 times in four points of the
    paper, is shown by a band from its least to its largest value in each bin of time, with a line
    of the mean; of an angle that turns so fast the legend says that it goes round. Other curves
    whose rows are too far apart for lines are drawn as points.

    span: how much time the right panels show from the start, single turns of a long run, say; the
    label says so. None: the whole run.

    ax: three Axes, or None for a new figure, two columns wide. Returns an array of the three
    Axes."""
    data = run_data(results, body)
    if ax is None:
        figure = style.new_figure(style.DOUBLE_COLUMN, 0.5 * style.DOUBLE_COLUMN)
        grid = figure.add_gridspec(2, 2, width_ratios=(1.0, 1.25))
        ax = [
            figure.add_subplot(grid[:, 0]),
            figure.add_subplot(grid[0, 1]),
            figure.add_subplot(grid[1, 1]),
        ]
        ax[1].sharex(ax[2])
        ax[1].tick_params(labelbottom=False)
    sphere, angles, rates = style.panels(ax, 1, 3, (0.0, 0.0)).ravel()
    g = np.asarray(data.states.g)
    size = np.linalg.norm(g, axis=-1, keepdims=True)
    if not size[0, 0] > 0.0:
        raise ValueError(
            "overview: got a run that starts without angular momentum; expected |g| > 0"
        )
    G = float(size[0, 0])
    direction = np.divide(g, size, out=np.zeros_like(g), where=size > 0.0)
    momentum_sphere(
        data.body, G, trace=G * direction, short_axis=4, long_axis=3, view=view, ax=sphere
    )
    shown, end = shown_rows(data, span), shown_end(data, span)
    draw_angles(angles, shown)
    draw_rates(rates, shown)
    for panel in (angles, rates):
        panel.set_xlim(data.t[0], end if end != data.t[0] else None)
    legends((angles, rates), handlelength=2.2)
    rates.set_xlabel(time_label(data, end))
    if data.title:
        sphere.set_title(data.title)
    return np.array([sphere, angles, rates], dtype=object)
