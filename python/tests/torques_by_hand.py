# SPDX-License-Identifier: MIT
"""The torques of the tables of test_scenario_terms.py in SI units: textbook formulas in NumPy on
the numbers that stand in the text, turned to principal axes here."""

import itertools
from dataclasses import dataclass

import numpy as np

TENSOR = np.array([[17.0, 0.4, -2.1], [0.4, 124.0, 0.3], [-2.1, 0.3, 129.0]])
GM = 398600.4418e9
AU = 149597870700.0
KM = 1e3
DAY = 86400.0
GAUSS = 1e-9 * np.array([-1529.25, 4845.77, -29460.05])  # T, along the Earth's own axes
NOTHING = np.zeros(3)
# centre (m), normal, area (m2), specular, diffuse, sigma_n; sigma_t is 1
FACETS = [
    ((1, 2, 0), (1, 1, 0), 10.0, 0.0, 0.3, 1.0),
    ((1, 2, 0), (-1, -1, 0), 10.0, 0.0, 0.3, 1.0),
    ((0, 1, 3), (0, 0.3, 1), 2.0, 0.5, 0.0, 0.7),
]


@dataclass
class Place:
    """Where the body is: axes of the file to principal ones (R), inertial ones to principal ones
    (A), momentum, position and velocity from the centre of the orbit, the Sun from the same."""

    moments: np.ndarray
    R: np.ndarray
    A: np.ndarray
    g: np.ndarray
    t: float
    x: np.ndarray
    v: np.ndarray
    sun: np.ndarray
    gm: float = GM

    @property
    def w(self):
        return self.g / self.moments


def unit(v):
    return np.asarray(v) / np.linalg.norm(v)


def gravity_gradient(p, gm):
    r = p.A @ p.x
    return 3 * gm / np.linalg.norm(r) ** 5 * np.cross(r, p.moments * r)


def tensor_of(numbers, degree, R):
    """From the components xxx, xxy, ... in the axes of the file, along principal ones."""
    full = np.zeros((3,) * degree)
    places = itertools.combinations_with_replacement(range(3), degree)
    for value, place in zip(numbers, places, strict=True):
        for same in set(itertools.permutations(place)):
            full[same] = value
    for axis in range(degree):
        full = np.moveaxis(np.tensordot(R, full, (1, axis)), 0, axis)
    return full


def gravity_of_degree_3(p, sign):
    """The gradient of the Legendre polynomials of the points, P3'(c) and P4'(c)."""
    r = sign * (p.A @ p.x)
    M = KM * tensor_of(range(1, 11), 3, p.R)
    n = unit(r)
    along = (15 * M @ n @ n - 3 * np.trace(M, axis1=1, axis2=2)) / 2
    return p.gm / (r @ r) ** 2 * np.cross(along, n)


def gravity_of_degree_4(p, sign):
    r = sign * (p.A @ p.x)
    M = KM**2 * tensor_of(range(1, 16), 4, p.R)
    n = unit(r)
    along = (140 * M @ n @ n @ n - 60 * np.trace(M, axis1=2, axis2=3) @ n) / 8
    return p.gm / np.linalg.norm(r) ** 5 * np.cross(along, n)


def gravity_of_an_oblate_primary(p):
    r, pole = p.A @ p.x, p.A @ unit([0, 0.3, 0.9])
    d, z = np.linalg.norm(r), r @ pole
    H = (
        3 * np.outer(pole, pole) / d**5
        - 15 * z * (np.outer(pole, r) + np.outer(r, pole)) / d**7
        + (105 / 2 * z**2 / d**9 - 15 / 2 / d**7) * np.outer(r, r)
    )
    S = p.gm * 1e-3 * (6378 * KM) ** 2 * (np.diag(p.moments) @ H)
    return -np.array([S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]])


def tide(p):
    r, v = p.A @ p.x, p.A @ p.v
    front = 3 * 0.02 * p.gm * 1e3 * (100 * KM) ** 5 * 600 / np.linalg.norm(r) ** 8
    return front * ((r @ p.w) * r - (r @ r) * p.w + np.cross(r, v))


def facets(p):
    for centre, normal, area, *finish in FACETS:
        yield p.R @ np.array(centre), p.R @ unit(normal), area, *finish


def light(p, to_sun):
    d = np.linalg.norm(to_sun)
    e = p.A @ to_sun / d
    torque = np.zeros(3)
    for r, n, area, specular, diffuse, _ in facets(p):
        c = np.clip(n @ e, 0.0, None)
        force = (1 - specular) * e + (2 * specular * c + 2 / 3 * diffuse) * n
        torque += np.cross(r, -4.54e-6 * (AU / d) ** 2 * area * c * force)
    return torque


def light_in_the_open(p, sun, radius=600 * KM):
    """Nothing of the Sun's disc is behind the centre of the orbit: seen far from its axis."""
    to_sun, to_centre = sun - p.x, -p.x
    distance = np.linalg.norm(to_centre)
    apart = np.arccos(unit(to_sun) @ unit(to_centre))
    assert apart > np.arcsin(radius / distance) + np.arcsin(695700 * KM / np.linalg.norm(to_sun))
    return light(p, to_sun)


