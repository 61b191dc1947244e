# SPDX-License-Identifier: MIT
"""Exact free rotation from Python, against Euler's equations integrated by SciPy."""

import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from interrupts import LATEST, seconds_from_signal
from scipy.integrate import solve_ivp

BODY = polhode.Body(1.0, 2.0, 2.5)
SHORT = polhode.RotorState([0.9, 0.1, -0.3, 0.2], [0.3, 0.8, 2.0])
LONG = polhode.RotorState([0.9, 0.1, -0.3, 0.2], [2.0, 0.8, 0.3])


def equations(t, y):
    q, g = y[:4], y[4:]
    w = g / BODY.moments
    turn = 0.5 * np.array([-q[1:] @ w, *(q[0] * w + np.cross(q[1:], w))])
    return np.concatenate([turn, np.cross(g, w)])


@pytest.mark.parametrize("state", [SHORT, LONG], ids=["short axis", "long axis"])
def test_it_is_the_solution_of_eulers_equations(state):
    t = np.linspace(0.0, 20.0, 41)
    run = solve_ivp(equations, (0, 20), np.concatenate([state.q, state.g]), "DOP853", t,
                    rtol=1e-13, atol=1e-14)
    exact = polhode.FreeRotation(BODY, state).at(t)
    assert_allclose(exact.g, run.y[4:].T, atol=budgets.adaptive_short_run)
    assert_allclose(np.abs(np.sum(exact.q * run.y[:4].T, -1)), 1.0,
                    atol=budgets.adaptive_short_run)


def test_times_of_any_shape_and_an_epoch():
    motion = polhode.FreeRotation(BODY, SHORT, t0=5.0)
    assert motion.at(5.0).shape == ()
    assert_allclose(motion.at(5.0).g, SHORT.g, rtol=budgets.chart_rounding)
    t = np.arange(6.0).reshape(2, 3)
    block = motion.at(t)
    assert block.shape == (2, 3)
    assert block[1, 2] == motion.at(5.0)
    assert motion.at(t.astype(int)) == block
    assert motion.at([]).shape == (0,)


def test_properties_are_those_of_the_motion():
    motion = polhode.FreeRotation(BODY, SHORT)
    assert motion.regime is polhode.free.Regime.short_axis
    assert_allclose(motion.momentum, np.linalg.norm(SHORT.g), rtol=budgets.chart_rounding)
    assert_allclose(motion.energy, polhode.kinetic_energy(BODY, SHORT),
                    rtol=budgets.chart_rounding)
    distance = motion.momentum**2 - 2 * motion.energy * 2.0
    assert_allclose(motion.separatrix_distance, distance, rtol=budgets.round_trip_floor)
    assert_allclose(motion.modulus.m + motion.modulus.m1, 1.0, rtol=budgets.chart_rounding)
    turn = motion.at(motion.polhode_period)
    assert_allclose(turn.g, SHORT.g, atol=budgets.free_invariants)
    assert motion.body == BODY
    assert motion.initial_state == SHORT
    assert motion.epoch == 0.0
    assert not motion.circulates_long_axis
    assert (motion.sign_g1, motion.sign_g3) == (1, 1)
    assert_allclose(motion.circulation_action + motion.circulation_deficit, motion.momentum,
                    rtol=budgets.chart_rounding)
    assert polhode.FreeRotation(BODY, LONG).circulates_long_axis
    assert repr(motion).startswith("<FreeRotation: short_axis, G=2.17")
    assert repr(motion).endswith(f", polhode_period={motion.polhode_period}, precession_period="
                                 f"{2 * np.pi / motion.precession_rate_long}>")
    rest = polhode.FreeRotation(BODY, polhode.RotorState([1, 0, 0, 0], [0, 0, 0]))
    assert repr(rest) == ("<FreeRotation: rest, G=0.0, T=0.0, polhode_period=inf, "
                          "precession_period=inf>")
    assert repr(motion.modulus).startswith("Modulus(m=0.")


def test_mean_rates_are_what_the_attitude_does():
    motion = polhode.FreeRotation(BODY, SHORT)
    rate, cycles = motion.precession_rate_short, 400
    t = np.linspace(0, cycles * motion.polhode_period, 40 * cycles + 1)
    s = motion.at(t)
    axis = polhode.charts.attitude_matrix(s.q)[:, 2]  # b3 in inertial components
    k = polhode.charts.inertial_momentum(SHORT) / motion.momentum
    x = np.cross(k, [1.0, 0.0, 0.0])
    turned = np.unwrap(np.arctan2(axis @ np.cross(k, x), axis @ x))
    assert_allclose((turned[-1] - turned[0]) / t[-1], rate, rtol=budgets.round_trip_floor * 100)
    long = polhode.to_tumbler(motion, 0.0).precession_period
    assert_allclose(2 * np.pi / motion.precession_rate_long, long, rtol=budgets.chart_rounding)


