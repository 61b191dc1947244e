# SPDX-License-Identifier: MIT
"""The Jacobi integral E - n G_z over a million turns of a triaxial body on a circular orbit, by
Collocation in fixed steps: how far it ends from its start, relative to E.
benchmarks/splitting_energy.cpp tells oscillation and drift apart, and has the splittings.
"""

import numpy as np
from timing import Contender, interleaved

MOMENTS, MOMENTUM = (0.9, 1.0, 1.1), (4.5, 4.0, 8.25)
TURNS = 1_000_000
TURN = 2.0 * np.pi / float(np.hypot(np.hypot(5.0, 4.0), 7.5))
STOP = TURNS * TURN
STEPS = 5


def measured(options):
    import polhode as ph
    orbit = ph.KeplerOrbit(ph.KeplerElements(1.0, 1.0, 0.0))
    system = ph.System(ph.Body(*MOMENTS), terms=ph.GravityGradient(orbit, 1.0))
    start = ph.RotorState([1, 0, 0, 0], MOMENTUM)

    def integral(t, q, g):
        turn = np.cross(q[1:], g)
        momentum = g + 2.0 * (q[0] * turn + np.cross(q[1:], turn))
        return ph.energy(system, t, ph.RotorState(q, g)) - momentum[2]
    first, size = integral(0.0, np.array(start.q), np.array(start.g)), abs(
        ph.energy(system, 0.0, start))

    def once():
        problem = ph.Problem(system, start, 0.0, STOP, ph.Collocation(step=TURN / STEPS))
        end = ph.integrate(problem, [STOP], dense=False)
        return 1, abs(integral(STOP, end.q[-1], end.g[-1]) - first) / size
    found, = interleaved([Contender("polhode Collocation", f"{STEPS} steps a turn", once)], 1)
    return [{"who": found.who, "setting": found.setting, "seconds": found.median,
             "repetitions": found.seconds, "error": float(found.ends[0])}]
