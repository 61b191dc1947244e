# SPDX-License-Identifier: MIT
"""A body with a Kane damper: against SciPy on two bodies that share their momentum."""

import copy
import pickle

import budgets
import numpy as np
import pytest
from closeness import assert_allclose
from polhode import (
    Adaptive,
    Body,
    Collocation,
    ConstantTorque,
    Event,
    KaneDamper,
    Problem,
    RotorState,
    SaveAt,
    Scenario,
    Splitting,
    System,
    Units,
    analysis,
    angular_velocity,
    energy,
    integrate,
)
from polhode.rates import at_damper_rate
from rejections import rejected
from scipy.integrate import solve_ivp

MOMENTS = np.array([1.0, 1.6, 2.1])
BODY = Body(*MOMENTS)
DAMPER = KaneDamper(0.3, 0.4)
START = RotorState([0.5, 0.5, -0.5, 0.5], [0.8, 1.9, 0.3])
RATE = np.array([0.4, -0.7, 0.2])
SYSTEM = System(BODY, damper=DAMPER)


METHODS = pytest.mark.parametrize(
    "method", [Adaptive(1e-13), Collocation(1e-13), Collocation(step=0.2)], ids=repr
)


def problem(stop=20.0, method=None, **more):
    method = method or Adaptive(1e-13)
    return Problem(SYSTEM, START, 0.0, stop, method, damper_rate=RATE, **more)


@METHODS
def test_motion_is_that_of_two_bodies(method):
    J, c = DAMPER.moment, DAMPER.friction

    def rates(t, y):
        g, h = y[:3], y[3:]
        w = (g - h) / (MOMENTS - J)
        return np.concatenate([np.cross(g, w), np.cross(h, w) - c * (h / J - w)])

    w0 = (START.g - J * RATE) / MOMENTS
    tolerance = budgets.oracle_tolerance
    t = np.linspace(0.0, 20.0, 41)
    y = solve_ivp(rates, (0, 20), np.concatenate([START.g, J * (w0 + RATE)]), "DOP853", t,
                  rtol=tolerance, atol=tolerance).y.T
    w = (y[:, :3] - y[:, 3:]) / (MOMENTS - J)
    run = integrate(problem(method=method), SaveAt.times(t))
    far = budgets.kane_two_bodies_scipy
    assert_allclose(run.g, y[:, :3], rtol=0, atol=far)
    assert_allclose(run.damper_rate, y[:, 3:] / J - w, rtol=0, atol=far)
    table = run.columns(["omega", "damper", "energy"], system=SYSTEM)
    assert_allclose(np.column_stack([table[f"w{i}"] for i in (1, 2, 3)]), w, rtol=0, atol=far)
    assert_allclose(np.column_stack([table[f"s{i}"] for i in (1, 2, 3)]), run.damper_rate)
    T = ((y[:, :3] - y[:, 3:]) * w).sum(1) / 2 + (y[:, 3:] ** 2).sum(1) / (2 * J)
    assert_allclose(table["E"], T, rtol=0, atol=far)
    assert_allclose(table["dE"], T - T[0], rtol=0, atol=far)
    assert np.all(np.diff(T) < 0.0)
    assert_allclose(DAMPER.momentum(BODY, run.g, run.damper_rate), y[:, 3:], rtol=0, atol=far)
    back = DAMPER.relative_rate(BODY, run.g, DAMPER.momentum(BODY, run.g, run.damper_rate))
    assert_allclose(back, run.damper_rate, rtol=0, atol=far)
    assert_allclose(run.g / MOMENTS + DAMPER.rate_of_body(BODY, run.damper_rate), w, atol=far)
    kinetic = (run.g**2 / MOMENTS).sum(1) / 2 + DAMPER.energy(BODY, run.damper_rate)
    assert_allclose(kinetic, T, rtol=0, atol=far)


def test_acceleration_is_the_slope_of_the_rate():
    run = integrate(problem(1.0))
    t, h = 0.5, 1e-3
    steps = np.array([-2, -1, 1, 2]) * h
    weights = np.array([1, -8, 8, -1]) / (12 * h)
    slope = weights @ run.damper_rate_at(t + steps)
    dg = weights @ run.at(t + steps).g
    s = run.damper_rate_at(t)
    got = DAMPER.acceleration(BODY, run.at(t).g, dg, s)
    assert_allclose(got, slope, rtol=0, atol=budgets.kane_slope)


