# SPDX-License-Identifier: MIT
"""A Poincare section: why Hyperion tumbles

The section of Wisdom, Peale and Mignard (1984), with the full equations of motion: a moon of
Hyperion's shape (semi-axes 190, 145 and 114 km) spins about the normal of its orbit of
eccentricity 0.1. At every pericentre a dot: the angle of its long axis from the planet, against
its spin in units of the mean motion. Curves are regular rotation, each a run of its own; the
grey cloud is one single run, in the chaotic zone that surrounds what is left of synchronous
rotation."""

import math

import numpy as np
from polhode import (
    Adaptive,
    Body,
    Event,
    GravityGradient,
    KeplerElements,
    KeplerOrbit,
    Problem,
    System,
    figures,
    integrate,
    rotor_state,
)

a, b, c = 190.0, 145.0, 114.0
moments = np.array([b**2 + c**2, a**2 + c**2, a**2 + b**2]) / (a**2 + b**2)
moon = Body(*moments)
orbit = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
system = System(moon, terms=[GravityGradient(1.0, orbit)])
pericentre = Event("pericentre", lambda t, s: math.sin(t / 2))


def run(angle, spin, orbits=400):
    start = rotor_state(moon, [math.cos(angle / 2), 0, 0, math.sin(angle / 2)], [0, 0, spin])
    stop = 2 * math.pi * orbits + 1
    return integrate(Problem(system, start, 0.0, stop, Adaptive(1e-9), [pericentre]), dense=False)


def angle(states):
    """Of the long axis; half a turn brings the same shape back."""
    turn = 2 * np.arctan2(states.q[:, 3], states.q[:, 0])
    return (turn + math.pi / 2) % math.pi - math.pi / 2


def spin(states):
    return states.g[:, 2] / moments[2]


chaotic = run(math.pi / 2, 1.0, orbits=2500)
starts = [(math.pi / 2, w) for w in (0.2, 0.43, 1.95, 2.1, 2.25, 2.4, 2.6)]
starts += [(0.0, w) for w in (0.35, 0.5, 2.3)]
ax = figures.poincare_section(chaotic, angle, spin, color="0.55", size=0.8)
figures.poincare_section([run(*start) for start in starts], angle, spin, ax=ax)
ax.set(
    xlabel="angle of the long axis (rad)",
    ylabel="spin / mean motion",
    xlim=(-1.6, 1.6),
    ylim=(0, 2.8),
)
figures.save(ax, "poincare_section.png")
