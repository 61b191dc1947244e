# SPDX-License-Identifier: MIT
"""What a type checker knows of states (test_typing.py)."""

import dataclasses
import fractions
from typing import Any, Union

import numpy as np
import polhode
from numpy.typing import NDArray
from typing_extensions import assert_type

Array = NDArray[np.float64]
Either = Union[float, Array]

body = polhode.Body(1.0, 2.0, 2.5)
state = polhode.rotor_state(body, [1, 0, 0, 0], [0.1, 0.2, 1.0])
motion = polhode.FreeRotation(body, state)
times = np.linspace(0.0, 1.0, 5)

# a number in, numbers out; an array in, arrays out
assert_type(motion.at(1.0), polhode.RotorState[float])
assert_type(motion.at(times), polhode.RotorState[Array])
assert_type(motion.at([0.0, 1.0]), polhode.RotorState[Array])

# lists of floats are one vector; an array may be one or many
assert_type(polhode.rotor_state(body, [1, 0, 0, 0], [0.1, 0.2, 1.0]), polhode.RotorState[float])
assert_type(polhode.to_andoyer(polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])).l, float)
assert_type(polhode.to_andoyer(polhode.RotorState([1, 0, 0, 0], np.ones((5, 3)))).l, Either)
assert_type(polhode.charts.euler_angles([0.5, 0.5, 0.5, 0.5]).phi, float)
assert_type(polhode.TumblerState(3.0, 2.0, [0, 0, 1], "short_axis", 0.1, 0.2).phi0, float)

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

# at one time a state stays what it is, at several it becomes as many
system = polhode.System(body)
either = polhode.RotorState(np.array([1.0, 0, 0, 0]), np.ones(3))
assert_type(polhode.energy(system, 0.0, motion.at(1.0)), float)
assert_type(polhode.energy(system, 0.0, motion.at(times)), Array)
assert_type(polhode.energy(system, times, motion.at(1.0)), Array)
assert_type(polhode.energy(system, 0.0, either), Either)
assert_type(polhode.to_sadov(body, motion.at(1.0)).I_l, float)
assert_type(polhode.to_serret(body, motion.at(times)).g0, Array)

# so do constructors
assert_type(polhode.AndoyerState(0.1, 0.2, 0.3, 0.5, 1, 0.6).L, float)
assert_type(polhode.AndoyerState(times, 0.2, 0.3, 0.5, 1.0, 0.6).l, Array)
assert_type(polhode.PoincareState(0.1, 0.2, 0.1, 1.0, 0.1, 0.1, "zero", "pi").sigma, float)

assert_type(polhode.SadovState(0.1, 0.2, 0.3, 0.5, 1.0, 0.6, region=[0, 0]).phi_l, Array)

# what an index leaves depends on the index
assert_type(many[0].L, Any)
assert_type(many.reshape((5, 1)).L, Array)


def length(of: polhode.AndoyerState[Array]) -> Array:
    return np.abs(of.G)


def of_either(of: polhode.AndoyerState) -> None:
    """A bare state is one or many."""



# a run's states are many; its initial state, and what a callable is called with, are one
def rises(t: float, of: polhode.RotorState[float]) -> float:
    assert_type(polhode.to_andoyer(of).l, float)
    return polhode.to_andoyer(of).l - t


problem = polhode.Problem(system, state, 0.0, 1.0, events=[polhode.Event("rises", rises)])
run = polhode.integrate(problem, times)
assert_type(polhode.to_andoyer(run.states).l, Array)
assert_type(polhode.to_andoyer(run.at(0.5)).l, float)
assert_type(polhode.to_andoyer(problem.initial).l, float)
assert_type(polhode.to_andoyer(motion.initial_state).l, float)

length(many)
of_either(one)
of_either(many)

# small values are dataclasses to those who ask
assert_type(dataclasses.replace(polhode.Adaptive(), tolerance=1e-9), polhode.Adaptive)

# a number may stand for a series; coefficients are fractions or floats
symbols = polhode.series.Symbols(["G", "k"], ["g"], [("g", "G")])
h = 2 * polhode.series.Series(symbols, "G^2/2 + k*cos(g)") - 1.5
assert_type(h, polhode.series.Series)
assert_type(h.bracket(h / 2, polhode.series.Truncation({"k": 1}, 2)), polhode.series.Series)
assert_type([term.coefficient for term in h], list[Union[fractions.Fraction, float]])
assert_type(polhode.series.CompiledSeries(h).at([[1.0, 0.1, 0.2]]), Union[float, Array])
assert_type(h(G=1.0, k=0.1, g=times), Union[float, Array])
transform = polhode.series.LieTransform(
    h, polhode.series.Truncation({"k": 1}, 2), ["g"], resonances=[{"g": 2}]
)
assert_type(transform.in_mean(h), polhode.series.Series)

# an ensemble has arrays by name, and scenarios of its members
scenario = polhode.Scenario.from_text("""
schema = 1
body.moments = [1, 2, 2.5]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.1, 0.2, 1] }
time = { stop = 1, step = 1 }
""")
uniform = polhode.vary.uniform(0.9, 1.1)
assert_type(uniform, polhode.vary.Distribution)
ensemble = scenario.ensemble(vary={"body.moments[0]": uniform}, size=3)
assert_type(ensemble, polhode.ensemble.EnsembleResults)
assert_type(ensemble["t"], Array)
assert_type(ensemble.drawn["body.moments[0]"], Array)
assert_type(ensemble.member(1), polhode.Scenario)
