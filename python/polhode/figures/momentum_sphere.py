# SPDX-License-Identifier: MIT
"""The phase flow of free rotation on the momentum sphere [SA Fig. 1]."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from polhode import Body, RotorState
from polhode._arguments import require_positive
from polhode._core import _numbers
from polhode.figures import arrows, polhodes, style
from polhode.figures.labels import HALO
from polhode.figures.view import Ellipsoid, View, parts, sphere
from polhode.free import Regime

LABELS = {
    Regime.short_axis: "short-axis mode",
    Regime.long_axis: "long-axis mode",
    Regime.separatrix: "separatrix",
}
DEFAULT_VIEW = View(26.0, 34.0)
FORESHORTENED = 0.2
"""Cosine of the view to the surface below which no arrow head is put."""
TRACE = style.Look(style.GREEN, "-", 2.4)
THIN_TRACE = style.Look(style.GREEN, "-", 0.9)
POINTS = style.Look(style.GREEN, "None", 1.0, ".")
RING = style.Look(style.GREEN, "None", 1.0, "o")
COARSE, SMALL = 0.3, 0.05
"""Steps of a run, in radii, above which no line joins them; reach below which it is a point."""


def curve(
    ax: Axes,
    view: View,
    surface: Ellipsoid,
    points: NDArray[np.float64],
    look: style.Look,
    zorder: float = 2.0,
    gid: str | None = None,
) -> tuple[Line2D, Line2D]:
    """A curve (n, 3) on a surface: the near part, and the far part thin and pale. Both lines."""
    near, far = parts(view.paper(points), surface.facing(view, points) < 0.0)
    behind = {**look.line, "linewidth": 0.55 * look.linewidth, "alpha": style.HIDDEN_ALPHA}
    (seen,) = ax.plot(*near.T, **look.line, zorder=zorder, solid_capstyle="round")
    (hidden,) = ax.plot(*far.T, **behind, zorder=zorder - 1.0)
    for line, part in ((seen, "near"), (hidden, "far")):
        line.set_gid(None if gid is None else f"{gid}-{part}")
    return seen, hidden


def flow_arrow(
    ax: Axes,
    view: View,
    surface: Ellipsoid,
    points: NDArray[np.float64],
    rate: NDArray[np.float64],
    color: str,
    size: float = 8.0,
) -> Any:
    """An arrow head where the curve is nearest to the eye, along the projected rate (n, 3)."""
    facing = surface.facing(view, points) * min(surface.semi_axes)
    inside = np.linspace(-1.0, 1.0, len(points))
    if np.linalg.norm(points[-1] - points[0]) > 1e-3 * max(surface.semi_axes):
        facing = np.where(
            np.abs(inside) < 0.6, facing, -1.0
        )  # open: not at the ends, where it stops
    nearest = int(np.argmax(facing))
    if facing[nearest] < FORESHORTENED:
        return None
    return arrows.head(ax, view.paper(points[nearest]), view.paper(rate[nearest]), color, size)


def body_axes(
    ax: Axes, view: View, reach: Sequence[float], beyond: float, names: Sequence[str]
) -> None:
    """The axes from the centre, dotted inside the surface, to `beyond` times their reach."""
    for unit, length, name in zip(np.eye(3), reach, names):
        foot, tip = view.paper(length * unit), view.paper(beyond * length * unit)
        ax.plot(
            *np.stack([[0.0, 0.0], foot]).T, color=style.GREY, lw=0.6, ls=style.DOTTED, zorder=1.5
        )
        arrows.arrow(ax, foot, tip, size=8.0, linewidth=0.8)
        label = tip + 0.07 * max(reach) * tip / max(np.linalg.norm(tip), 1e-12)
        ax.text(*label, name, ha="center", va="center", fontsize=9.0, zorder=6.0, path_effects=HALO)


def mark_steady(ax: Axes, view: View, surface: Ellipsoid, body: Body, G: float) -> None:
    """Full circles where steady rotation is stable, open ones where it is not; near side only."""
    for point, stable in polhodes.steady_points(body, G):
        if surface.facing(view, point) > 0.0:
            face = "black" if stable else "white"
            ax.plot(*view.paper(point), "o", ms=3.2, mfc=face, mec="black", mew=0.8, zorder=5.0)


def frame_picture(
    ax: Axes, view: View, outline: NDArray[np.float64], tips: NDArray[np.float64]
) -> None:
    """Limits that hold the outline and the labelled tips of the axes."""
    corners = np.concatenate([view.paper(outline), 1.08 * view.paper(tips)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 0.04 * float(np.max(high - low))
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)


def legend(
    ax: Axes,
    present: Sequence[Regime],
    extra: Sequence[Line2D] = (),
    anchor: tuple[float, float] = (0.5, 0.02),
) -> None:
    """Names the kinds of curves, in one row below the picture."""
    handles = [
        Line2D([], [], **style.regime_look(regime).line, label=LABELS[regime])
        for regime in LABELS
        if regime in present
    ]
    ax.legend(
        handles=[*handles, *extra],
        loc="upper center",
        bbox_to_anchor=anchor,
        ncols=3 if len(handles) + len(extra) == 3 else 2,
        columnspacing=1.2,
        handlelength=2.4,
    )


def momenta(function: str, trace: ArrayLike | RotorState) -> NDArray[np.float64]:
    """The rows (n, 3) of a trace: of momenta, or of hub states, of any shape; one is a row, too."""
    given = trace.g if isinstance(trace, RotorState) else trace
    required = "expected momenta of shape (n, 3), at least one, or a RotorState"
    if isinstance(given, str):
        raise TypeError(f"{function}: got trace = {trace!r}; {required}")
    g = _numbers(given, f"{function}: trace")
    if g.ndim == 0 or g.shape[-1] != 3 or g.size == 0:
        raise ValueError(f"{function}: got a trace of shape {g.shape}; {required}")
    return g.reshape(-1, 3)


def trace_look(g: NDArray[np.float64]) -> style.Look:
    """How the momenta (n, 3) of a run are drawn: a thick line; points where the rows are too far
    apart for one; a ring round a momentum that hardly moves."""
    G = np.linalg.norm(g[0])
    if len(g) > 1 and np.median(np.linalg.norm(np.diff(g, axis=0), axis=-1)) > COARSE * G:
        return POINTS
    return RING if np.linalg.norm(g - g[0], axis=-1).max() < SMALL * G else TRACE


def as_marked(line: Line2D, look: style.Look) -> Line2D:
    """The line as points, or as a ring, where the look is one of them."""
    if look is POINTS:
        line.set(marker=".", markersize=3.0, zorder=4.0)
    elif look is RING:
        line.set(marker="o", markersize=7.0, mfc="none", mew=1.5, zorder=6.0)
    return line


def draw_trace(ax: Axes, view: View, ball: Ellipsoid, body: Body, g: NDArray[np.float64]) -> Line2D:
    """The momenta (n, 3) of a run; the handle for the legend."""
    look, said = trace_look(g), "this motion"
    drawn = [g[:1]] if look is RING else polhodes.excerpts(body, g) if look is TRACE else [g]
    if len(drawn) > 1:
        look, said = THIN_TRACE, "parts of this motion"
    for part in drawn:
        for line in curve(ax, view, ball, part, look, zorder=3.0, gid="trace"):
            as_marked(line, look)
    return as_marked(Line2D([], [], **look.line, label=said), look)


@style.styled
def momentum_sphere(
    body: Body,
    G: float = 1.0,
    trace: ArrayLike | RotorState | None = None,
    short_axis: int = 5,
    long_axis: int = 4,
    view: View = DEFAULT_VIEW,
    ax: Axes | None = None,
) -> Axes:
    """The momentum sphere with the polhodes of a body: the phase flow of free rotation [SA Fig. 1].

    The momentum g keeps its length in the body, g_1^2 + g_2^2 + g_3^2 = G^2 [SA "sphere"], and
    moves along the curves of constant energy g_1^2/I1 + g_2^2/I2 + g_3^2/I3 = 2T [SA "kinetic"] at
    the rate g x I^-1 g [SA (12)], in the sense of the arrows. Every curve is the exact motion over
    one period; the separatrix 2 T I2 = G^2 is its closed form. Lines on the far side are thin and
    pale.

    body: whose polhodes; G: radius of the sphere. trace (n, 3): momentum of a run, or its states,
    drawn thick on its sphere, as points where its rows are far apart, and, where it would paint the
    sphere, by some of its circuits. short_axis, long_axis: how
    many curves about each end. Returns the Axes. ValueError unless G is positive, and for a trace
    of another shape."""
    require_positive("momentum_sphere", "G", G)
    run = None if trace is None else momenta("momentum_sphere", trace)
    ax = style.plane_axes(ax)
    ball = sphere(G)
    ball.draw(ax, view)
    frame_picture(ax, view, ball.outline(view), 1.32 * G * np.eye(3))
    curves = [*polhodes.family(body, G, short_axis, long_axis), *polhodes.separatrix(body, G)]
    for number, drawn in enumerate(curves):
        look = style.regime_look(drawn.regime)
        curve(ax, view, ball, drawn.points, look, gid=f"polhode-{number}")
        if run is None or drawn.regime == Regime.separatrix:
            rate = polhodes.momentum_rate(body, drawn.points)
            size = 11.5 if drawn.regime == Regime.separatrix else 8.5
            flow_arrow(ax, view, ball, drawn.points, rate, look.color, size)
    mark_steady(ax, view, ball, body, G)
    body_axes(ax, view, (G, G, G), 1.32, (r"$\mathbf{b}_1$", r"$\mathbf{b}_2$", r"$\mathbf{b}_3$"))
    extra = [] if run is None else [draw_trace(ax, view, ball, body, run)]
    legend(ax, [drawn.regime for drawn in curves], extra)
    return ax