def test_at_one_rate():
    at = at_damper_rate(SYSTEM, RATE)
    assert at.damper is None and SYSTEM.damper == DAMPER and len(at.terms) == 1
    w = (START.g - 0.3 * RATE) / MOMENTS
    assert_allclose(angular_velocity(at, 0.0, START).inertial, w, rtol=budgets.numpy_formula)
    T = (START.g**2 / MOMENTS).sum() / 2 + DAMPER.energy(BODY, RATE)
    assert_allclose(energy(at, 0.0, START), T, rtol=budgets.numpy_formula)
    assert not SYSTEM.is_hamiltonian
    torque = ConstantTorque([0, 0, 1])
    assert at_damper_rate(System(BODY, None, torque, DAMPER), RATE).terms[0] is torque


def test_values():
    for value in (DAMPER, SYSTEM):
        assert copy.copy(value) == value and pickle.loads(pickle.dumps(value)) == value
        assert hash(value) == hash(copy.copy(value))
    assert repr(DAMPER) == "KaneDamper(moment=0.3, friction=0.4)"
    assert repr(SYSTEM).endswith(", damper=KaneDamper(moment=0.3, friction=0.4))")
    assert SYSTEM != System(BODY) and System(BODY).damper is None
    again = pickle.loads(pickle.dumps(problem()))
    assert np.array_equal(again.damper_rate, RATE)
    run = integrate(problem(5.0, events=[Event("level", lambda t, s: s.g[2])]))
    kept = pickle.loads(pickle.dumps(run))
    assert np.array_equal(kept.damper_rate, run.damper_rate)
    assert run.events and run.events[0].damper_rate.shape == (3,)
    assert np.array_equal(kept.events[0].damper_rate, run.events[0].damper_rate)
    assert_allclose(run.damper_rate_at(run.events[0].t), run.events[0].damper_rate)
    assert run.damper_rate_at(np.zeros((2, 3))).shape == (2, 3, 3)
    assert np.array_equal(run.damper_rate_at(0.0), RATE)


def test_sinks_get_its_rate():
    blocks = []
    integrate(problem(5.0), SaveAt.count(0, 5, 11), sink=lambda *block: blocks.append(block))
    t, states, rates = blocks[0]
    want = integrate(problem(5.0), SaveAt.count(0, 5, 11))
    assert np.array_equal(t, want.t) and np.array_equal(states.g, want.g)
    assert np.array_equal(rates, want.damper_rate)


@pytest.mark.parametrize(("call", "message"), [
    (lambda: KaneDamper(0.0, 1.0), "moment 0 must be positive"),
    (lambda: System(BODY, damper=KaneDamper(0.6, 1.0)), "what is left must be a body"),
    (lambda: angular_velocity(SYSTEM, 0.0, START), "take at_damper_rate"),
    (lambda: at_damper_rate(System(BODY), RATE), "without a damper"),
    (lambda: integrate(Problem(System(BODY), START, 0.0, 1.0, damper_rate=RATE)),
     "without a damper"),
    (lambda: integrate(Problem(SYSTEM, START, 0.0, 1.0, Splitting(0.1))),
     "method must be Adaptive or Collocation"),
    (lambda: analysis.chaos_indicator(problem(1.0), [1.0]), "which integrate alone carries"),
])  # fmt: skip
def test_refusals(call, message):
    rejected(ValueError, message, call)


@METHODS
def test_scenarios_are_built_and_run(method):
    for units in (Units(angle="deg"), Units(angle="rad")):
        scenario = Scenario.build(System(BODY, None, ConstantTorque([0.01, 0, 0]), DAMPER),
                                  START, (0.0, 4.0, 1.0), method, columns=["g", "damper"],
                                  units=units, damper_rate=RATE)
        assert scenario.system.damper == DAMPER
        assert np.array_equal(scenario.damper_rate, RATE)
        assert "kane1966" in [c.key for c in scenario.citations]
        system = scenario.system
        run = integrate(Problem(system, START, 0.0, 4.0, method, damper_rate=RATE),
                        np.arange(5.0))
        table = scenario.run()
        turn = np.degrees(1.0) if units.angle == "deg" else 1.0
        got = np.column_stack([table[f"s{i}"] for i in (1, 2, 3)]) / turn
        assert_allclose(got, run.damper_rate, rtol=budgets.numpy_formula)
    rejected(ValueError, "the system has no damper", Scenario.build, BODY, START, damper_rate=RATE)
    rejected(ValueError, r"expected \(3,\)", Scenario.build, SYSTEM, START, damper_rate=[1.0, 2.0])
