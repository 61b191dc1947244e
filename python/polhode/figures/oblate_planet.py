# SPDX-License-Identifier: MIT
"""A satellite of a precessing oblate planet, in the frame of its equator of date: the paper's
example of canonical elements that do not osculate [SA section 4.4.3, footnote].

The frame turns at the rate mu. Then r' = p - mu x r, p' = -dV/dr - mu x p are Hamilton's equations
of p^2/2 + V(r) - mu . (r x p), V = -gm/r (1 - J2 (R/r)^2 (3 z^2/r^2 - 1)/2): the momentum p is the
velocity relative to inertial axes, the velocity in the frame is r'. Two ellipses go through every
point of the path: that of (r, p), the one of Delaunay's canonical elements, cuts it; that of (r,
r') touches it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray

from polhode._arguments import require_positive
from polhode._core import _number, _numbers

Array = NDArray[np.float64]
NODES = 48
ITERATIONS = 100


@dataclass(frozen=True)
class OblatePlanet:
    """gm; J2 R^2 as one number; mu (3,): rate of the equator-of-date frame, in that frame."""

    gm: float
    J2_R2: float
    mu: tuple[float, float, float]

    def __post_init__(self) -> None:
        _number(self.gm, "gm")
        _number(self.J2_R2, "J2_R2")
        _numbers(self.mu, "mu")

    def acceleration(self, r: Array) -> Array:
        """-dV/dr at positions (..., 3)."""
        size2 = np.sum(r * r, axis=-1, keepdims=True)
        z2 = 5.0 * r[..., 2:] ** 2 / size2
        bulge = 1.5 * self.J2_R2 / size2 * (np.array([1.0, 1.0, 3.0]) - z2)
        return -self.gm * r / size2**1.5 * (1.0 + bulge)

    def rates(self, z: Array) -> Array:
        """(r', p') of states (..., 6) = (r, p)."""
        r, p = z[..., :3], z[..., 3:]
        return np.concatenate(
            [p - np.cross(self.mu, r), self.acceleration(r) - np.cross(self.mu, p)], axis=-1
        )

    def energy(self, z: Array) -> Array:
        """The Hamiltonian of states (..., 6), constant along a path."""
        r, p = z[..., :3], z[..., 3:]
        size = np.linalg.norm(r, axis=-1)
        legendre = (3.0 * (r[..., 2] / size) ** 2 - 1.0) / 2.0
        potential = -self.gm / size * (1.0 - self.J2_R2 / size**2 * legendre)
        return np.sum(p * p, axis=-1) / 2.0 + potential - np.cross(r, p) @ np.asarray(self.mu)

    def path(self, r: ArrayLike, p: ArrayLike, stop: float) -> Path:
        """The path from (r, p) at t = 0 to `stop`, which must be positive (ValueError).

        RuntimeError where a step finds no solution, as with numbers that are not finite."""
        require_positive("path", "stop", stop)
        z = np.concatenate([_numbers(r, "r"), _numbers(p, "p")])
        edges, pieces = [0.0], []
        while edges[-1] < stop:
            # short compared with the time of the satellite's fall: the iteration contracts
            step = 0.35 * np.sqrt(np.linalg.norm(z[:3]) ** 3 / self.gm)
            end = min(stop, edges[-1] + step)
            pieces.append(piece(self.rates, z, end - edges[-1]))
            edges.append(end)
            z = chebyshev.chebval(1.0, pieces[-1])
        return Path(self, np.array(edges), pieces)


@dataclass(frozen=True)
class Path:
    """A satellite's path: Chebyshev series of (r, p) in each of the intervals between `edges`."""

    planet: OblatePlanet
    edges: Array
    pieces: list[Array]

    def position(self, t: ArrayLike) -> Array:
        """r (..., 3) in the frame at times of any shape."""
        return self._at(t, 0)[..., :3]

    def momentum(self, t: ArrayLike) -> Array:
        """p (..., 3), in components of the frame."""
        return self._at(t, 0)[..., 3:]

    def velocity(self, t: ArrayLike) -> Array:
        """r' (..., 3), relative to the frame: the slope of the path itself."""
        return self._at(t, 1)[..., :3]

    def _at(self, t: ArrayLike, derivative: int) -> Array:
        times = _numbers(t, "t")
        flat = times.ravel()
        out = np.empty((flat.size, 6))
        which = np.clip(np.searchsorted(self.edges, flat, "right") - 1, 0, len(self.pieces) - 1)
        for k in np.unique(which):
            low, high = self.edges[k : k + 2]
            x = (2.0 * flat[which == k] - low - high) / (high - low)
            scale = (2.0 / (high - low)) ** derivative
            series = chebyshev.chebder(self.pieces[k], derivative) * scale
            out[which == k] = chebyshev.chebval(x, series).T
        return out.reshape(*times.shape, 6)


