# SPDX-License-Identifier: MIT
"""Light curves with the model of a fit, and what is left."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from polhode._core import _number
from polhode.figures.style import BLACK, DOUBLE_COLUMN, GREY, panels, series, styled
from polhode.fit import LightScenarioSolution
from polhode.light import LightCurve, LightModel, LightSolution, model_fluxes

COLUMNS = 2
"""Most sessions side by side in a new figure."""
LINE = 800
"""Points of the curve of the model across a session."""
PANEL = 2.0
"""Inches of height of one session with its residuals."""


@styled
def light_curve_fit(
    curves: LightCurve | Iterable[LightCurve],
    model: LightSolution | LightScenarioSolution | LightModel,
    ax: Any = None,
    *,
    unit: str = "",
    scale: float = 1.0,
) -> Any:
    """Each session with the fluxes of a model, and below it the residuals in standard errors.

    Parameters
    ----------
    curves : LightCurve, one or several: what was fitted.
    model : a solution of fit_light, search_light or fit_scenario, or its body.
    ax : two Axes for each session, that of fluxes first, or None for a new figure.
    unit : of time, for the labels; by default that of the scenario of the solution, if it has one.
    scale : how many of it are a unit of time of the curves.

    Returns
    -------
    An array (sessions, 2) of Axes. Fluxes are over the mean of the session. The curve of the model
    goes between the points, with the Sun and the observer where they were at the nearest one;
    factors of sessions are those of the fit, and of a body those of least squares.

    TypeError for what is no light curve."""
    sessions = [curves] if isinstance(curves, LightCurve) else list(curves)
    found = model.light if isinstance(model, LightScenarioSolution) else model
    body, loss = (found, "squared")
    if isinstance(found, LightSolution):
        body, loss = found.body, found.loss
    if not unit and isinstance(model, LightScenarioSolution):
        unit = model.scenario.units.time
    scale = float(_number(scale, "scale"))
    axes = _axes(ax, len(sessions))
    for (above, below), curve, at_points in zip(axes, sessions, model_fluxes(body, sessions, loss)):
        mean = float(np.mean(curve.flux))
        t, line = _line(curve, body, at_points)
        point, drawn = series(0), series(1)
        above.errorbar(scale * curve.t, curve.flux / mean, curve.sigma / mean, fmt="o",
                       color=point.color, markersize=2.0, linewidth=0.5, zorder=2)  # fmt: skip
        above.plot(scale * t, line / mean, color=drawn.color, linewidth=0.9, gid="model", zorder=3)
        r = (curve.flux - at_points) / curve.sigma
        below.axhline(0.0, color=BLACK, linewidth=0.6)
        for sign in (-1.0, 1.0):
            below.axhline(sign, color=GREY, linewidth=0.4, linestyle=":")
        below.plot(scale * curve.t, r, "o", color=point.color, markersize=2.0, gid="residuals")
        most = 1.15 * max(2.5, float(np.abs(r).max()))
        below.set(ylim=(-most, most), ylabel="residual ($\\sigma$)",
                  xlabel="$t$" + (f" ({unit})" if unit else ""))  # fmt: skip
        above.set_ylabel("flux / mean")
        above.tick_params(labelbottom=False)
        above.set_xlim(below.get_xlim())
        rms = float(np.sqrt(np.mean(r * r)))
        name = f"{curve.name}: " if curve.name else ""
        above.set_title(f"{name}{len(curve)} points, rms {rms:.2f} $\\sigma$", loc="left")
    return axes


def _axes(ax: Any, sessions: int) -> Any:
    """(sessions, 2): fluxes above residuals."""
    if sessions == 0:
        raise ValueError("light_curve_fit: got no light curves")
    if ax is not None:
        return panels(ax, sessions, 2, (0.0, 0.0))
    columns = min(COLUMNS, sessions)
    rows = -(-sessions // columns)
    size = (DOUBLE_COLUMN, 0.3 + PANEL * rows)
    ratios = {"height_ratios": [2.4, 1.0] * rows}
    grid = panels(None, 2 * rows, columns, size, gridspec_kw=ratios)
    found = []
    for k in range(rows * columns):
        row, column = divmod(k, columns)
        pair = grid[2 * row, column], grid[2 * row + 1, column]
        if k < sessions:
            found.append(pair)
        else:
            for unused in pair:
                unused.remove()
    return np.array(found, dtype=object)


def _line(curve: LightCurve, body: Any, at_points: Any) -> Any:
    """Times and fluxes of the model at and between the points, with the factor that these have."""
    between = np.linspace(curve.t.min(), curve.t.max(), LINE)
    t = between[~np.isin(between, curve.t)]  # a time may not stand twice
    order = np.argsort(curve.t)
    middle = 0.5 * (curve.t[order][1:] + curve.t[order][:-1])
    near = order[np.searchsorted(middle, t)]
    # of weights that only the points have: flux 1 with the same geometry, and the points themselves
    both = LightCurve(
        np.concatenate([curve.t, t]), np.concatenate([at_points, np.ones(len(t))]),
        np.concatenate([curve.sigma, np.full(len(t), 1e12 * curve.sigma.max())]),
        np.concatenate([curve.to_sun, curve.to_sun[near]]),
        np.concatenate([curve.to_observer, curve.to_observer[near]]),
    )  # fmt: skip
    order = np.argsort(both.t, kind="stable")
    sorted_curve = LightCurve(both.t[order], both.flux[order], both.sigma[order],
                              both.to_sun[order], both.to_observer[order])  # fmt: skip
    (found,) = model_fluxes(body, sorted_curve)
    back = np.empty(len(order))
    back[order] = found
    back[: len(curve)] = at_points
    order = np.argsort(both.t)
    return both.t[order], back[order]