def test_the_transition_matrix_is_the_derivative():
    motion = polhode.FreeRotation(BODY, SHORT)
    matrix = motion.state_transition([1.0, 3.0])
    assert matrix.shape == (2, 6, 6)
    step = 1e-6
    for i in range(3):
        change = np.zeros(3)
        change[i] = step
        ends = [polhode.FreeRotation(BODY, polhode.RotorState(SHORT.q, SHORT.g + sign * change))
                .at(3.0).g for sign in (1, -1)]
        slope = (ends[0] - ends[1]) / (2 * step)
        assert_allclose(matrix[1, 3:, 3 + i], slope, atol=budgets.transition_difference)


def test_a_short_arc_is_the_same_motion():
    arc = polhode.FreeRotation.short_arc(BODY, SHORT)
    exact = polhode.FreeRotation(BODY, SHORT)
    assert_allclose(arc.at(2.0).g, exact.at(2.0).g, rtol=budgets.round_trip_floor)


@pytest.mark.parametrize("state", [SHORT, LONG], ids=["short axis", "long axis"])
def test_flow_charts_give_the_state_back(state):
    motion = polhode.FreeRotation(BODY, state)
    t = np.linspace(0.0, 10.0, 9)
    s = motion.at(t)
    sadov = polhode.to_sadov(motion, t)
    assert_allclose(polhode.to_rotor(BODY, sadov).g, s.g, atol=budgets.flow_round_trip * 10)
    serret = polhode.to_serret(motion, t)
    back = polhode.to_rotor(BODY, serret, t)
    assert_allclose(back.g, s.g, atol=budgets.flow_round_trip * 10)
    frequencies = polhode.free.sadov_frequencies(motion)
    advance = np.unwrap(sadov.phi_l)
    assert_allclose(advance - advance[0], frequencies.n_l * t, atol=budgets.tumbler_round_trip)
    assert "n_l=" in repr(frequencies)
    assert polhode.to_sadov(BODY, s) == polhode.to_sadov(BODY, s)
    assert_allclose(polhode.to_sadov(BODY, s).I_l, sadov.I_l, rtol=budgets.round_trip_floor)
    assert_allclose(polhode.to_serret(BODY, s, t).g0, serret.g0, atol=budgets.tumbler_round_trip)
    tumbler = polhode.to_tumbler(motion, t)
    assert tumbler.pole.shape == (9, 3)
    assert_allclose(polhode.to_rotor(BODY, tumbler).g, s.g, atol=budgets.tumbler_round_trip * 10)
    assert polhode.to_tumbler(BODY, s).shape == (9,)
    again = polhode.free.free_rotation(BODY, polhode.to_serret(motion, 0.0))
    assert_allclose(again.at(t).g, s.g, atol=budgets.flow_round_trip * 10)


def test_what_a_light_curve_tells_becomes_a_motion():
    motion = polhode.FreeRotation(BODY, SHORT)
    seen = polhode.to_tumbler(motion, 0.0)
    assert isinstance(seen.mode, polhode.free.Regime)
    assert abs(seen.psi0) <= polhode.free.psi_max(motion)
    assert seen.rotation_period / seen.precession_period > polhode.free.least_period_ratio(
        BODY, seen.mode)
    with pytest.raises(ValueError, match="P_psi/P_phi = 0.1 is impossible"):
        polhode.to_rotor(BODY, polhode.TumblerState(1.0, 0.1, [0, 0, 1], seen.mode, 0, 0))


def test_a_million_states_can_be_interrupted_by_ctrl_c():
    motion = polhode.FreeRotation(BODY, SHORT)
    assert seconds_from_signal(lambda: [motion.at(np.arange(1e6)) for _ in range(100)]) < LATEST


@pytest.mark.parametrize(("make", "error", "says"), [
    (lambda: polhode.FreeRotation(BODY, polhode.FreeRotation(BODY, SHORT).at([0.0, 1.0])),
     ValueError, r"got states of shape \(2,\); expected one state"),
    (lambda: polhode.FreeRotation(BODY, SHORT, t0=np.nan), ValueError, "t0|epoch"),
    (lambda: polhode.FreeRotation(BODY, SHORT).at("soon"), TypeError, "t: got a str"),
    (lambda: polhode.FreeRotation(BODY, SHORT).at(1j), TypeError, "expected real numbers"),
    (lambda: polhode.FreeRotation((1, 2, 3), SHORT), TypeError, "Body"),
    (lambda: polhode.to_tumbler(polhode.FreeRotation(BODY, polhode.RotorState(
        [1, 0, 0, 0], [0, 0, 1])), 0.0), ValueError, "steady"),
    (lambda: polhode.to_rotor(BODY, polhode.SerretState(0, 0, [0, 1], 1, 0, 0.2), [1, 2, 3]),
     ValueError, "do not broadcast"),
    (lambda: polhode.free.free_rotation(BODY, polhode.SerretState(0, 0, [0, 1], 1, 0, 0.2)),
     ValueError, "expected one SerretState"),
], ids=lambda x: "" if callable(x) else str(x)[:24])
def test_bad_input_is_named(make, error, says):
    with pytest.raises(error, match=says):
        make()