def piece(rates: Any, start: Array, length: float) -> Array:
    """Chebyshev series (NODES + 1, 6) of z' = rates(z), by Picard's iteration to rounding.

    RuntimeError where it does not come to rest."""
    nodes = chebyshev.chebpts1(NODES)
    to_series = np.linalg.inv(chebyshev.chebvander(nodes, NODES - 1))
    values = np.broadcast_to(start, (NODES, start.size))
    last = np.inf
    for _ in range(ITERATIONS):
        series = chebyshev.chebint(to_series @ rates(values), lbnd=-1.0) * (length / 2.0)
        series[0] += start
        new = chebyshev.chebval(nodes, series).T
        change = float(np.max(np.abs(new - values)))
        values = new
        rounding = 1e-12 * float(np.max(np.abs(values)))  # kilometres have larger ones than radii
        if change == 0.0 or (change >= last and change < rounding):
            return series
        last = change
    raise RuntimeError(
        f"piece: after {ITERATIONS} iterations over a time of {length} the path still changes by "
        f"{change}; expected rates that are finite and smooth, as outside the planet"
    )


@dataclass(frozen=True)
class Ellipse:
    """The Kepler ellipse through r with velocity v: semi-axes a, b along the unit vectors P, Q."""

    a: float
    b: float
    e: float
    P: Array
    Q: Array
    anomaly: float
    """Eccentric anomaly of r."""

    def at(self, anomaly: ArrayLike) -> Array:
        """Points (..., 3) at eccentric anomalies, the focus in the origin."""
        E = _numbers(anomaly, "anomaly")[..., None]
        return self.a * (np.cos(E) - self.e) * self.P + self.b * np.sin(E) * self.Q

    def slope(self, anomaly: ArrayLike) -> Array:
        """d at / d anomaly (..., 3): along the Keplerian velocity."""
        E = _numbers(anomaly, "anomaly")[..., None]
        return -self.a * np.sin(E) * self.P + self.b * np.cos(E) * self.Q


def ellipse(r: ArrayLike, v: ArrayLike, gm: float) -> Ellipse:
    """The instantaneous ellipse of a position and a velocity (the paper's g, or r')."""
    r, v, gm = _numbers(r, "r"), _numbers(v, "v"), _number(gm, "gm")
    size = np.linalg.norm(r)
    h = np.cross(r, v)
    eccentricity = np.cross(v, h) / gm - r / size
    e = float(np.linalg.norm(eccentricity))
    if not e < 1.0 or not h.any():
        raise ValueError(f"ellipse: got an orbit of eccentricity {e}; expected less than 1")
    a = float(1.0 / (2.0 / size - v @ v / gm))
    P = eccentricity / e if e > 1e-14 else r / size
    Q = np.cross(h / np.linalg.norm(h), P)
    b = a * np.sqrt(1.0 - e * e)
    return Ellipse(a, float(b), e, P, Q, float(np.arctan2(r @ Q / b, r @ P / a + e)))
