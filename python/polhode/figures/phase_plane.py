# SPDX-License-Identifier: MIT
"""The phase plane (l, L) of free rotation in Andoyer variables [SA Fig. 4]."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from polhode import AndoyerState, Body, RotorState, kinetic_energy, to_andoyer, to_rotor
from polhode._arguments import require_positive
from polhode.figures import arrows, polhodes, style
from polhode.figures.momentum_sphere import as_marked, legend, momenta, trace_look
from polhode.free import Regime

QUARTER = 0.5 * np.pi
LONG_AXIS_FILL = "#FBE9DB"


def plane_points(g: ArrayLike, G: float) -> NDArray[np.float64]:
    """(l / (pi/2), L / G) of momenta g (n, 3), as to_andoyer gives them, l without jumps."""
    chart = to_andoyer(polhodes.states_of(g))
    return np.stack([np.unwrap(chart.l) / QUARTER, np.asarray(chart.L) / G], axis=-1)


def plane_rate(body: Body, g: NDArray[np.float64], G: float) -> NDArray[np.float64]:
    """Time derivative (n, 2) of plane_points: l = atan2(g1, g2), L = g3 [SA (1490)-(1492)]."""
    rate = polhodes.momentum_rate(body, g)
    across = g[..., 0] ** 2 + g[..., 1] ** 2
    l_rate = (rate[..., 0] * g[..., 1] - rate[..., 1] * g[..., 0]) / across
    return np.stack([l_rate / QUARTER, rate[..., 2] / G], axis=-1)


def copies(points: NDArray[np.float64], turn: float = 4.0) -> list[NDArray[np.float64]]:
    """The curve shifted by whole turns of l, wherever it is inside -2 <= l / (pi/2) <= 2."""
    low, high = points[:, 0].min(), points[:, 0].max()
    shifts = turn * np.arange(-3, 4)
    return [points + [s, 0.0] for s in shifts if high + s >= -2.0 - 1e-9 and low + s <= 2.0 + 1e-9]


def shade_long_axis(ax: Axes, body: Body) -> None:
    """Fills where 2 T I2 > G^2: the long-axis mode. With I1 = I2 there is none."""
    least, middle, _ = np.sort(body.moments)
    if least == middle:
        return
    x, y = np.meshgrid(np.linspace(-2.0, 2.0, 401), np.linspace(-1.0, 1.0, 201))
    states = to_rotor(AndoyerState(l=QUARTER * x, g=0.0, h=0.0, L=y, G=1.0, H=0.0))
    share = 2.0 * np.asarray(kinetic_energy(body, states)) * middle
    ax.contourf(x, y, share, levels=[1.0, np.inf], colors=[LONG_AXIS_FILL], zorder=0.0)


def draw_curve(
    ax: Axes, points: NDArray[np.float64], look: style.Look, gid: str, zorder: float
) -> list[Line2D]:
    return [
        ax.plot(*piece.T, **look.line, zorder=zorder, gid=gid, solid_capstyle="round")[0]
        for piece in copies(points)
    ]


def draw_arrow(
    ax: Axes, points: NDArray[np.float64], rate: NDArray[np.float64], color: str, closed: bool
) -> Any:
    """One head: in the middle of an open arc, where a circulating curve crosses l = 0, or where L
    is largest on a lobe."""
    circulates = np.ptp(points[:, 0]) > 2.0 + 1e-9
    home = np.stack([(points[:, 0] + 2.0) % 4.0 - 2.0, points[:, 1]], axis=-1)
    if not closed:
        where = len(points) // 2
    elif circulates:
        where = int(np.argmin(np.abs(home[:, 0])))
    else:
        where = int(np.argmax(points[:, 1]))
    return arrows.head(ax, home[where], rate[where], color, 8.5 if closed else 11.0)


def mark_steady(ax: Axes, body: Body, G: float) -> None:
    """Full circles where steady rotation is stable, open ones where not; b3 is the edge L = +-G."""
    for point, stable in polhodes.steady_points(body, G):
        if abs(point[2]) == G:
            continue
        face = "black" if stable else "white"
        for piece in copies(plane_points(point[None, :], G)):
            ax.plot(
                *piece.T, "o", ms=3.4, mfc=face, mec="black", mew=0.8, zorder=6.0, clip_on=False
            )


@style.styled
def phase_plane(
    body: Body,
    G: float = 1.0,
    trace: ArrayLike | RotorState | None = None,
    short_axis: int = 5,
    long_axis: int = 4,
    ax: Axes | None = None,
) -> Axes:
    """The plane of Andoyer's l and L with the curves of equal energy of a body [SA Fig. 4].

    T = (G^2 - L^2)/2 (sin^2 l / I1 + cos^2 l / I2) + L^2 / (2 I3): l circulates in the short-axis
    mode and librates about +-pi/2 in the long-axis mode (shaded). Every curve is the exact motion
    over one period, read in Andoyer variables; the separatrix 2 T I2 = G^2 is its closed form.
    (Regions are so named for a body with I1 <= I2 <= I3; other orders are drawn correctly, too.)

    Axes: l in units of pi/2, L in units of G. G: size of the momentum. trace (n, 3): momentum of a
    run, or its states, drawn thick, or as points where its rows are far apart. short_axis,
    long_axis: how many curves about each end. Returns the Axes. ValueError unless G is positive,
    and for a trace of another shape."""
    require_positive("phase_plane", "G", G)
    run = None if trace is None else momenta("phase_plane", trace)
    ax = style.axes_or_new(ax, height=0.86 * style.SINGLE_COLUMN)
    ax.set_xlim(-2.0, 2.0)
    ax.set_ylim(-1.0, 1.0)
    shade_long_axis(ax, body)
    curves = [
        *polhodes.family(body, G, short_axis, long_axis, even="height"),
        *polhodes.separatrix(body, G),
    ]
    for number, drawn in enumerate(curves):
        look = style.regime_look(drawn.regime)
        points = plane_points(drawn.points, G)
        zorder = 3.0 if drawn.regime == Regime.separatrix else 2.0
        draw_curve(ax, points, look, f"polhode-{number}", zorder)
        draw_arrow(ax, points, plane_rate(body, drawn.points, G), look.color, drawn.closed)
    extra = []
    if run is not None:
        look = trace_look(run)
        for line in draw_curve(ax, plane_points(run, G), look, "trace", 4.0):
            as_marked(line, look)
        extra.append(as_marked(Line2D([], [], **look.line, label="this motion"), look))
    mark_steady(ax, body, G)
    ax.set_xlabel(r"$l \,/\, (\pi/2)$")
    ax.set_ylabel(r"$L \,/\, G$")
    ax.set_xticks(range(-2, 3))
    ax.set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    legend(ax, [drawn.regime for drawn in curves], extra, anchor=(0.5, -0.17))
    return ax