def test_motions_and_their_numbers_are_values():
    motion = polhode.FreeRotation(BODY, SHORT, 2.0)
    arc = polhode.FreeRotation.short_arc(BODY, SHORT, 2.0)
    assert motion == polhode.FreeRotation(BODY, SHORT, 2.0) != arc
    far = 1e6 * motion.polhode_period
    for thing in (motion, arc):
        again = pickle.loads(pickle.dumps(thing))
        assert again == thing
        assert again.at(far) == thing.at(far)
    for number in (motion.modulus, polhode.free.sadov_frequencies(motion)):
        again = pickle.loads(pickle.dumps(number))
        assert again == number
        assert hash(again) == hash(number)


def test_jacobians_of_flow_charts_are_derivatives():
    motion = polhode.FreeRotation(BODY, SHORT)
    sadov = polhode.to_sadov(motion, [0.0, 3.0])
    B = polhode.charts.chart_jacobian(BODY, sadov)
    assert B.shape == (2, 6, 6)
    serret, t = polhode.to_serret(motion, 3.0), 3.5
    serret_B = polhode.charts.chart_jacobian(BODY, serret, t)
    step = 1e-6
    near = {"rtol": budgets.transition_difference, "atol": budgets.transition_difference}
    for k, name in enumerate(("phi_l", "phi_g", "phi_h", "I_l", "I_g", "I_h")):
        ends = [polhode.to_rotor(BODY, moved(sadov[1], name, sign * step)).g for sign in (1, -1)]
        slope = (ends[0] - ends[1]) / (2 * step)
        assert_allclose(B[1, 3:, k], slope, **near)
    for k, (name, sense) in enumerate((("g0", 1), ("h", 1), ("t0", -1), ("G", 1), ("H", 1),
                                       ("T", 1))):
        ends = [polhode.to_rotor(BODY, moved(serret, name, sign * step), t).g for sign in (1, -1)]
        slope = sense * (ends[0] - ends[1]) / (2 * step)
        assert_allclose(serret_B[3:, k], slope, **near)


def moved(state, name, change):
    """The state with one of its fields changed."""
    names = [field for field in type(state).__dict__ if isinstance(getattr(type(state), field),
                                                                   property)]
    values = {field: getattr(state, field) for field in names
              if field not in ("shape", "ndim", "size")}
    return type(state)(**{**values, name: values[name] + change})


def test_many_states_have_the_bits_of_one_at_a_time():
    times = np.concatenate([np.linspace(-50, 1e6, 1001), [np.nan, np.inf, 1e300]])
    for state in (SHORT, polhode.RotorState([1, 0, 0, 0], [0, 0, 1.5])):
        motion = polhode.FreeRotation(BODY, state)
        many = motion.at(times.reshape(4, 251))
        for k in (0, 1, 500, 1000, 1001, 1002, 1003):
            one = motion.at(float(times[k]))
            np.testing.assert_array_equal(many.q[k // 251, k % 251], one.q)
            np.testing.assert_array_equal(many.g[k // 251, k % 251], one.g)
        backwards = motion.at(times[::-1])
        np.testing.assert_array_equal(backwards.q[::-1], many.q.reshape(-1, 4))


def test_an_even_grid_has_the_states_of_its_times():
    for state in (SHORT, LONG, polhode.RotorState([1, 0, 0, 0], [0, 0, 1.5])):
        motion = polhode.FreeRotation(BODY, state, 0.25)
        grid = motion.at_grid(-3.0, 0.125, 1000)
        times = -3.0 + 0.125 * np.arange(1000)
        assert grid.shape == (1000,)
        assert_allclose(grid.q, motion.at(times).q, rtol=0, atol=budgets.free_state)
        assert_allclose(grid.g, motion.at(times).g, rtol=0,
                        atol=budgets.free_state * motion.momentum)


def test_a_grid_goes_on_with_the_same_bits_wherever_it_is_cut():
    motion = polhode.FreeRotation(BODY, SHORT)
    whole = motion.at_grid(0.5, 0.3, 5000)
    for first, count in ((0, 1), (1, 700), (701, 64), (765, 4235), (4999, 1), (5000, 0)):
        part = motion.at_grid(0.5, 0.3, count, first=first)
        np.testing.assert_array_equal(part.q, whole[first:first + count].q)
        np.testing.assert_array_equal(part.g, whole[first:first + count].g)


@pytest.mark.parametrize("count, first, says", [
    (-1, 0, "at_grid: got count = -1; expected 0 or more"),
    (3, -2, "at_grid: got first = -2; expected 0 or more"),
    (3, 2**53, "expected indices up to 2^53")])
def test_a_grid_that_is_none_is_named(count, first, says):
    with pytest.raises(ValueError, match=says.replace("^", r"\^")):
        polhode.FreeRotation(BODY, SHORT).at_grid(0.0, 1.0, count, first=first)
