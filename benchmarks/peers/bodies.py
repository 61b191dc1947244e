# SPDX-License-Identifier: MIT
"""Goal G12 from Python: a million new bodies, a time each, drawn as fresh_bodies.cpp draws them.

Errors of some of them, by the textbook form at 50 digits.
"""

import numpy as np
import steps
from timing import Contender, interleaved

MANY, CHECKED = 1_000_000, 16
LONGEST = 628.3  # a hundred turns at a rate near 1


def drawn(random):
    a, b, c = random.uniform((1.5, 1.2, 0.8), (2.0, 1.45, 1.15), (MANY, 3)).T ** 2
    moments = np.column_stack([b + c, a + c, a + b]) / 4.0
    momenta = random.normal(size=(MANY, 3))
    momenta *= (moments[:, 1] / np.linalg.norm(momenta, axis=1))[:, None]
    return moments, momenta, random.uniform(0.0, LONGEST, MANY)


def measured(options, program, missing):
    import polhode as ph
    moments, momenta, times = drawn(np.random.default_rng(options.seed))
    states = ph.RotorState(np.tile([1.0, 0.0, 0.0, 0.0], (MANY, 1)), momenta)

    def once():  # keeps some ends alone: new memory for the rest would cost twice the work
        return MANY, ph.propagate(moments, states, times).q[:CHECKED].copy()
    once()
    found, = interleaved([Contender("polhode propagate, from Python", "", once)],
                         options.repetitions)
    if not program.exists():
        missing(f"{program.name} (not built)")
        return []
    ends = found.ends[0]
    errors = [steps.error_of(program, moments[k], momenta[k], times[k], ends[k])
              for k in range(CHECKED)]
    return [{"goal": "G12", "case": "a million, within 100 turns", "who": found.who, "unit": "ns",
             "repetitions": [1e9 * s for s in found.seconds], "error": float(np.max(errors))}]
