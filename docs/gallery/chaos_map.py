# SPDX-License-Identifier: MIT
"""Where Hyperion tumbles: MEGNO over a grid of starts

A moon of Hyperion's shape starts at the pericentre of its orbit, its axis tilted by 0.1 rad: the
angle of its long axis from the planet against its spin in units of the mean motion. Dark cells,
whose MEGNO stays near 2 for 100 orbits, are regular: the fast rotation above, and specks that are
islands of resonances. All else is one chaotic zone; its Lyapunov time is some tens of days.
"""

import math
from concurrent.futures import ThreadPoolExecutor

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
from polhode.analysis import chaos_indicator
from polhode.charts import EulerAngles, attitude

a, b, c = 190.0, 145.0, 114.0
moon = Body(*np.array([b**2 + c**2, a**2 + c**2, a**2 + b**2]) / (a**2 + b**2))
orbit = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
system = System(moon, terms=[GravityGradient(orbit, 1.0)])


def megno(place):
    spin, angle = place
    q = attitude(EulerAngles(phi=angle, theta=0.1, psi=0.0))
    start = rotor_state(moon, q, [0, 0, spin])
    problem = Problem(system, start, 0.0, 100 * 2 * math.pi, Adaptive(1e-9))
    return chaos_indicator(problem).mean_megno[-1]


spins, angles = np.linspace(0.1, 3.0, 30), np.linspace(-math.pi / 2, math.pi / 2, 25)
spin, angle = (grid.ravel() for grid in np.meshgrid(spins, angles, indexing="ij"))
with ThreadPoolExecutor() as threads:  # chaos_indicator gives up the GIL
    values = list(threads.map(megno, zip(spin, angle)))
ax = figures.chaos_map({"spin": spin, "angle": angle, "mean_megno": values})
ax.set(xlabel="angle of the long axis (rad)", ylabel="spin / mean motion")
figures.save(ax, "chaos_map.png")
