# SPDX-License-Identifier: MIT
"""Poinsot's curves: polhode on the energy ellipsoid, herpolhode on the invariable plane."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from polhode import Body, FreeRotation, kinetic_energy, to_andoyer
from polhode._core import _number
from polhode.charts import inertial_angular_velocity, inertial_momentum
from polhode.figures import arrows, polhodes, style
from polhode.figures.momentum_sphere import (
    DEFAULT_VIEW,
    FORESHORTENED,
    LABELS,
    body_axes,
    curve,
    frame_picture,
)
from polhode.figures.view import Ellipsoid, View
from polhode.free import Regime

CONTEXT = style.Look("#9A9A9A", "-", 0.5)
BORDER = style.Look(style.BLACK, "-", 0.9)


def require_rotation(name: str, motion: FreeRotation) -> None:
    if not motion.energy > 0.0:
        raise ValueError(f"{name}: got a body at rest; expected a motion with energy above 0")


def energy_ellipsoid(body: Body, energy: float) -> Ellipsoid:
    """Where the tip of the angular velocity (body axes) is at this energy: sum I_k w_k^2 = 2T."""
    return Ellipsoid(tuple(np.sqrt(2.0 * energy / body.moments)))


def at_energy(body: Body, g: NDArray[np.float64], energy: float) -> NDArray[np.float64]:
    """Angular velocities (n, 3) of the motion through g (n, 3), scaled to this energy."""
    own = kinetic_energy(body, polhodes.states_of(g[0]))
    return np.sqrt(energy / own) * g / body.moments


def invariable_axes(motion: FreeRotation) -> NDArray[np.float64]:
    """Rows e1, e2, e3 (inertial components): e3 along the momentum, e1 along the node i of the
    invariable plane in the inertial one (s1 turned by Andoyer's h)."""
    h = to_andoyer(motion.initial_state).h
    e3 = np.asarray(inertial_momentum(motion.initial_state)) / motion.momentum
    e1 = np.array([np.cos(h), np.sin(h), 0.0])
    return np.array([e1, np.cross(e3, e1), e3])


def herpolhode_times(motion: FreeRotation, periods: float, per_turn: int) -> NDArray[np.float64]:
    """Times that cover `periods` polhode periods; on the separatrix, the flip and its approach.

    per_turn: how many in a turn about the momentum, and at least in a polhode period."""
    periods = _number(periods, "periods")
    span = motion.polhode_period
    if motion.regime == Regime.separatrix:
        half = 9.0 / polhodes.separatrix_rate(motion.body, motion.momentum)
        middle = np.sort(motion.body.moments)[1]
        turns = motion.momentum / middle * 2.0 * half / (2.0 * np.pi)
        return motion.epoch + np.linspace(-half, half, int(per_turn * (2.0 + turns)) + 1)
    if motion.regime == Regime.steady or not np.isfinite(span):
        return np.array([motion.epoch])
    turns = motion.precession_rate_short * span / (2.0 * np.pi)
    return motion.epoch + span * np.linspace(
        0.0, periods, int(periods * per_turn * (1.0 + turns)) + 1
    )


def herpolhode_points(
    motion: FreeRotation, periods: float = 3.0, per_turn: int = 180
) -> NDArray[np.float64]:
    """(n, 3): the angular velocity along invariable_axes(motion); the third component is 2T/G."""
    states = motion.at(herpolhode_times(motion, periods, per_turn))
    return inertial_angular_velocity(motion.body, states) @ invariable_axes(motion).T


def herpolhode_radii(motion: FreeRotation) -> tuple[float, float]:
    """The circles that a herpolhode touches: least and greatest |omega| across the momentum.

    They belong to the points where the polhode crosses the planes of symmetry: there two squares of
    the momentum follow from G and T, the third being 0. [SA (12)]"""
    body, T = motion.body, motion.energy
    if motion.regime in (Regime.steady, Regime.rest):
        g = np.asarray(motion.initial_state.g)[None, :]
    else:
        g = crossings(motion)
    along = 2.0 * T / motion.momentum
    across = np.sqrt(np.maximum(np.sum((g / body.moments) ** 2, axis=-1) - along**2, 0.0))
    return float(across.min()), float(across.max())


def crossings(motion: FreeRotation) -> NDArray[np.float64]:
    """Momenta (2, 3) where the polhode crosses the two planes of symmetry that hold its axis.

    On the separatrix the second is its limit, the intermediate axis."""
    i, j, k = polhodes.sorted_axes(motion.body)
    I = motion.body.moments
    D = motion.momentum**2 - 2.0 * motion.energy * I  # D1, D2, D3' with the sign of G^2 - 2 T I
    found = np.zeros((2, 3))
    other = k if motion.circulates_long_axis else i
    pole = i if motion.circulates_long_axis else k
    for row, across in enumerate((other, j)):
        # g_across^2 + g_pole^2 = G^2 and its energy: one share is D_pole / (D_pole - D_across) ...
        share = I[across] * D[pole] / (I[across] - I[pole])
        rest = I[pole] * D[across] / (I[pole] - I[across])
        found[row, across] = np.sqrt(max(share, 0.0))
        found[row, pole] = np.sqrt(max(rest, 0.0))
    return found


def nearest_distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Least distance of two sets of points (n, 3), (m, 3), thinned."""
    a, b = a[::6], b[::6]
    return float(np.min(np.linalg.norm(a[:, None, :] - b[None, :, :], axis=-1)))


@style.styled
def polhode_on_ellipsoid(
    motion: FreeRotation, view: View = DEFAULT_VIEW, ax: Axes | None = None
) -> Axes:
    """The polhode of a motion on its energy ellipsoid, among the polhodes of equal energy.

    The tip of the angular velocity omega_B = I^-1 g [SA (24)] stays on I1 w1^2 + I2 w2^2 + I3 w3^2
    = 2T [SA "kinetic"], and |g| = G. Thick: the motion, once round, exact, with the sense of
    motion; black: the separatrix; grey: other motions of this energy. Arrow: omega at the epoch.
    Returns the Axes."""
    require_rotation("polhode_on_ellipsoid", motion)
    ax = style.plane_axes(ax)
    body, T = motion.body, motion.energy
    surface = energy_ellipsoid(body, T)
    reach = np.array(surface.semi_axes)
    surface.draw(ax, view)
    beyond = 1.0 + 0.3 * reach.max() / reach
    frame_picture(ax, view, surface.outline(view), np.diag(beyond * reach))
    own = polhodes.polhode(motion)
    omega = own.points / body.moments
    for other in polhodes.family(body, 1.0, 4, 3):
        points = at_energy(body, other.points, T)
        if nearest_distance(points, omega) > 0.07 * reach.max():
            curve(ax, view, surface, points, CONTEXT, 2.0, "context")
    for other in polhodes.separatrix(body, 1.0):
        curve(ax, view, surface, at_energy(body, other.points, T), BORDER, 2.2, "separatrix")
    look = style.regime_look(motion.regime)
    thick = style.Look(look.color, look.linestyle, 2.0)
    curve(ax, view, surface, omega, thick, 3.2, "polhode")
    if len(omega) > 1:
        rate = polhodes.momentum_rate(body, own.points) / body.moments
        sense(ax, view, surface, omega, rate, look.color)
    body_axes(ax, view, reach, beyond, [rf"$\omega_{k}$" for k in (1, 2, 3)])
    tip = view.paper(np.asarray(motion.initial_state.g) / body.moments)
    arrows.arrow(ax, (0.0, 0.0), tip, "black", size=9.0, linewidth=1.2, zorder=5.0)
    return ax


def sense(
    ax: Axes,
    view: View,
    surface: Ellipsoid,
    points: NDArray[np.float64],
    rate: NDArray[np.float64],
    color: str,
) -> list[Any]:
    """Two heads on the near part of a curve, along its rate."""
    near = np.flatnonzero(surface.facing(view, points) * min(surface.semi_axes) > FORESHORTENED)
    if len(near) < 6:
        return []
    chosen = near[[(3 * len(near)) // 10, (3 * len(near)) // 4]]
    return [
        arrows.head(ax, view.paper(points[k]), view.paper(rate[k]), color, size=10.0)
        for k in chosen
    ]


def midway(radius: NDArray[np.float64]) -> NDArray[np.intp]:
    """Where the curve goes outward through its mean radius, at most six times."""
    middle = 0.5 * (radius.min() + radius.max())
    return np.flatnonzero((radius[:-1] < middle) & (radius[1:] >= middle))[:6]


@style.styled
def herpolhode(
    motion: FreeRotation, periods: float = 3.0, unit: str = "", ax: Axes | None = None
) -> Axes:
    """The herpolhode: the path of the angular velocity in the invariable plane.

    `periods` polhode periods of the exact motion are drawn; on the separatrix, the whole flip.
    Axes: components along the node of the plane and across it, in space; unit is their unit (rad/s,
    say) for the labels. Dotted: the circles between which the curve runs; a dot where it starts.
    The component along the momentum is constant, 2T/G [SA "kinetic"]. Returns the Axes."""
    require_rotation("herpolhode", motion)
    ax = style.axes_or_new(ax, height=style.SINGLE_COLUMN)
    points = herpolhode_points(motion, periods)
    look = style.regime_look(motion.regime)
    ax.set_aspect("equal", adjustable="box")
    inner, outer = herpolhode_radii(motion)
    reach = 1.08 * (outer or 1.0)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    for radius in (inner, outer):
        turn = np.linspace(0.0, 2.0 * np.pi, 361)
        ax.plot(
            radius * np.cos(turn), radius * np.sin(turn), color=style.GREY, ls=style.DOTTED, lw=0.8
        )
    ax.plot(points[:, 0], points[:, 1], color=look.color, lw=0.8, ls="-", gid="herpolhode")
    ax.plot(*points[0, :2], "o", color="black", ms=3.5, zorder=5.0)
    ax.plot(0.0, 0.0, "+", color="black", ms=6.0)
    if len(points) > 1:
        for k in midway(np.hypot(points[:, 0], points[:, 1])):
            arrows.head(ax, points[k, :2], points[k + 1, :2] - points[k, :2], look.color, size=8.5)
    suffix = f" ({unit})" if unit else ""
    ax.set_xlabel(r"$\omega$ along the node $\mathbf{i}$" + suffix)
    ax.set_ylabel(r"$\omega$ across it" + suffix)
    return ax


@style.styled
def polhode_and_herpolhode(
    motion: FreeRotation,
    periods: float = 3.0,
    unit: str = "",
    view: View = DEFAULT_VIEW,
    ax: Sequence[Axes] | None = None,
) -> NDArray[Any]:
    """Polhode and herpolhode of one motion, side by side [SA (12), (24)].

    Poinsot's ellipsoid rolls on the invariable plane along these two curves, without slipping.

    periods: how many polhode periods of the herpolhode; unit: that of the angular velocity, for its
    labels. ax: two Axes, or None for a new figure. Returns an array of the two Axes."""
    size = (style.DOUBLE_COLUMN, 0.5 * style.DOUBLE_COLUMN)
    left, right = style.panels(ax, 1, 2, size).ravel()
    polhode_on_ellipsoid(motion, view, ax=left)
    herpolhode(motion, periods, unit, ax=right)
    look = style.regime_look(motion.regime)
    name = LABELS.get(motion.regime, motion.regime.name)
    handles = [Line2D([], [], color=look.color, ls=look.linestyle, lw=2.0, label=name)]
    if polhodes.separatrix(motion.body, 1.0) and motion.regime != Regime.separatrix:
        handles.append(Line2D([], [], **BORDER.line, label="separatrix"))
    left.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.02), ncols=2)
    style.panel_label(left, "(a)")
    style.panel_label(right, "(b)")
    return np.array([left, right], dtype=object)
