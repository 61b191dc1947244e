# SPDX-License-Identifier: MIT
"""What a type checker knows of states (test_typing.py)."""

from typing import Any

import numpy as np
import polhode
from numpy.typing import NDArray
from typing_extensions import assert_type

Array = NDArray[np.float64]

body = polhode.Body(1.0, 2.0, 2.5)
state = polhode.rotor_state(body, [1, 0, 0, 0], [0.1, 0.2, 1.0])
motion = polhode.FreeRotation(body, state)
times = np.linspace(0.0, 1.0, 5)

# a number in, numbers out; an array in, arrays out
assert_type(motion.at(1.0), polhode.RotorState[float])
assert_type(motion.at(times), polhode.RotorState[Array])
assert_type(motion.at([0.0, 1.0]), polhode.RotorState[Array])

# conversions keep what they were given
one = polhode.to_andoyer(motion.at(1.0))
many = polhode.to_andoyer(motion.at(times))
assert_type(one.L, float)
assert_type(many.L, Array)
assert_type(polhode.to_rotor(one), polhode.RotorState[float])
assert_type(polhode.to_rotor(many), polhode.RotorState[Array])
assert_type(polhode.to_sadov(motion, 2.0).phi_l, float)
assert_type(polhode.kinetic_energy(body, motion.at(2.0)), float)
assert_type(polhode.kinetic_energy(body, motion.at(times)), Array)

# so do constructors
assert_type(polhode.AndoyerState(0.1, 0.2, 0.3, 0.5, 1, 0.6).L, float)
assert_type(polhode.AndoyerState(times, 0.2, 0.3, 0.5, 1.0, 0.6).l, Array)
assert_type(polhode.PoincareState(0.1, 0.2, 0.1, 1.0, 0.1, 0.1, "zero", "pi").sigma, float)

# what an index leaves depends on the index
assert_type(many[0].L, Any)
assert_type(many.reshape((5, 1)).L, Array)


def length(of: polhode.AndoyerState[Array]) -> Array:
    return np.abs(of.G)


def of_either(of: polhode.AndoyerState) -> None:
    """A bare state is one or many."""


length(many)
of_either(one)
of_either(many)
