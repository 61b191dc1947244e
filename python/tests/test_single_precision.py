# SPDX-License-Identifier: MIT
"""float32 in, float64 out: numbers are widened exactly, and everything is computed in doubles."""

import numpy as np
import polhode

BODY = polhode.Body(1.0, 2.0, 2.5)
NARROW = np.array([0.1, 0.2, 1.0], np.float32)
WIDE = NARROW.astype(np.float64)
Q = np.array([0.6, 0.0, 0.8, 0.0], np.float32)


def test_a_chart():
    state = polhode.RotorState(Q, NARROW)
    assert state.q.dtype == state.g.dtype == np.float64
    assert state == polhode.RotorState(Q.astype(np.float64), WIDE)
    found = polhode.to_andoyer(polhode.RotorState(Q, np.tile(NARROW, (4, 1))))
    assert found.L.dtype == np.float64
    assert found[0] == polhode.to_andoyer(state)
    assert polhode.AndoyerState(NARROW, 0, 0, 0, 1, 0) == polhode.AndoyerState(WIDE, 0, 0, 0, 1, 0)


def test_a_free_rotation_at_times():
    motion = polhode.FreeRotation(BODY, polhode.RotorState(Q, NARROW))
    found = motion.at(NARROW)
    assert found.q.dtype == found.g.dtype == np.float64
    assert found == motion.at(WIDE)
    assert found != motion.at([0.1, 0.2, 1.0])  # 0.1 is another number in float32
    assert motion.at(NARROW[0]) == motion.at(WIDE[0])


def test_many_bodies():
    moments = np.array([[1.1, 2.0, 2.5], [1.2, 2.0, 2.5]], np.float32)
    states = polhode.RotorState(Q, np.tile(NARROW, (2, 1)))
    found = polhode.propagate(moments, states, NARROW[:2])
    assert found.g.dtype == np.float64
    assert found == polhode.propagate(moments.astype(np.float64), states, WIDE[:2])
