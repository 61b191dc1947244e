# SPDX-License-Identifier: MIT
"""Regular or chaotic: Lyapunov indicator and MEGNO in time

Three motions of a moon of Hyperion's shape, all with the axis tilted by 0.3 rad at the start. The
Lyapunov indicator of the regular one falls like ln(t)/t for ever; of the two that start at 1.0 and
1.6 turns per revolution it settles at one over the Lyapunov time, some tens of days. Their mean
MEGNO grows with time; that of the regular motion stays at 2.
"""

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
from polhode.analysis import chaos_indicator
from polhode.charts import EulerAngles, attitude

a, b, c = 190.0, 145.0, 114.0
moon = Body(*np.array([b**2 + c**2, a**2 + c**2, a**2 + b**2]) / (a**2 + b**2))
orbit = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
system = System(moon, terms=[GravityGradient(orbit, 1.0)])
day = 2 * math.pi / 21.277  # the mean motion is 1
times = np.geomspace(1.0, 5000.0, 200) * day


def run(spin):
    start = rotor_state(moon, attitude(EulerAngles(0.3, 0.3, 0.0)), [0, 0, spin])
    problem = Problem(system, start, 0.0, times[-1], Adaptive(1e-10))
    return chaos_indicator(problem, times)


runs = {f"{spin:.1f} turns per revolution": run(spin) for spin in (1.0, 1.6, 6.0)}
axes = figures.chaos_growth(runs, unit="d", scale=1 / day)
figures.save(axes, "chaos_growth.png")
