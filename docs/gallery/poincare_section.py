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
    GravityGradient,
    KeplerElements,
    KeplerOrbit,
    Problem,
    System,
    figures,
    rotor_state,
)
from polhode.analysis import spin_orbit_section
from polhode.charts import EulerAngles, attitude

a, b, c = 190.0, 145.0, 114.0
moon = Body(*np.array([b**2 + c**2, a**2 + c**2, a**2 + b**2]) / (a**2 + b**2))
orbit = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))  # mean motion 1
system = System(moon, terms=[GravityGradient(orbit, 1.0)])


def section(angle, spin, orbits=400):
    start = rotor_state(moon, attitude(EulerAngles(angle, 0.0, 0.0)), [0, 0, spin])
    problem = Problem(system, start, 0.0, 2 * math.pi * orbits, Adaptive(1e-9))
    return spin_orbit_section(problem, orbit)


starts = [(math.pi / 2, spin) for spin in (0.2, 0.43, 1.95, 2.1, 2.25, 2.4, 2.6)]
starts += [(0.0, spin) for spin in (0.35, 0.5, 2.3)]
chaotic = section(math.pi / 2, 1.0, orbits=2500)
ax = figures.poincare_section(chaotic, color="0.55", size=0.8)
figures.poincare_section([section(*start) for start in starts], ax=ax)
ax.set_ylim(0, 2.8)
figures.save(ax, "poincare_section.png")