def drag(p, x, v, density, exit_speed=0.0):
    speed = np.linalg.norm(v)
    e = p.A @ v / speed
    torque = np.zeros(3)
    for r, n, area, _, _, sigma_n in facets(p):
        c = np.clip(n @ e, 0.0, None)
        force = e + ((1 - sigma_n) * c + sigma_n * exit_speed / speed) * n
        torque += np.cross(r, -density * speed**2 * area * c * force)
    return torque


def drag_in_thinning_air(p):
    x, v = -p.x, -p.v  # the orbit is that of the primary
    air = np.radians(361) / DAY * unit([0.1, -0.2, 0.7])
    density = 1e-12 * np.exp(-(np.linalg.norm(x) - 7000 * KM) / (1e5 * KM))
    return drag(p, x, v - np.cross(air, x), density, 0.5 * KM)


def dipole_field(p):
    pole = unit([0.1, 0.2, 1])
    angle = np.radians(29.7) + np.radians(361) / DAY * (p.t - 3)
    node = unit(np.cross([0, 0, 1], pole))
    along = np.cos(angle) * node + np.sin(angle) * np.cross(pole, node)
    K = (6371.2 * KM) ** 3 * GAUSS @ np.array([along, np.cross(pole, along), pole])
    r, n = np.linalg.norm(p.x), unit(p.x)
    return p.A @ ((3 * (K @ n) * n - K) / r**3)


def eddy_currents(p):
    M = p.R @ np.array([[9, 1, 0], [1, 8, 2], [0, 2, 7]]) @ p.R.T
    B = dipole_field(p)
    return np.cross(M @ np.cross(p.w, B), B)


def damping(p):
    return -p.R @ np.array([[3, 0.1, 0], [0.1, 2, 0.2], [0, 0.2, 1]]) @ p.R.T @ p.w


def friction(p, k):
    return k * np.cross(p.g, p.w)


def wobble_factor(p):
    """The rate of a small wobble about the axis of the largest moment over k G^2."""
    A, B, C = p.moments
    return ((1 / A - 1 / C) + (1 / B - 1 / C)) / 2


def friction_of_wobble(p):
    G = p.moments[2] * np.radians(2.8)
    return friction(p, 1 / (1000 * G**2 * wobble_factor(p)))


def friction_of_rock(p):
    rate = np.linalg.norm(p.g) / p.moments[2]
    time = 1e-4 * 100 / (2 * 0.05 * 0.01**2 * rate**3)  # mu Q / (rho K3^2 R^2 w^3)
    return friction(p, 1 / (time * (p.g @ p.g) * wobble_factor(p)))


def cubic_at_1():
    """Between the rows at 0 and 10 s: the slopes of Fritsch and Carlson's monotone cubic."""
    from scipy.interpolate import PchipInterpolator

    return float(PchipInterpolator([0, 10, 10.5, 70], [5e-6, 1e-5, 2e-5, 3e-5])(1.0))


PUSH = np.array([1e-6, 2e-6, 3e-6])
# name: (u, v) at a Place
ALONG = {
    "gravity": lambda p: (gravity_gradient(p, p.gm), NOTHING),
    "own gm": lambda p: (gravity_gradient(p, 4e5 * KM**3), NOTHING),
    "higher": lambda p: (gravity_gradient(p, p.gm) + gravity_of_degree_3(p, 1), NOTHING),
    "all degrees": lambda p: (
        gravity_gradient(p, p.gm) + gravity_of_degree_4(p, -1) + gravity_of_an_oblate_primary(p),
        NOTHING),
    "tide": lambda p: (tide(p), NOTHING),
    "light": lambda p: (light(p, p.x), NOTHING),
    "cylinder": lambda p: (light_in_the_open(p, p.sun), NOTHING),
    "cone": lambda p: (light_in_the_open(p, -p.sun), NOTHING),
    "drag": lambda p: (drag(p, p.x, p.v, 1e-12), NOTHING),
    "thinning air": lambda p: (drag_in_thinning_air(p), NOTHING),
    "magnet": lambda p: (np.cross(p.R @ [1, 2, 3], dipole_field(p)), NOTHING),
    "eddy": lambda p: (eddy_currents(p), NOTHING),
}
OWN = {
    "push": lambda p: (p.R @ PUSH, NOTHING),
    "push in space": lambda p: (p.A @ PUSH, NOTHING),
    "drag": lambda p: (damping(p), NOTHING),
    "wobble": lambda p: (NOTHING, friction_of_wobble(p)),
    "k": lambda p: (NOTHING, friction(p, np.array([0.1, 0.2, 0.3]))),
    "rock": lambda p: (NOTHING, friction_of_rock(p)),
    "steps": lambda p: (p.R @ [0, 5e-6, 0], NOTHING),
    "cubics": lambda p: (p.A @ [0, cubic_at_1(), 0], NOTHING),
}
