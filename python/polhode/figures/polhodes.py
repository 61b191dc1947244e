# SPDX-License-Identifier: MIT
"""Polhodes as data: the curves of the momentum on the sphere |g| = G, from the exact motion.

Equations   g_1^2 + g_2^2 + g_3^2 = G^2 [SA "sphere"], g_1^2/I1 + g_2^2/I2 + g_3^2/I3 = 2T
            [SA "kinetic"], dg/dt = g x I^-1 g [SA (12)].
Units       those of the momentum; scale-free."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from polhode import Body, FreeRotation, RotorState, System
from polhode.free import Regime
from polhode.rates import rotor_rates

IDENTITY = (1.0, 0.0, 0.0, 0.0)
PARTS = 16
"""How many circuits are shown of a run that has more."""
ONE_POLHODE = 0.02
"""Range of the energy, over that of the body, within which polhodes lie on one another."""


@dataclass(frozen=True)
class Polhode:
    """One curve of the momentum in the body: points (n, 3) in the order of time, and its regime."""

    points: NDArray[np.float64]
    regime: Regime

    @property
    def closed(self) -> bool:
        return self.regime != Regime.separatrix


def states_of(g: ArrayLike) -> RotorState:
    """Hub states with these momenta (..., 3), all in one attitude: where it does not matter."""
    return RotorState(IDENTITY, g)


def momentum_rate(body: Body, g: ArrayLike) -> NDArray[np.float64]:
    """dg/dt = g x I^-1 g of free rotation: (..., 3). [SA (12)]"""
    return np.asarray(rotor_rates(System(body), 0.0, states_of(g)).g)


def sorted_axes(body: Body) -> tuple[int, int, int]:
    """Indices of the axes of least, intermediate and greatest moment."""
    least, middle, greatest = np.argsort(body.moments, kind="stable")
    return int(least), int(middle), int(greatest)


def motion_through(body: Body, g: ArrayLike) -> FreeRotation:
    """The free motion that starts with momentum g (3,) in the body."""
    return FreeRotation(body, states_of(g))


def polhode(motion: FreeRotation, count: int = 361) -> Polhode:
    """The polhode of a motion, once round: `count` points evenly along the curve.

    Steady motion and rest give their one point; on the separatrix the arc from -b2 to b2, or
    back, that the motion runs through in infinite time."""
    start = np.asarray(motion.initial_state.g, dtype=float)
    if motion.regime in (Regime.rest, Regime.steady):
        return Polhode(start[None, :], motion.regime)
    if motion.regime == Regime.separatrix:
        arcs = separatrix(motion.body, motion.momentum, count)
        middles = np.array([arc.points[count // 2] for arc in arcs])
        return arcs[int(np.argmax(middles @ start))]
    # Near the separatrix the momentum lingers at b2: even steps of time would leave the rest bare.
    fine = np.linspace(0.0, 1.0, 8 * count + 1)
    coarse = motion.at(motion.epoch + motion.polhode_period * fine).g
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(coarse, axis=0), axis=1))])
    times = np.interp(np.linspace(0.0, length[-1], count), length, fine)
    points = np.array(motion.at(motion.epoch + motion.polhode_period * times).g)
    return Polhode(points, motion.regime)


def separatrix_amplitudes(body: Body, G: float) -> tuple[float, float]:
    """A1, A3: largest momenta along the long and the short axis on the separatrix, 2 T I2 = G^2."""
    i, j, k = sorted_axes(body)
    I1, I2, I3 = body.moments[[i, j, k]]
    if not I1 < I2 < I3:
        return 0.0, 0.0
    a1 = G * np.sqrt(I1 * (I3 - I2) / (I2 * (I3 - I1)))
    return float(a1), float(G * np.sqrt(I3 * (I2 - I1) / (I2 * (I3 - I1))))


def separatrix_rate(body: Body, G: float) -> float:
    """du/dt on the separatrix, where g_2 = G tanh u: |dg/dt| / G where u = 0."""
    i, _, k = sorted_axes(body)
    top = np.zeros(3)
    top[[i, k]] = separatrix_amplitudes(body, G)
    return float(np.linalg.norm(momentum_rate(body, top))) / G


def separatrix(body: Body, G: float, count: int = 361) -> list[Polhode]:
    """The four arcs of the separatrix, each in the order of time: halves of two great circles.

    g_1 = s1 A1 / cosh u, g_2 = s1 s3 G tanh u, g_3 = s3 A3 / cosh u; drawn evenly in the angle
    whose sine is tanh u. Empty for a body with two equal moments, which has no separatrix."""
    a1, a3 = separatrix_amplitudes(body, G)
    if a1 == 0.0:
        return []
    i, j, k = sorted_axes(body)
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, count)
    arcs = []
    for s1 in (1.0, -1.0):
        for s3 in (1.0, -1.0):
            points = np.empty((count, 3))
            points[:, i] = s1 * a1 * np.cos(turn)
            points[:, k] = s3 * a3 * np.cos(turn)
            points[:, j] = G * np.sin(turn)
            middle = points[count // 2]
            if momentum_rate(body, middle)[j] < 0.0:
                points = points[::-1]
            arcs.append(Polhode(points, Regime.separatrix))
    return arcs


def family(
    body: Body,
    G: float = 1.0,
    short_axis: int = 5,
    long_axis: int = 4,
    count: int = 361,
    even: str = "angle",
) -> list[Polhode]:
    """Polhodes of both kinds on the sphere |g| = G, about both ends of both axes.

    short_axis, long_axis: how many about each end. They cut the meridian of the long and the short
    axis evenly in angle, or (even = "height") evenly in the momentum along the short axis. A body
    with two equal moments has one kind only, a sphere none."""
    if even not in ("angle", "height"):
        raise ValueError(f"family: got even = {even!r}; expected angle or height")
    i, j, k = sorted_axes(body)
    least, middle, greatest = body.moments[[i, j, k]]
    if least == greatest:
        return []
    a1, a3 = separatrix_amplitudes(body, G)
    # Angle of the separatrix from the short axis, in the meridian of the long one.
    border = np.arctan2(a1, a3) if a1 > 0.0 else (0.0 if middle == greatest else 0.5 * np.pi)
    curves = []
    about = [(k, i, short_axis, border), (i, k, long_axis, 0.5 * np.pi - border)]
    for axis, toward, number, width in about:
        if width == 0.0:
            continue
        for sign in (1.0, -1.0):
            share = np.arange(1, number + 1) / (number + 1)
            tilts = width * share
            if even == "height" and axis == k:
                tilts = np.arccos(1.0 - share * (1.0 - np.cos(width)))
            elif even == "height":
                tilts = np.arcsin(share * np.sin(width))
            for tilt in tilts:
                g = np.zeros(3)
                g[axis], g[toward] = sign * G * np.cos(tilt), G * np.sin(tilt)
                curves.append(polhode(motion_through(body, g), count))
    return curves


def steady_points(body: Body, G: float = 1.0) -> list[tuple[NDArray[np.float64], bool]]:
    """Points (3,) where the momentum stands still on the sphere, each with whether it is stable.

    The ends of the three axes of a triaxial body; of a body with two equal moments the ends of its
    symmetry axis alone (the equator of steady rotations is a line); none for a sphere."""
    i, j, k = sorted_axes(body)
    least, middle, greatest = body.moments[[i, j, k]]
    axes: list[tuple[int, bool]] = []
    if least < middle:
        axes.append((i, True))
    if least < middle < greatest:
        axes.append((j, False))
    if middle < greatest:
        axes.append((k, True))
    return [(sign * G * np.eye(3)[axis], stable) for axis, stable in axes for sign in (1.0, -1.0)]


def excerpts(body: Body, g: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """The momenta (n, 3) of a run on a sphere in the parts to draw; one part where all is drawn.

    A run whose momentum goes round so often, on ever other polhodes, that it would paint the sphere
    is shown by some circuits, evenly spread over it: paths as long as the equator."""
    steps = np.linalg.norm(np.diff(g, axis=0), axis=-1)
    path = np.concatenate([[0.0], np.cumsum(steps)])
    size = np.linalg.norm(g[0])
    circuit = 2.0 * np.pi * size
    inverse = 1.0 / np.asarray(body.moments)
    energy = np.sum(g * g * inverse, axis=-1) / size**2
    spread = np.ptp(energy) > ONE_POLHODE * np.ptp(inverse)
    if not spread or path[-1] < PARTS * circuit:
        return [g]
    starts = np.linspace(0.0, path[-1] - circuit, PARTS)
    first = np.searchsorted(path, starts)
    last = np.searchsorted(path, starts + circuit) + 1
    return [g[a:b] for a, b in zip(first, last)]
