# SPDX-License-Identifier: MIT
"""Batches on several threads: the bits of one thread, its errors, and Ctrl-C."""

import numpy as np
import polhode
import pytest
from interrupts import LATEST, seconds_from_signal

BODY = polhode.Body(0.9, 1.0, 1.1)
RANDOM = np.random.default_rng(36)
COUNT = 60_000
STATES = polhode.RotorState(RANDOM.normal(size=(COUNT, 4)), RANDOM.normal(size=(COUNT, 3)))
MOTION = polhode.FreeRotation(BODY, STATES[0])
TIMES = np.linspace(-50.0, 500.0, COUNT)
FEW = STATES[:3000]

CALLS = {
    "propagate": lambda n: polhode.propagate(BODY, STATES, TIMES, threads=n),
    "propagate, broadcast": lambda n: polhode.propagate(
        BODY, STATES[:300], TIMES[:300, np.newaxis], threads=n),
    "propagate, short arcs": lambda n: polhode.propagate(
        BODY, STATES[:400], TIMES[:1100, np.newaxis], short_arc=True, threads=n),
    "at": lambda n: MOTION.at(TIMES, threads=n),
    "at_grid": lambda n: MOTION.at_grid(0.5, 0.01, 400_000, threads=n),
    "to_andoyer": lambda n: polhode.to_andoyer(STATES, threads=n),
    "to_euler": lambda n: polhode.to_euler(STATES, threads=n),
    "to_euler_rates": lambda n: polhode.charts.to_euler_rates(BODY, STATES, threads=n),
    "to_poincare": lambda n: polhode.to_poincare(STATES, "zero", "pi", threads=n),
    "nearest_poincare": lambda n: polhode.charts.nearest_poincare(STATES, threads=n),
    "to_sadov": lambda n: polhode.to_sadov(BODY, STATES, threads=n),
    "to_sadov of a motion": lambda n: polhode.to_sadov(MOTION, TIMES[:3000], threads=n),
    "to_serret": lambda n: polhode.to_serret(BODY, STATES, TIMES, threads=n),
    "to_tumbler": lambda n: polhode.to_tumbler(BODY, FEW, threads=n),
}


def bits(states):
    arrays = {name: getattr(states, name) for name in dir(states) if name[0] != "_"}
    return {name: a.tobytes() for name, a in arrays.items() if isinstance(a, np.ndarray)}


@pytest.mark.parametrize("name", CALLS)
def test_no_bit_depends_on_the_threads(name):
    alone = bits(CALLS[name](1))
    assert alone
    for threads in (2, 3):
        assert bits(CALLS[name](threads)) == alone


@pytest.mark.parametrize("of", [
    lambda s: (polhode.to_andoyer(s),), lambda s: (polhode.to_euler(s),),
    lambda s: (polhode.charts.nearest_poincare(s),), lambda s: (BODY, polhode.to_sadov(BODY, s)),
    lambda s: (BODY, polhode.to_serret(BODY, s), 0.0)])
def test_the_way_back_neither(of):
    chart = of(FEW)
    assert np.array_equal(polhode.to_rotor(*chart, threads=2), polhode.to_rotor(*chart))


def test_the_first_body_that_fails_is_named_whatever_the_threads():
    moments = np.tile([1.0, 2.0, 2.5], (COUNT, 1))
    moments[[55_000, 40_017, 59_999]] = [1.0, 2.0, 4.0]
    for threads in (1, 2, 5):
        with pytest.warns(RuntimeWarning, match=r"3 of 60000 .*at index \(40017,\)"):
            polhode.propagate(moments, STATES, 1.0, threads=threads)


def test_the_first_state_that_fails_is_named_whatever_the_threads():
    times = np.zeros(COUNT)
    times[[1234, 50_000]] = np.inf
    for threads in (1, 2, 5):
        with pytest.raises(ValueError, match=r"at index \(1234,\)"):
            polhode.to_sadov(BODY, STATES, times, threads=threads)


@pytest.mark.parametrize("name", CALLS)
def test_threads_are_one_or_more(name):
    with pytest.raises(ValueError, match="threads: got 0; expected a whole number from 1"):
        CALLS[name](0)


def test_ctrl_c_ends_a_call_on_two_threads():
    def forever():
        while True:
            polhode.propagate(BODY, STATES, np.linspace(0.0, 1e9, 30)[:, np.newaxis], threads=2)

    assert seconds_from_signal(forever) < LATEST
