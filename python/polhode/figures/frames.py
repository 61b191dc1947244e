# SPDX-License-Identifier: MIT
"""The three planes of a rotating body, their nodes and the angles between them [SA Figs. 2, 3]."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from polhode import RotorState, to_andoyer, to_euler
from polhode.charts import attitude_matrix
from polhode.figures import arrows, style
from polhode.figures.arrows import turned
from polhode.figures.labels import Label, write
from polhode.figures.planes import Disc, hidden, paint
from polhode.figures.view import View, parts

INERTIAL = style.Look(style.BLACK, "-", 0.8)
INVARIABLE = style.Look(style.BLUE, style.DASHED, 1.1)
EQUATOR = style.Look(style.VERMILLION, style.DASH_DOT, 1.3)
EULER = style.Look(style.GREEN, "-", 1.0)
AXIS, MOMENTUM, MARGIN = 1.2, 1.3, 0.2
"""Lengths of the axes and of the momentum, and room for labels, in radii of the discs."""
FILLS = {"inertial": "#F0F0F0", "invariable": "#D6E7F3", "equator": "#F0C8A9"}
SETS = {"andoyer": ("h", "I", "g", "J", "l"), "euler": ("phi", "theta", "psi")}


@dataclass(frozen=True)
class Angle:
    """An angle of a chart as an arc: from `start` (3,) by `value` (rad) about `axis` (3,)."""

    symbol: str
    axis: NDArray[np.float64]
    start: NDArray[np.float64]
    value: float
    radius: float
    look: style.Look

    def arc(self, count: int = 121) -> NDArray[np.float64]:
        """Points (count, 3) of the arc, in the order of growing size."""
        return self.radius * turned(self.axis, self.start, np.linspace(0.0, self.value, count))


@dataclass(frozen=True)
class Frames:
    """The axes (rows, in inertial components), nodes and angles of a state."""

    body: NDArray[np.float64]
    momentum: NDArray[np.float64]
    nodes: dict[str, NDArray[np.float64]]
    angles: dict[str, Angle]
    inertial: NDArray[np.float64] = field(default_factory=lambda: np.eye(3))


def frames_of(state: RotorState) -> Frames:
    """What the figure draws, built from the angles of the state's charts: nodes i = s1 turned by h
    about s3, j = i turned by g about G, l = s1 turned by phi about s3."""
    if state.shape != ():
        raise ValueError(f"frames_of: got states of shape {state.shape}; expected one state")
    andoyer, euler = to_andoyer(state), to_euler(state)
    if not andoyer.G > 0.0:
        raise ValueError(f"frames_of: got G = {andoyer.G}; expected a state with angular momentum")
    s1, _, s3 = np.eye(3)
    b = attitude_matrix(state.q)
    tilt_I = float(np.arccos(np.clip(andoyer.H / andoyer.G, -1.0, 1.0)))
    tilt_J = float(np.arccos(np.clip(andoyer.L / andoyer.G, -1.0, 1.0)))
    i = turned(s3, s1, andoyer.h)[0]
    G = turned(i, s3, tilt_I)[0]
    j = turned(G, i, andoyer.g)[0]
    l_node = turned(s3, s1, euler.phi)[0]
    arcs = {
        look: style.Look(look.color, "-", 1.0) for look in (INERTIAL, INVARIABLE, EQUATOR, EULER)
    }
    angles = {
        "h": Angle("$h$", s3, s1, andoyer.h, 0.66, arcs[INERTIAL]),
        "I": Angle("$I$", i, s3, tilt_I, 0.72, arcs[INERTIAL]),
        "g": Angle("$g$", G, i, andoyer.g, 0.72, arcs[INVARIABLE]),
        "J": Angle("$J$", j, G, tilt_J, 0.72, arcs[EQUATOR]),
        "l": Angle("$l$", b[2], j, andoyer.l, 0.66, arcs[EQUATOR]),
        "phi": Angle(r"$\phi$", s3, s1, euler.phi, 0.44, arcs[EULER]),
        "theta": Angle(r"$\theta$", l_node, s3, euler.theta, 0.5, arcs[EULER]),
        "psi": Angle(r"$\psi$", b[2], l_node, euler.psi, 0.44, arcs[EULER]),
    }
    return Frames(b, G, {"i": i, "j": j, "l": l_node}, angles)


def best_view(frames: Frames, names: list[str], nodes: list[str]) -> View:
    """The view that keeps what has a label furthest apart on paper, and no plane on edge."""
    points = [frames.angles[name].arc(3)[1] * 1.1 for name in names]
    points += [1.1 * frames.nodes[name] for name in nodes]
    points += [1.3 * axis for axis in [*frames.inertial, *frames.body, frames.momentum]]
    points = np.array(points)
    normals = np.array([frames.inertial[2], frames.body[2], frames.momentum])
    first, second = np.triu_indices(len(points), 1)
    rays = [frames.nodes[name] for name in nodes]
    rays = np.array(
        [*rays, *(-ray for ray in rays), *frames.inertial, *frames.body, frames.momentum]
    )
    best, best_score = View(), -np.inf
    for elevation in (18.0, 22.0, 26.0, 30.0, 34.0):
        for azimuth in np.arange(0.0, 360.0, 4.0):
            view = View(elevation, azimuth)
            paper = view.paper(points)
            apart = np.sort(np.linalg.norm(paper[first] - paper[second], axis=-1))[:4]
            open_planes = np.min(np.abs(normals @ view.toward))
            angles = np.sort(np.arctan2(*view.paper(rays).T))
            between = np.min(np.diff(np.append(angles, angles[0] + 2.0 * np.pi)))
            rising = view.paper(frames.momentum)[1]
            score = float(
                np.sum(np.minimum(apart, 0.3))
                + 1.5 * min(open_planes, 0.35)
                + 2.5 * min(between, 0.12)
                + 0.2 * rising
            )
            if score > best_score:
                best, best_score = view, score
    return best


class Picture:
    """Draws lines hidden by the discs, and remembers where they are for the labels."""

    def __init__(self, ax: Axes, view: View, discs: list[Disc], reach: NDArray[np.float64]) -> None:
        self.ax, self.view, self.discs = ax, view, discs
        self.labels: list[Label] = []
        self.taken: list[NDArray[np.float64]] = []
        paper = view.paper(reach)
        low, high = paper.min(axis=0), paper.max(axis=0)
        ax.set(xlim=(low[0] - MARGIN, high[0] + MARGIN), ylim=(low[1] - MARGIN, high[1] + MARGIN))

    def line(
        self, points: NDArray[np.float64], look: style.Look, gid: str, zorder: float = 3.0
    ) -> None:
        near, far = parts(self.view.paper(points), hidden(self.view, self.discs, points))
        behind = {**look.line, "linewidth": 0.6 * look.linewidth, "alpha": style.HIDDEN_ALPHA}
        self.ax.plot(*near.T, **look.line, zorder=zorder, gid=f"{gid}-near", solid_capstyle="butt")
        self.ax.plot(*far.T, **behind, zorder=2.0, gid=f"{gid}-far")
        self.taken.append(self.view.paper(points))

    def label(
        self, text: str, point: NDArray[np.float64], outward: NDArray[np.float64], color: str
    ) -> None:
        self.labels.append(Label(text, self.view.paper(point), self.view.paper(outward), color))

    def axis(
        self, tip: NDArray[np.float64], look: style.Look, text: str, gid: str, size: float
    ) -> None:
        shaft = tip * np.linspace(0.0, 1.0, 81)[:, None]
        self.line(shaft, look, gid)
        shown = look.color
        if hidden(self.view, self.discs, tip[None, :])[0]:
            shown = style.faded(look.color, style.HIDDEN_ALPHA)
        arrows.head(self.ax, self.view.paper(tip), self.view.paper(tip), shown, size, at=1.0)
        self.label(text, tip, tip, look.color)

    def angle(self, angle: Angle, gid: str) -> None:
        if abs(angle.value) < 1e-6:
            return
        points = angle.arc()
        self.line(points, angle.look, gid, zorder=3.5)
        paper = self.view.paper(points)
        arrows.head(
            self.ax, paper[-1], paper[-1] - paper[-4], angle.look.color, 7.0, at=1.0, zorder=4.5
        )
        self.label(
            angle.symbol, points[len(points) // 2], points[len(points) // 2], angle.look.color
        )


def draw_axes(picture: Picture, frames: Frames, with_momentum: bool) -> None:
    """The three triads: s thin, b thick, the momentum thickest."""
    for k in range(3):
        thin = style.Look(style.BLACK, "-", 0.8)
        picture.axis(AXIS * frames.inertial[k], thin, rf"$\mathbf{{s}}_{k + 1}$", f"s{k + 1}", 7.5)
    for k in range(3):
        body = style.Look(style.VERMILLION, "-", 1.3)
        picture.axis(AXIS * frames.body[k], body, rf"$\mathbf{{b}}_{k + 1}$", f"b{k + 1}", 9.0)
    if with_momentum:
        picture.axis(
            MOMENTUM * frames.momentum, style.Look(style.BLUE, "-", 1.9), r"$\mathbf{G}$", "G", 12.0
        )


def draw_nodes(picture: Picture, frames: Frames, names: list[str]) -> None:
    """The lines of nodes, with a dot where the rising node meets the rim."""
    for name in names:
        node = frames.nodes[name]
        both = node * np.linspace(-1.0, 1.0, 161)[:, None]
        picture.line(both, style.Look(style.GREY, style.DOTTED, 0.9), f"node-{name}")
        behind = hidden(picture.view, picture.discs, (1.0 + 1e-9) * node[None, :])[0]
        picture.ax.plot(
            *picture.view.paper(node),
            "o",
            ms=3.0,
            color=style.GREY if behind else "black",
            zorder=5.0,
        )
        picture.label(rf"$\mathbf{{{name}}}$", node, node, "black")


def planes_legend(ax: Axes, planes: dict[str, style.Look]) -> None:
    handles = [Line2D([], [], **look.line, label=name) for name, look in planes.items()]
    ax.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, 0.03),
        ncols=len(handles),
        columnspacing=1.2,
    )


@style.styled
def frames_and_angles(
    state: RotorState,
    angles: str = "andoyer",
    view: View | None = None,
    ax: Axes | None = None,
) -> Axes:
    """The three planes of a state, their nodes and the angles between them [SA Figs. 2, 3].

    Planes: inertial, invariable (normal to the angular momentum) and the body's equator.

    angles = "andoyer": h, I, g, J, l; the attitude is R3(l) R1(J) R3(g) R1(I) R3(h) [SA (84)], with
    cos I = H/G and cos J = L/G. "euler": phi, theta, psi, the attitude being R3(psi) R1(theta)
    R3(phi) [SA (1)]; the momentum and its plane are left out. "both": everything [SA Fig. 2].

    Nodes as in the paper: **i** where the invariable plane rises through the inertial one, **j**
    where the body equator rises through the invariable plane, **l** where it rises through the
    inertial one. All is built from the angles that the charts give for the state. view: None takes
    the one that keeps the labels furthest apart. ValueError for several states, or without
    momentum. Returns the Axes."""
    if angles not in (*SETS, "both"):
        raise ValueError(
            f"frames_and_angles: got angles = {angles!r}; expected andoyer, euler or both"
        )
    frames = frames_of(state)
    names = [name for kind in SETS if angles in (kind, "both") for name in SETS[kind]]
    nodes = {"andoyer": ["i", "j"], "euler": ["l"], "both": ["i", "j", "l"]}[angles]
    width = style.SINGLE_COLUMN * (1.4 if angles == "both" else 1.0)
    ax = style.plane_axes(ax, width, 0.92 * width)
    view = best_view(frames, names, nodes) if view is None else view
    planes = {"inertial plane": (Disc(frames.inertial[2], FILLS["inertial"]), INERTIAL)}
    if angles != "euler":
        planes["invariable plane"] = (Disc(frames.momentum, FILLS["invariable"]), INVARIABLE)
    planes["body equator"] = (Disc(frames.body[2], FILLS["equator"]), EQUATOR)
    discs = [disc for disc, _ in planes.values()]
    paint(ax, view, discs)
    tips = np.concatenate([AXIS * frames.inertial, AXIS * frames.body])
    if angles != "euler":
        tips = np.concatenate([tips, [MOMENTUM * frames.momentum]])
    picture = Picture(ax, view, discs, np.concatenate([tips, *(disc.rim() for disc in discs)]))
    for name, (disc, look) in planes.items():
        picture.line(disc.rim(), look, name)
    draw_nodes(picture, frames, nodes)
    draw_axes(picture, frames, angles != "euler")
    for name in names:
        picture.angle(frames.angles[name], name)
    write(ax, picture.labels, np.concatenate(picture.taken), 9.0 * arrows.data_per_point(ax))
    planes_legend(ax, {name: look for name, (_, look) in planes.items()})
    return ax
