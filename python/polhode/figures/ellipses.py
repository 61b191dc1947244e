# SPDX-License-Identifier: MIT
"""A perturbed orbit as a sequence of instantaneous ellipses, computed [SA Figs. 5 and 6]."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from numpy.typing import ArrayLike, NDArray

from polhode._core import _numbers
from polhode.figures import arrows, style
from polhode.figures.oblate_planet import Ellipse, OblatePlanet, Path, ellipse
from polhode.figures.view import Ellipsoid, View, parts

VIEW = View(elevation=20.0, azimuth=55.0)
PLANET_RADIUS = 0.17
ARROW = 0.55
"""Length of an arrow for a speed of one, in the unit of length of the path."""
ARC = np.radians(50.0)
"""How far an ellipse is drawn to both sides of the satellite, in eccentric anomaly."""
NON_OSCULATING = style.Look(style.VERMILLION, style.DASHED, 0.9)
OSCULATING = style.Look(style.BLUE, style.DASHED, 0.9)
ORBIT = style.Look(style.BLACK, "-", 1.3)
VELOCITY, KEPLERIAN = r"$\dot{\mathbf{r}}$", r"$\mathbf{g}$"


def precessing_planet(rate: float = 0.2, J2: float = 0.01, obliquity: float = 25.0) -> OblatePlanet:
    """gm = 1, J2 R^2 = J2; the equator goes round the ecliptic's normal at -rate (rad per time).

    For a satellite at distance 1, whose mean motion is 1; `obliquity` in degrees."""
    tilt = np.radians(obliquity)
    return OblatePlanet(1.0, J2, (0.0, -rate * float(np.sin(tilt)), -rate * float(np.cos(tilt))))


def example_orbit() -> Path:
    """The orbit of the figures: nearly polar, from pericentre at 0.62, for one Kepler period."""
    planet, r, tilt = precessing_planet(), np.array([-0.62, 0.0, 0.0]), np.radians(70.0)
    p = 1.47 * np.array([0.0, -np.cos(tilt), np.sin(tilt)])
    return planet.path(r, p, 2.0 * np.pi * ellipse(r, p, planet.gm).a ** 1.5)


def instantaneous_ellipse(path: Path, t: float, osculating: bool) -> Ellipse:
    """The ellipse through the satellite at t: of r' if it shall osculate, else of the momentum."""
    v = path.velocity(t) if osculating else path.momentum(t)
    return ellipse(path.position(t), v, path.planet.gm)


@style.styled
def orbit_ellipses(
    path: Path | None = None,
    times: ArrayLike | None = None,
    osculating: bool = False,
    ax: Axes | None = None,
    view: View = VIEW,
) -> Axes:
    """A perturbed orbit, and instantaneous ellipses through points of it [SA Figs. 5 and 6].

    The orbit is that of a satellite of a precessing oblate planet in the frame of its equator of
    date. With the canonical elements (osculating=False) the ellipses cut it: the Keplerian
    velocity g along the ellipse [SA (105)] is the velocity relative to inertial axes, and the
    velocity in the frame is r' = g - mu x r, g plus the convective term [SA (104), (107)]. With
    osculating elements the ellipses touch the orbit, and both velocities are one.

    path: from OblatePlanet.path; None: that of the paper's figures, with the precession much
    exaggerated. times: when the ellipses are drawn. Returns the Axes; lengths are true to scale,
    arrows are velocities."""
    path = example_orbit() if path is None else path
    if not isinstance(path, Path):
        raise TypeError(
            f"orbit_ellipses: got path = {path!r}; expected a path from OblatePlanet.path, or None"
        )
    stop = path.stop
    if times is None:
        times = stop * np.array([0.19, 0.35, 0.53, 0.7])
    times = np.atleast_1d(_numbers(times, "times"))
    ax = style.plane_axes(ax, style.SINGLE_COLUMN, 0.86 * style.SINGLE_COLUMN)
    look = OSCULATING if osculating else NON_OSCULATING
    _planet(ax, view)
    t = np.linspace(0.0, stop, 800)
    _curve(ax, view, path.position(t), ORBIT, 3.0, "orbit")
    for k, at in enumerate(times):
        drawn = instantaneous_ellipse(path, float(at), osculating)
        turn = drawn.anomaly + np.linspace(-ARC, ARC, 181)
        _curve(ax, view, drawn.at(turn), look, 2.0, f"ellipse-{k}")
        _velocities(ax, view, path, float(at), osculating)
    _limits(ax, view, path, times)
    end = path.position(stop)
    arrows.head(ax, view.paper(end), view.paper(path.velocity(stop)), style.BLACK, size=9.0)
    _legend(ax, look, osculating)
    return ax


