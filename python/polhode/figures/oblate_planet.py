# SPDX-License-Identifier: MIT
"""A satellite of a precessing oblate planet, in the frame of its equator of date: the paper's
example of canonical elements that do not osculate [SA section 4.4.3, footnote].

The frame turns at the rate mu. Then r' = p - mu x r, p' = -dV/dr - mu x p are Hamilton's equations
of p^2/2 + V(r) - mu . (r x p), V = -gm/r (1 - J2 (R/r)^2 (3 z^2/r^2 - 1)/2): the momentum p is the
velocity relative to inertial axes, the velocity in the frame is r'. Two ellipses go through every
point of the path: that of (r, p), the one of Delaunay's canonical elements, cuts it; that of (r,
r') touches it."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from polhode._arguments import require_positive
from polhode._core import (
    Frame,
    OrbitalPerturbation,
    SatellitePath,
    SatelliteState,
    SatelliteSystem,
    _number,
    _numbers,
    energy,
    satellite_path,
    satellite_rates,
)

Array = NDArray[np.float64]


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

    @property
    def system(self) -> SatelliteSystem:
        """The equations of motion, for the functions of satellites."""
        rate = float(np.linalg.norm(self.mu))
        frame = Frame.precessing(self.mu, rate) if rate > 0.0 else Frame.inertial()
        return SatelliteSystem(
            self.gm, frame, [OrbitalPerturbation.oblateness(self.gm, self.J2_R2, 1.0)]
        )

    def acceleration(self, r: Array) -> Array:
        """-dV/dr at positions (..., 3)."""
        return satellite_rates(self.system, 0.0, SatelliteState(r, np.zeros_like(r)))[..., 3:]

    def energy(self, z: Array) -> Array:
        """The Hamiltonian of states (..., 6), constant along a path."""
        return energy(self.system, 0.0, SatelliteState(z[..., :3], z[..., 3:]))

    def path(self, r: ArrayLike, p: ArrayLike, stop: float) -> Path:
        """The path from (r, p) at t = 0 to `stop`, which must be positive (ValueError).

        RuntimeError where the integration fails, as at the centre of the planet."""
        require_positive("path", "stop", stop)
        start = SatelliteState(_numbers(r, "r"), _numbers(p, "p"))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)
            motion = satellite_path(self.system, start, 0.0, stop)
        if not motion.outcome.ok:
            raise RuntimeError(f"path: {motion.outcome.advice}")
        return Path(self, motion)


@dataclass(frozen=True)
class Path:
    """A satellite's path from t = 0 to `stop`."""

    planet: OblatePlanet
    motion: SatellitePath

    @property
    def stop(self) -> float:
        """Its last time."""
        return self.motion.stop

    def position(self, t: ArrayLike) -> Array:
        """r (..., 3) in the frame at times of any shape."""
        return self.motion.at(t).r

    def momentum(self, t: ArrayLike) -> Array:
        """p (..., 3), in components of the frame."""
        return self.motion.at(t).p

    def velocity(self, t: ArrayLike) -> Array:
        """r' (..., 3), relative to the frame: the slope of the path itself."""
        return satellite_rates(self.planet.system, 0.0, self.motion.at(t))[..., :3]


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
