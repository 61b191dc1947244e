# SPDX-License-Identifier: MIT
"""Goal G15: Mars, unaveraged (examples/mars.toml), for a thousand years.

No peer is fast enough to be asked. What is wanted is the axis of the momentum, whose motion is the
precession; seconds are those of a million years at the same rate, errors those after the thousand,
against Collocation, which follows every turn of the attitude.
"""

import pathlib

import numpy as np
from timing import Contender, interleaved

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/mars.toml"
YEARS = 1000.0
SPAN = YEARS * 365.25  # days
# Days; no multiple of half a turn, where kicks meet the body the same way round.
STEPS = (0.37, 1.37, 3.37, 7.37)


def axis(run):
    q, g = np.array(run.q[-1]), np.array(run.g[-1])
    turn = np.cross(q[1:], g)
    inertial = g + 2.0 * (q[0] * turn + np.cross(q[1:], turn))
    return inertial / np.linalg.norm(inertial)


def measured(options):
    import polhode as ph
    example = ph.load(EXAMPLE)

    def run(method):
        problem = ph.Problem(example.system, example.initial_state, 0.0, SPAN, method)

        def once():
            return YEARS / 1e6, axis(ph.integrate(problem, [SPAN], dense=False))
        return once
    contenders = [Contender("polhode Splitting order2", f"{h:g} d", run(ph.Splitting(h, "order2")))
                  for h in STEPS]
    contenders += [Contender("polhode Collocation", "default", run(ph.Collocation()))]
    _, exact = run(ph.Collocation(1e-14))()
    return [{"who": t.who, "setting": t.setting, "seconds": t.median, "repetitions": t.seconds,
             "error": float(np.linalg.norm(t.ends[0] - exact))}
            for t in interleaved(contenders, options.repetitions)]
