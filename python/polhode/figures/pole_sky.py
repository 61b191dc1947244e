# SPDX-License-Identifier: MIT
"""Poles of all solutions of a fit on the sky, with their errors."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from polhode.figures.pole_cloud import set_sky_ticks
from polhode.figures.style import (
    SERIES,
    SINGLE_COLUMN,
    axes_or_new,
    legend_above,
    series,
    styled,
)
from polhode.fit import FitResults, SpinSolution, SpinState
from polhode.light import LightSolution

CIRCLE = 181
SMALLEST = 1e-12
STEP = 1e-6
"""Of differences of the pole by unknowns: it is a smooth function of a few numbers, and errors of
errors do not show."""


@styled
def pole_sky(
    solutions: Any, ax: Axes | None = None, *, scaled: bool = True, labels: Sequence[str] = ()
) -> Axes:
    """The direction of the angular momentum of each solution, with its 1-sigma ellipse.

    Parameters
    ----------
    solutions : what search_light or fit_scenario returned, or solutions of fit_light, fit_spin and
        the others, one or several.
    ax : Axes with the projection "mollweide", or None for a new figure.
    scaled : errors as large as the residuals say, where they say it; else as those of the data were
        given.
    labels : of the solutions, in the legend; by default their place from 1 and what ranks them:
        chi-square, the loss if it is robust, or the cost of convex bodies.

    From the eighth solution on symbols are the places. Longitude grows from 0 on the left to 360
    degrees on the right. Ellipses are of the covariance of the fit; they hold 39 % of it. TypeError
    for other Axes and other solutions."""
    all_of = _solutions(solutions)
    axis = axes_or_new(ax, 1.5 * SINGLE_COLUMN, 0.9 * SINGLE_COLUMN, projection="mollweide")
    if axis.name != "mollweide":
        raise TypeError('pole_sky: got plain Axes; expected a projection "mollweide"')
    for k, one in enumerate(all_of):
        pole, covariance = pole_and_covariance(one, scaled)
        look = series(k)
        said = labels[k] if k < len(labels) else f"{k + 1}: {_rank(one)}"
        x, y = _places(pole[None])
        point = {**look.point, "markersize": 5.0}
        if k >= len(SERIES):
            point |= {"marker": f"${k + 1}$", "markersize": 7.0}
        axis.plot(x, y, **point, label=said, gid=f"pole-{k + 1}", zorder=3)
        ring = _ellipse(pole, covariance)
        if ring is None:
            continue
        x, y = _places(ring)
        jumps = np.abs(np.diff(x)) > np.pi
        x[1:][jumps] = np.nan
        axis.plot(x, y, color=look.color, linewidth=0.9, gid=f"error-{k + 1}", zorder=2)
    axis.grid(True)
    set_sky_ticks(axis)
    if all_of:
        legend_above(axis)
    return axis


def _rank(solution: Any) -> str:
    light = getattr(solution, "light", solution)
    if hasattr(getattr(light, "body", None), "coefficients"):
        return f"cost {light.cost:.4g}"
    if getattr(light, "loss", ("squared", 1.0))[0] != "squared":
        return f"loss {light.cost:.4g}"
    return f"$\\chi^2$ {solution.chi_square:.4g}"


def pole_and_covariance(solution: Any, scaled: bool = True) -> tuple[np.ndarray, np.ndarray]:
    """The pole (3,), of length 1, and the covariance (3, 3) of its direction that unknowns leave.
    """
    solution = getattr(solution, "light", solution)  # of a scenario
    state, names, covariance, scale = _spin_of(solution)
    pole = _pole(state)
    by = np.zeros((3, len(names)))
    for k, name in enumerate(names):
        size = STEP * (np.linalg.norm(state.w) if name.startswith("w_") else 1.0)
        ends = [_pole(_moved(solution, state, name, sign * size)) for sign in (1.0, -1.0)]
        by[:, k] = (ends[0] - ends[1]) / (2.0 * size)
    known = np.isfinite(np.diag(covariance))
    by = by[:, known]
    factor = scale if scaled and np.isfinite(scale) else 1.0
    return pole, factor**2 * (by @ covariance[np.ix_(known, known)] @ by.T)


def _spin_of(solution: Any) -> tuple[SpinState, tuple[str, ...], np.ndarray, float]:
    if isinstance(solution, LightSolution):
        return (solution.body.spin, solution.names, solution.covariance, solution.error_scale)
    if isinstance(solution, SpinSolution):
        return solution.state, solution.names, solution.covariance, solution.error_scale
    found = solution._results._compiled.raw(solution._place)
    n = len(found["names"])
    covariance = np.asarray(found["covariance"]).reshape(n, n)
    return solution.state, found["names"], covariance, solution.error_factor or 1.0


def _pole(state: SpinState) -> np.ndarray:
    w, x, y, z = state.q / np.linalg.norm(state.q)
    g = state.inertia @ state.w
    u = np.array([x, y, z])
    turned = g + 2.0 * np.cross(u, np.cross(u, g) + w * g)
    return turned / np.linalg.norm(turned)


def _moved(solution: Any, state: SpinState, name: str, by: float) -> SpinState:
    """The state with one unknown changed."""
    q, w, I = state.q.copy(), state.w.copy(), state.inertia.copy()
    axis = "xyz".find(name[-1])
    if name.startswith("turn_"):
        half = np.zeros(4)
        half[0], half[1 + axis] = np.cos(0.5 * by), np.sin(0.5 * by)
        q = _times(q, half)
    elif name.startswith("w_"):
        w[axis] += by
    elif name.startswith("I") and name.endswith("/Izz"):
        i, k = "xyz".index(name[1]), "xyz".index(name[2])
        I[i, k] += by * I[2, 2]
        I[k, i] = I[i, k]
    elif name in ("b/a", "c/b") and np.isclose(_even(solution), I / I[2, 2]).all():
        a, b, c = solution.body.shape
        ratios = {"b/a": b / a, "c/b": c / b}
        ratios[name] += by
        I = _tensor(ratios["b/a"], ratios["b/a"] * ratios["c/b"])
    return SpinState(q, w, I, state.t0)


def _even(solution: Any) -> np.ndarray:
    """The tensor of an even filling, over Izz."""
    a, b, c = solution.body.shape
    return _tensor(b / a, c / a)


def _tensor(b: float, c: float) -> np.ndarray:
    return np.diag([b * b + c * c, 1.0 + c * c, 1.0 + b * b]) / (1.0 + b * b)


def _times(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    u, v = a[1:], b[1:]
    return np.append(a[0] * b[0] - u @ v, a[0] * v + b[0] * u + np.cross(u, v))


def _ellipse(pole: np.ndarray, covariance: np.ndarray) -> np.ndarray | None:
    """(CIRCLE, 3) on the sphere, along great circles from the pole; None for one without size."""
    values, vectors = np.linalg.eigh(covariance)
    if not np.isfinite(values).all() or values[-1] <= SMALLEST**2:
        return None
    axes = vectors[:, 1:] * np.sqrt(np.maximum(values[1:], 0.0))
    turn = np.linspace(0.0, 2.0 * np.pi, CIRCLE)
    steps = np.cos(turn)[:, None] * axes[:, 0] + np.sin(turn)[:, None] * axes[:, 1]
    steps -= (steps @ pole)[:, None] * pole
    length = np.linalg.norm(steps, axis=1, keepdims=True)
    way = np.minimum(length, np.pi)
    return np.cos(way) * pole + np.sin(way) * steps / np.maximum(length, SMALLEST)


def _places(directions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    x, y, z = directions.T
    longitude = np.mod(np.arctan2(y, x), 2.0 * np.pi) - np.pi
    return longitude, np.arctan2(z, np.hypot(x, y))


def _solutions(given: Any) -> list[Any]:
    if isinstance(given, FitResults) or hasattr(given, "solutions"):
        return list(given.solutions)
    found = list(given) if isinstance(given, Iterable) else [given]
    for one in found:
        if not hasattr(one, "chi_square"):
            raise TypeError(f"pole_sky: got {one!r}; expected a solution of a fit")
    return found
