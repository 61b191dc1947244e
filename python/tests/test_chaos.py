# SPDX-License-Identifier: MIT
"""Lyapunov indicator and MEGNO from Python: laws of the result, every kind of term, threads."""

import copy
import math
import pickle
import warnings

import budgets
import numpy as np
import pytest
from closeness import assert_allclose
from hyperion import HYPERION, SYSTEM
from interrupts import LATEST, seconds_from_signal
from numpy.testing import assert_array_equal
from polhode import (
    Adaptive,
    DomainError,
    HamiltonianTerm,
    Problem,
    SaveAt,
    Splitting,
    System,
    TorqueTerm,
    rotor_state,
)
from polhode.analysis import DeviationBy, chaos_indicator

START = rotor_state(HYPERION, [math.cos(0.6), 0.1, 0.2, math.sin(0.6)], [0.1, 0.0, 1.3])
STOP = 20 * 2 * math.pi


def test_the_columns_are_those_of_their_definitions():
    times = np.linspace(0.0, STOP, 4001)
    found = chaos_indicator(Problem(SYSTEM, START, 0.0, STOP, Adaptive(1e-11)), times)
    assert len(found) == 4001 and found.by == DeviationBy.variational
    assert_array_equal(found.t, times)
    assert found.growth[0] == found.megno[0] == found.mean_megno[0] == 0.0
    assert_array_equal(found.lyapunov[1:], found.growth[1:] / times[1:])
    assert found.lyapunov_time == 1 / found.lyapunov[-1]
    # MEGNO and its mean by quadrature of the rows
    h = times[1]

    def integral(y):
        return np.concatenate([[0.0], np.cumsum(0.5 * h * (y[1:] + y[:-1]))])

    megno = 2 * (found.growth[1:] - integral(found.growth)[1:] / times[1:])
    assert_allclose(found.megno[1:], megno, atol=budgets.chaos_quadrature)
    mean = integral(found.megno)[1:] / times[1:]
    assert_allclose(found.mean_megno[1:], mean, atol=budgets.chaos_quadrature)
    with pytest.raises(ValueError):
        found.growth[0] = 1.0


def test_a_deviation_in_the_plane_stays_there_and_grows_as_the_pendulum_does():
    scipy = pytest.importorskip("scipy.integrate")
    kepler = pytest.importorskip("scipy.optimize")
    B, C = HYPERION.moments[1], HYPERION.moments[2]
    A = HYPERION.moments[0]
    spin, angle, e = 1.3, 1.2, 0.1

    def rates(t, y):
        E = kepler.brentq(lambda E: E - e * math.sin(E) - t, t - e, t + e, xtol=1e-15)
        r = 1 - e * math.cos(E)
        f = math.atan2(math.sqrt(1 - e * e) * math.sin(E), math.cos(E) - e)
        k = 1.5 * (B - A) / C / r**3
        return [y[1], -k * math.sin(2 * (y[0] - f)), y[3], -2 * k * math.cos(2 * (y[0] - f)) * y[2]]

    stop = 10 * 2 * math.pi
    end = scipy.solve_ivp(
        rates, (0, stop), [angle, spin, 1.0, 0.5 * spin], method="DOP853", rtol=1e-12, atol=1e-12
    ).y[:, -1]
    start = rotor_state(HYPERION, [math.cos(angle / 2), 0, 0, math.sin(angle / 2)], [0, 0, spin])
    problem = Problem(SYSTEM, start, 0.0, stop, Adaptive(1e-13))
    found = chaos_indicator(problem, deviation=[0, 0, 1, 0, 0, 0.5])
    expected = 0.5 * math.log((end[2] ** 2 + (end[3] / spin) ** 2) / 1.25)
    assert_allclose(found.growth, [expected], atol=budgets.chaos_planar)


def test_terms_in_python_with_derivatives_and_without():
    def energy(t, s):
        return 0.3 * (s.q[1] * s.q[3] - s.q[0] * s.q[2])

    def torque(t, s):
        return -0.05 * s.g

    def by(term):
        system = System(HYPERION, terms=[term])
        return chaos_indicator(Problem(system, START, 0.0, 10.0, Adaptive(1e-11)))

    assert by(HamiltonianTerm(energy, "field")).by == DeviationBy.variational
    found = by(TorqueTerm(torque, "drag"))
    assert found.by == DeviationBy.neighbour and "second motion" in found.method


def test_a_splitting_and_a_neighbour_agree_with_the_variational_equations():
    def growth(method, **options):
        return chaos_indicator(Problem(SYSTEM, START, 0.0, 30.0, method), **options).growth

    exact = growth(Adaptive(1e-13))
    assert_allclose(growth(Splitting(0.02, "order8")), exact, atol=budgets.chaos_neighbour)
    assert_allclose(growth(Adaptive(1e-13), neighbour=True), exact, atol=budgets.chaos_neighbour)


def test_samples_copies_and_pickles():
    problem = Problem(SYSTEM, START, 0.0, 5.0, Adaptive(1e-9))
    found = chaos_indicator(problem, SaveAt.count(0.0, 5.0, 6))
    for other in (copy.copy(found), copy.deepcopy(found), pickle.loads(pickle.dumps(found))):
        assert_array_equal(other.mean_megno, found.mean_megno)
        assert other.method == found.method and other.outcome.ok
    assert repr(found).startswith("<ChaosIndicator: mean MEGNO ")


def test_what_is_refused_and_what_fails():
    problem = Problem(SYSTEM, START, 0.0, 5.0, Adaptive(1e-9))
    with pytest.raises(DomainError, match="deviation must be finite and not zero"):
        chaos_indicator(problem, deviation=np.zeros(6))
    with pytest.raises(ValueError, match="deviation"):
        chaos_indicator(problem, deviation=[1, 2, 3])

    def torque(t, s):
        return [math.nan if t > 1 else 0.0] * 3

    wall = System(HYPERION, terms=[TorqueTerm(torque, "wall")])
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        found = chaos_indicator(Problem(wall, START, 0.0, 5.0, Adaptive(1e-9)), [0.5, 5.0])
    assert len(found) == 1 and not found.outcome.ok and "wall" in found.outcome.advice
    assert "chaos_indicator: the run failed" in str(seen[0].message)


def test_ctrl_c_ends_a_run():
    problem = Problem(SYSTEM, START, 0.0, 1e7, Adaptive(1e-12))
    assert seconds_from_signal(lambda: chaos_indicator(problem)) < LATEST