def _limits(ax: Axes, view: View, path: Path, times: NDArray[np.float64]) -> None:
    """The same limits for both kinds of ellipses, so that the two figures compare."""
    points = [path.position(np.linspace(0.0, path.stop, 400))]
    for t in times:
        points += [path.position(t) + ARROW * np.stack([path.velocity(t), path.momentum(t)])]
        for osculating in (False, True):
            drawn = instantaneous_ellipse(path, float(t), osculating)
            points.append(drawn.at(drawn.anomaly + np.linspace(-ARC, ARC, 91)))
    paper = view.paper(np.concatenate(points))
    margin = 0.06 * np.ptp(paper, axis=0).max()
    ax.set_xlim(paper[:, 0].min() - margin, paper[:, 0].max() + margin)
    ax.set_ylim(paper[:, 1].min() - margin, paper[:, 1].max() + margin)


def _curve(
    ax: Axes, view: View, points: NDArray[np.float64], look: style.Look, zorder: float, gid: str
) -> None:
    seen, _ = parts(view.paper(points), _ball().hides(view, points))
    ax.plot(*seen.T, **look.line, zorder=zorder, gid=gid)


def _ball() -> Ellipsoid:
    return Ellipsoid((PLANET_RADIUS, PLANET_RADIUS, 0.82 * PLANET_RADIUS))


def _planet(ax: Axes, view: View) -> None:
    """The planet, its equator (of date: the plane of the frame), and its pole."""
    _ball().draw(ax, view, zorder=1.0)
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    equator = PLANET_RADIUS * np.stack([np.cos(turn), np.sin(turn), 0.0 * turn], axis=-1)
    near, _ = parts(view.paper(equator), _ball().facing(view, equator) < 0.0)
    ax.plot(*near.T, color=style.GREY, linewidth=0.6, zorder=1.5)
    foot, tip = PLANET_RADIUS * np.array([[0.0, 0.0, 0.82], [0.0, 0.0, 2.3]])
    arrows.arrow(
        ax, view.paper(foot), view.paper(tip), style.GREY, size=6.0, linewidth=0.6, zorder=1.6
    )
    ax.annotate(r"$\mathbf{s}_3$", tuple(view.paper(tip)), (-4, -2), textcoords="offset points",
                ha="right", va="center", color=style.GREY)  # fmt: skip


def _velocities(ax: Axes, view: View, path: Path, t: float, osculating: bool) -> None:
    """r', and g where it is another vector, from the satellite."""
    r = path.position(t)
    ax.plot(*view.paper(r), "o", color=style.BLACK, markersize=3.0, zorder=5.0)
    velocity, momentum = path.velocity(t), path.momentum(t)
    drawn = [(velocity, momentum, style.BLACK, VELOCITY)]
    if osculating:
        drawn[0] = (velocity, -r, style.BLACK, f"{VELOCITY} $=$ {KEPLERIAN}")
    else:
        drawn.append((momentum, velocity, NON_OSCULATING.color, KEPLERIAN))
    for v, other, color, name in drawn:
        tail, tip = view.paper(r), view.paper(r + ARROW * v)
        arrows.arrow(ax, tail, tip, color, size=7.0, linewidth=1.0, zorder=4.5)
        _name_arrow(ax, tail, tip, view.paper(other), name, color)


def _name_arrow(
    ax: Axes,
    tail: NDArray[np.float64],
    tip: NDArray[np.float64],
    other: NDArray[np.float64],
    name: str,
    color: str,
) -> None:
    """A name next to the tip, on the side away from another arrow."""
    along = (tip - tail) / np.linalg.norm(tip - tail)
    across = np.array([-along[1], along[0]])
    across = -across if across @ other > 0.0 else across
    x, y = 6.0 * across + 1.0 * along
    side = "left" if across[0] > 0.4 else "right" if across[0] < -0.4 else "center"
    text = ax.annotate(
        name, tuple(tip), (x, y), textcoords="offset points", color=color, ha=side, va="center",
        fontsize=8.5, zorder=6.0,
    )  # fmt: skip
    text.set_path_effects([withStroke(linewidth=2.0, foreground="white")])


def _legend(ax: Axes, look: style.Look, osculating: bool) -> None:
    kind = "osculating" if osculating else "non-osculating"
    handles = [
        Line2D([], [], **ORBIT.line, label="orbit"),
        Line2D([], [], **look.line, label=f"{kind} ellipses"),
    ]
    ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=2)
