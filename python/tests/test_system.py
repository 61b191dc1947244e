# SPDX-License-Identifier: MIT
"""Systems: the laws of section 4 in numbers, charts and their Jacobians, shapes and errors."""

import copy
import math
import pickle
import subprocess
import sys
import threading

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from differences import slope
from polhode import (
    AndoyerState,
    Body,
    ConstantTorque,
    Frame,
    FreeRotation,
    GravityGradient,
    HamiltonianTerm,
    KeplerElements,
    KeplerOrbit,
    LinearDamping,
    RotorState,
    System,
    TorqueTerm,
    to_andoyer,
    to_euler,
    to_rotor,
)
from polhode.charts import CanonicalChart, CanonicalSet, attitude_matrix
from polhode.rates import Effect
from public_names import PUBLIC
from rejections import rejected

EPS = np.finfo(float).eps
ROUNDED = budgets.numpy_formula
SLOPES = budgets.numpy_differences
DRAWN = budgets.numpy_random
BODY = Body(1.0, 2.0, 2.5)
ORBIT = KeplerOrbit(KeplerElements(gm=1.0, pericentre=1.5, eccentricity=0.2, inclination=0.4))
FRAME = Frame.precessing([0.1, -0.3, 1.0], 0.2)
GRAVITY = GravityGradient(ORBIT, 0.7)


def drift(t, s):
    """An energy that depends on the momentum: its v is not zero."""
    return 0.1 * s.g[0] * s.g[2] + 0.05 * (s.g @ [1.0, 2.0, 3.0]) * np.cos(t)


DRIFT = HamiltonianTerm(drift)
SYSTEM = System(BODY, FRAME, [GRAVITY, DRIFT])
STATE = RotorState([0.5, -0.3, 0.4, 0.7], [0.3, -1.1, 0.8])
T = 1.7


@pytest.fixture
def states():
    random = np.random.default_rng(20260402)
    return RotorState(random.normal(size=(3, 20, 4)), random.normal(size=(3, 20, 3)))


@pytest.fixture
def times():
    return np.linspace(0.0, 3.0, 20)


def drift_v(t, g):
    return np.array([0.1 * g[2], 0.0, 0.1 * g[0]]) + 0.05 * np.cos(t) * np.array([1.0, 2.0, 3.0])


def test_the_inertial_rate_is_the_momentum_over_the_moments_plus_v(states, times):
    """[SA (124)]: in a precessing frame I^-1 g + v(terms) is the inertial angular velocity."""
    w = polhode.angular_velocity(SYSTEM, times, states)
    assert w.shape == (3, 20) and w.inertial.shape == (3, 20, 3)
    mu = FRAME.at(0.0).mu_S
    for k in np.ndindex(states.shape):
        v = drift_v(times[k[1]], states.g[k])
        assert_allclose(w.inertial[k], states.g[k] / BODY.moments + v, rtol=ROUNDED, atol=ROUNDED)
        mu_B = attitude_matrix(states.q[k]) @ mu
        assert_allclose(w.relative[k], w.inertial[k] - mu_B, rtol=ROUNDED, atol=ROUNDED)
    # without a term the momentum over the moments itself, in any frame
    free = polhode.angular_velocity(System(BODY, FRAME), times, states)
    assert_allclose(free.inertial, states.g / BODY.moments, rtol=budgets.numpy_rounding)


def test_the_effect_of_a_frame_is_minus_mu_g(states):
    e = polhode.rates.effect(System(BODY, FRAME), T, states)
    mu_B = np.einsum("...ij,j->...i", attitude_matrix(states.q), FRAME.at(T).mu_S)
    assert isinstance(e, Effect)
    assert_allclose(e.v, -mu_B, atol=budgets.numpy_rounding)
    assert_allclose(e.u, np.cross(states.g, mu_B), atol=budgets.numpy_rounding)


def test_the_equations_of_motion(states):
    e = polhode.rates.effect(SYSTEM, T, states)
    w = states.g / BODY.moments + e.v
    rates = polhode.rates.rotor_rates(SYSTEM, T, states)
    assert_allclose(rates.g, np.cross(states.g, w) + e.u, atol=ROUNDED)
    q, v = states.q[..., :1], states.q[..., 1:]
    assert_allclose(rates.q[..., 0], -0.5 * np.sum(v * w, -1), atol=ROUNDED)
    assert_allclose(rates.q[..., 1:], 0.5 * (q * w + np.cross(v, w)), atol=ROUNDED)
    hub = polhode.rates.hub_rates(SYSTEM, T, states)
    assert_allclose(hub.theta, w, atol=ROUNDED)
    assert_allclose(hub.g, rates.g, atol=ROUNDED)
    extra = polhode.rates.perturbation_rates(SYSTEM, T, states)
    assert_allclose(extra.theta, e.v, atol=ROUNDED)
    assert_allclose(extra.g, hub.g - np.cross(states.g, states.g / BODY.moments), atol=ROUNDED)


def test_energy(states):
    free = polhode.energy(System(BODY), T, states)
    assert_allclose(free, polhode.kinetic_energy(BODY, states), rtol=budgets.numpy_rounding)
    whole = polhode.energy(SYSTEM, T, states)
    there = polhode.charts.inertial_state(SYSTEM, T, states)
    gravity = polhode.energy(System(BODY, None, [GRAVITY]), T, there) - free
    momentum = polhode.charts.inertial_momentum(states)
    drifts = [drift(T, s) for s in states.reshape(-1)]
    expected = free + gravity - momentum @ FRAME.at(T).mu_S + np.reshape(drifts, states.shape)
    assert_allclose(whole, expected, rtol=ROUNDED, atol=ROUNDED)
    assert isinstance(polhode.energy(SYSTEM, T, STATE), float)
    assert SYSTEM.is_hamiltonian and not System(BODY, terms=LinearDamping(1.0)).is_hamiltonian
    with pytest.raises(ValueError, match='"damper" has no energy'):
        polhode.energy(System(BODY, terms=LinearDamping(1.0, name="damper")), 0.0, STATE)


def test_inertial_and_reference_states(states, times):
    there = polhode.charts.inertial_state(SYSTEM, times, states)
    q = FRAME.at(times).q_IS
    assert_allclose(attitude_matrix(there.q),
                    attitude_matrix(states.q) @ attitude_matrix(q), atol=ROUNDED)
    assert (there.g == states.g).all()
    back = polhode.charts.reference_state(SYSTEM, times, there)
    assert_allclose(back.q, states.q, atol=budgets.numpy_rounding)


def test_a_system_in_a_moving_frame_is_the_inertial_one():
    """A run in S, described in inertial axes, is the run in inertial axes."""
    method = polhode.Adaptive()
    moving, still = System(BODY, FRAME, GRAVITY), System(BODY, terms=GRAVITY)
    start = polhode.charts.inertial_state(moving, 0.0, STATE)
    ends = [polhode.integrate(polhode.Problem(system, s, 0.0, 5.0, method), [5.0]).states[0]
            for system, s in ((moving, STATE), (still, start))]
    assert_allclose(polhode.charts.inertial_state(moving, 5.0, ends[0]).q, ends[1].q,
                    atol=budgets.adaptive_short_run)


def test_osculating_and_canonical_states(states):
    osculating = polhode.charts.osculating_state(SYSTEM, T, states)
    v = polhode.rates.effect(SYSTEM, T, states).v
    assert_allclose(osculating.g, states.g + BODY.moments * v, atol=ROUNDED)
    back = polhode.charts.canonical_state(SYSTEM, T, osculating)
    assert_allclose(back.g, states.g, atol=budgets.osculation_round_trip)
    elements = polhode.charts.osculating_andoyer(SYSTEM, T, states)
    assert_allclose(elements, to_andoyer(osculating), atol=SLOPES)
    of_elements = polhode.charts.osculating_andoyer(SYSTEM, T, to_andoyer(states))
    assert_allclose(np.cos(np.asarray(of_elements)[..., :3]), np.cos(np.asarray(elements)[..., :3]),
                    atol=SLOPES)
    canonical = polhode.charts.canonical_andoyer(SYSTEM, T, elements)
    assert_allclose([canonical.L, canonical.G, canonical.H],
                    [getattr(to_andoyer(states), k) for k in "LGH"], atol=SLOPES)


def chart_rates(to_chart, s):
    """By differences along the equations of motion: d(chart)/d(state) of the rates."""
    rates = polhode.rates.rotor_rates(SYSTEM, T, s)

    def moved(d):
        return np.asarray(to_chart(RotorState(s.q + d * rates.q, s.g + d * rates.g)))

    return slope(moved)


@pytest.mark.parametrize(("chart", "to_chart", "rates_of"), [
    ("andoyer", to_andoyer, polhode.rates.andoyer_rates),
    ("euler", to_euler, polhode.rates.euler_phase_rates),
])
def test_rates_of_charts_are_slopes_along_the_motion(chart, to_chart, rates_of):
    rates = polhode.rates.canonical_rates(SYSTEM, T, STATE, chart)
    assert_allclose(rates, chart_rates(to_chart, STATE), atol=SLOPES)
    assert_allclose(np.asarray(rates_of(SYSTEM, T, STATE)), rates, rtol=budgets.numpy_rounding)
    many = polhode.rates.canonical_rates(SYSTEM, [T, 0.0], STATE, CanonicalSet[chart])
    assert many.shape == (2, 6) and (many[0] == rates).all()


def test_the_convective_term_is_what_a_perturbation_adds():
    free = polhode.rates.canonical_rates(System(BODY), T, STATE, "andoyer")
    whole = polhode.rates.canonical_rates(SYSTEM, T, STATE, "andoyer")
    added = polhode.rates.perturbation_rates(SYSTEM, T, STATE, "andoyer")
    assert_allclose(added, whole - free, atol=ROUNDED)
    convective = polhode.rates.convective_term(SYSTEM, T, STATE, "andoyer")
    assert_allclose(convective, added[:3], rtol=budgets.numpy_rounding)
    # zero unless the energy depends on the momentum
    only = System(BODY, terms=GRAVITY)
    assert_allclose(polhode.rates.convective_term(only, T, STATE, "euler"), 0, atol=ROUNDED)
    assert np.abs(polhode.rates.convective_term(SYSTEM, T, STATE, "euler")).max() > 0.01


def test_the_modified_set_is_constant_without_a_perturbation():
    motion = FreeRotation(BODY, STATE, T)
    constants = polhode.charts.modified_andoyer(BODY, [T, 2.0, 9.0], motion.at([T, 2.0, 9.0]), 0.5)
    at_epoch = np.asarray(to_andoyer(motion.at(0.5)))
    assert_allclose(np.asarray(constants), [at_epoch] * 3, atol=ROUNDED)
    back = polhode.charts.from_modified_andoyer(BODY, T, constants[0], 0.5)
    assert_allclose(np.abs(back.q @ STATE.q), 1.0, atol=ROUNDED)
    assert_allclose(np.asarray(
        polhode.rates.modified_andoyer_rates(System(BODY), T, STATE, 0.5)
    ), 0,
                    atol=ROUNDED)
    moving = polhode.rates.modified_andoyer_rates(SYSTEM, T, STATE, 0.5)
    assert isinstance(moving, polhode.rates.AndoyerRates) and abs(moving.G) > 1e-3


def test_axes(states):
    axes = polhode.charts.relative_axes(SYSTEM, T, states)
    third = np.swapaxes(attitude_matrix(states.q), -1, -2)[..., :, 2]
    assert axes.figure.shape == states.shape
    assert_allclose(np.cos(axes.figure.I), third[..., 2], atol=budgets.numpy_rounding)
    assert_allclose(axes.figure.h, np.arctan2(third[..., 0], -third[..., 1]), atol=ROUNDED)
    g = polhode.charts.inertial_momentum(states)
    tilt = np.arccos(g[..., 2] / np.linalg.norm(g, axis=-1))
    assert_allclose(axes.momentum.I, tilt, atol=ROUNDED)
    w = polhode.angular_velocity(SYSTEM, T, states).relative
    w_S = np.einsum("...ji,...j->...i", attitude_matrix(states.q), w)
    assert_allclose(axes.rotation, polhode.charts.axis_angles(w_S), atol=SLOPES)
    inertial = polhode.charts.inertial_axes(SYSTEM, T, states)
    assert not np.allclose(inertial.rotation.I, axes.rotation.I)
    assert polhode.charts.axis_angles([0, 0, 2]).I == 0 and np.isnan(
        polhode.charts.axis_angles([0, 0, 0]).I
    )
    assert "figure=AxisAngles" in repr(polhode.charts.relative_axes(SYSTEM, T, STATE))


# Jacobians


def by_differences(to_chart, s):
    """d(chart) / d(dtheta_B, dg_B)."""
    columns = []
    for k in range(6):
        def moved(d, k=k):
            turn, push = np.zeros(3), np.zeros(3)
            (turn if k < 3 else push)[k % 3] = d
            angle = np.linalg.norm(turn)
            w, v = np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) * turn / 2
            p, u = s.q[0], s.q[1:]
            q = np.r_[p * w - u @ v, p * v + w * u + np.cross(u, v)]
            return np.asarray(to_chart(RotorState(q, s.g + push)), dtype=float)

        columns.append(slope(moved))
    return np.array(columns).T


@pytest.mark.parametrize(("chart", "to_chart"), [("andoyer", to_andoyer), ("euler", to_euler)])
def test_jacobians_are_slopes(chart, to_chart):
    inverse = polhode.charts.inverse_chart_jacobian(STATE, chart)
    assert_allclose(inverse, by_differences(to_chart, STATE), atol=SLOPES)
    B = polhode.charts.chart_jacobian(STATE, chart)
    assert_allclose(B @ inverse, np.eye(6), atol=ROUNDED)
    assert_allclose(polhode.charts.chart_jacobian(to_chart(STATE)), B, atol=ROUNDED)
    assert_allclose(polhode.charts.inverse_chart_jacobian(STATE.g, B), inverse, atol=ROUNDED)


def test_jacobians_of_poincare_sets(states):
    nearest = polhode.charts.nearest_poincare(states)
    B = polhode.charts.chart_jacobian(nearest)
    assert B.shape == (3, 20, 6, 6)
    one = nearest[1, 4]
    chart = CanonicalChart("poincare", one.pole_J, one.pole_I)
    assert_allclose(polhode.charts.chart_jacobian(states[1, 4], chart), B[1, 4], atol=SLOPES)


def test_transformations_are_symplectic(states):
    J = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])
    M = polhode.charts.canonical_transformation(states, "euler", CanonicalChart("andoyer"))
    assert M.shape == (3, 20, 6, 6)
    sizes = np.abs(M) @ np.abs(J) @ np.abs(np.swapaxes(M, -1, -2))
    assert (np.abs(M @ J @ np.swapaxes(M, -1, -2) - J)
            <= budgets.symplectic_eps * EPS * (sizes + 1)).all()
    B_from = polhode.charts.chart_jacobian(states, "euler")
    B_to = polhode.charts.chart_jacobian(states, "andoyer")
    again = polhode.charts.canonical_transformation(states.g, B_from, B_to)
    assert_allclose(again, M, rtol=DRAWN, atol=DRAWN)


def test_jacobians_of_sets_that_are_not_canonical(states):
    rates = polhode.charts.to_euler_rates(BODY, STATE)
    B = polhode.charts.chart_jacobian(BODY, rates)
    inverse = polhode.charts.inverse_chart_jacobian(BODY, rates)
    assert_allclose(inverse, by_differences(
        lambda s: polhode.charts.to_euler_rates(BODY, s), STATE
    ),
                    atol=SLOPES)
    assert_allclose(B @ inverse, np.eye(6), atol=ROUNDED)
    assert_allclose(polhode.charts.body_rate_jacobian(BODY),
                    np.diag(np.r_[1, 1, 1, BODY.moments]), rtol=budgets.numpy_rounding)
    assert_allclose(polhode.charts.inverse_body_rate_jacobian(BODY),
                    np.diag(np.r_[1, 1, 1, 1 / BODY.moments]), rtol=budgets.numpy_rounding)
    there = polhode.charts.inertial_rate_jacobian(BODY, states)
    back = polhode.charts.inverse_inertial_rate_jacobian(BODY, states)
    assert there.shape == (3, 20, 6, 6)
    assert_allclose(there @ back, np.broadcast_to(np.eye(6), there.shape), atol=SLOPES)
    slopes = by_differences(lambda s: np.r_[
        np.zeros(3), polhode.charts.inertial_angular_velocity(BODY, s)], STATE)
    one = polhode.charts.inverse_inertial_rate_jacobian(BODY, STATE)
    assert_allclose(one[3:], slopes[3:], atol=SLOPES)


def test_charts_by_name():
    chart = CanonicalChart("poincare", "pi", polhode.charts.Pole.zero)
    assert (chart.set, chart.pole_J, chart.pole_I) == (
        CanonicalSet.poincare, polhode.charts.Pole.pi, polhode.charts.Pole.zero)
    assert pickle.loads(pickle.dumps(chart)) == chart and hash(chart) == hash(copy.copy(chart))
    assert eval(repr(chart), {**PUBLIC}) == chart != CanonicalChart("euler")
    rejected(ValueError, "expected one of euler andoyer poincare", CanonicalChart, "delaunay")
    rejected(TypeError, "chart", polhode.rates.canonical_rates, SYSTEM, T, STATE, 3.5)


# Andoyer's general method


def half_turn(axis, angle):
    q = [np.cos(angle / 2), 0 * angle, 0 * angle, 0 * angle]
    q[axis] = np.sin(angle / 2)
    return q


def product(a, b):
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def andoyer_variables(z):
    l, g, h, L, G, H = z
    J, I = np.arccos(L / G), np.arccos(H / G)
    q = half_turn(3, h)
    for axis, angle in ((1, I), (3, g), (1, J), (3, l)):
        q = product(q, half_turn(axis, angle))
    s = np.sqrt(G * G - L * L)
    return q, [s * np.sin(l), s * np.cos(l), L]


def euler_and_rates(z, t):
    """3-1-3 angles of a frame that turns with time, and the momentum: not canonical."""
    phi, theta, psi, *g = z
    q = product(product(half_turn(3, phi - 0.3 * t), half_turn(1, theta)), half_turn(3, psi))
    return q, g


def test_andoyers_method_in_andoyers_variables_is_hamiltons_equations():
    z = np.asarray(to_andoyer(STATE))
    assert polhode.charts.canonical_defect(andoyer_variables, z) < budgets.andoyer_method
    J = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])
    assert_allclose(polhode.charts.lagrange_brackets(andoyer_variables, z), J, atol=ROUNDED)
    rates = polhode.rates.equations_of_motion(SYSTEM, [0.0, T], z, andoyer_variables)
    assert_allclose(
        rates[1], np.asarray(polhode.rates.andoyer_rates(SYSTEM, T, STATE)), atol=ROUNDED
    )


def test_andoyers_method_in_variables_that_are_not_canonical():
    z = np.r_[0.3, 1.1, -0.4, STATE.g]
    assert polhode.charts.canonical_defect(euler_and_rates, z, T) > budgets.not_canonical
    q, g = euler_and_rates(z, T)
    s = RotorState(q, g)
    rates = polhode.rates.equations_of_motion(SYSTEM, T, z, euler_and_rates)
    hub = polhode.rates.hub_rates(SYSTEM, T, s)
    assert_allclose(rates[3:], hub.g, atol=ROUNDED)
    # the rate of turn from the angles, whose own frame turns back
    phi, theta, psi = rates[:3] - [0.3, 0.0, 0.0]
    w = [phi * np.sin(z[1]) * np.sin(z[2]) + theta * np.cos(z[2]),
         phi * np.sin(z[1]) * np.cos(z[2]) - theta * np.sin(z[2]),
         phi * np.cos(z[1]) + psi]
    assert_allclose(w, hub.theta, atol=ROUNDED)


def test_variables_that_are_none():
    z = np.ones((2, 6))
    assert polhode.charts.lagrange_brackets(andoyer_variables, 0.5 * z[0]).shape == (6, 6)
    for returned in (None, 3, ([1, 0, 0], [1, 2, 3]), ([1, 0, 0, 0], [1, 2, None])):
        with pytest.raises((TypeError, ValueError), match="lagrange_brackets: f: .* returned"):
            polhode.charts.lagrange_brackets(lambda z, x=returned: x, z)
    with pytest.raises(ValueError, match=r"z: got shape \(5,\)"):
        polhode.charts.canonical_defect(andoyer_variables, np.ones(5))
    with pytest.raises(ZeroDivisionError):
        polhode.charts.canonical_defect(lambda z: 1 / 0, z)


# What a system is


def test_a_system_keeps_what_it_was_given():
    assert SYSTEM.terms == (GRAVITY, DRIFT)
    assert SYSTEM.terms[0] is GRAVITY and SYSTEM.terms[1] is DRIFT and SYSTEM.frame is FRAME
    assert SYSTEM.body == BODY
    plain = System(BODY)
    assert plain.terms == () and plain.frame.is_inertial
    assert System(BODY, terms=GRAVITY).terms == (GRAVITY,)
    assert System(BODY, terms=(x for x in [GRAVITY, DRIFT])).terms == SYSTEM.terms
    assert repr(plain) == f"System({BODY!r})"
    assert "frame=Frame.precessing" in repr(SYSTEM) and "terms=(GravityGradient" in repr(SYSTEM)


@pytest.mark.parametrize("system", [
    System(BODY), SYSTEM,
    System(BODY, Frame.orbit_plane(0.1, 0.2),
           [ConstantTorque([1, 2, 3]), LinearDamping(0.1), GRAVITY]),
], ids=["free", "Hamiltonian", "damped"])
def test_systems_compare_copy_and_pickle(system):
    again = pickle.loads(pickle.dumps(system))
    assert again == system and hash(again) == hash(system) and again is not system
    assert polhode.rates.effect(again, T, STATE) == polhode.rates.effect(system, T, STATE)
    assert copy.copy(system) is system and copy.deepcopy(system) == system
    assert system != System(Body(1, 2, 2.6)) and system != 1


@pytest.mark.parametrize(("call", "error", "message"), [
    (lambda: System(BODY, [GRAVITY]), TypeError, "frame: got list; expected a Frame"),
    (lambda: System(BODY, terms=[ORBIT]), TypeError,
     "terms: got KeplerOrbit; expected GravityGradient"),
    (lambda: System((1, 2, 3)), TypeError, None),
    (lambda: polhode.rates.effect(SYSTEM, 0.0, to_andoyer(STATE)), TypeError, None),
    (lambda: polhode.rates.effect(SYSTEM, "now", STATE), TypeError, "t: got a str"),
    (lambda: polhode.rates.effect(SYSTEM, np.zeros(3), RotorState(np.ones((2, 4)), [1, 2, 3])),
     ValueError, "do not broadcast"),
    (lambda: setattr(SYSTEM, "terms", ()), AttributeError, None),
])  # fmt: skip
def test_wrong_arguments(call, error, message):
    rejected(error, message, call)


def test_times_and_states_broadcast(states, times):
    for name in ("effect", "angular_velocity", "rotor_rates", "hub_rates", "andoyer_rates",
                 "osculating_state", "osculating_andoyer", "inertial_state"):
        of = PUBLIC[name]
        assert of(SYSTEM, times[:, None, None], states).shape == (20, 3, 20)
        assert of(SYSTEM, times, STATE).shape == (20,)
        assert of(SYSTEM, 0.0, STATE).shape == ()
        assert of(SYSTEM, times, states)[2, 3] == of(SYSTEM, times[3], states[2, 3])
    assert polhode.energy(SYSTEM, times[:, None, None], states).shape == (20, 3, 20)
    assert polhode.rates.canonical_rates(SYSTEM, times, states, "andoyer").shape == (3, 20, 6)
    assert polhode.rates.convective_term(SYSTEM, times, states, "andoyer").shape == (3, 20, 3)


def test_not_a_number_stays_one():
    assert np.isnan(polhode.rates.effect(SYSTEM, math.nan, STATE).u).all()
    assert math.isnan(polhode.energy(SYSTEM, math.nan, STATE))


def test_poles_give_not_a_number_where_a_rate_does_not_exist():
    rates = polhode.rates.andoyer_rates(
        SYSTEM, T, to_rotor(AndoyerState(0.1, 0.2, 0.3, 1.0, 1.0, 0.5))
    )
    assert math.isnan(rates.l) and math.isnan(rates.g)
    assert not any(map(math.isnan, (rates.h, rates.L, rates.G, rates.H)))


SCRIPT = """
import polhode as p
body, start = p.Body(1, 2, 2.5), p.RotorState([1, 0, 0, 0], [1, 2, 3])
frame = p.Frame.orbit_plane(lambda t: 0.1 * t, 0.2)
terms = [p.TorqueTerm(lambda t, s: -0.1 * s.g), p.HamiltonianTerm(lambda t, s: s.g[0]),
         p.GravityGradient(lambda t: [1, 2, 3], 1.0)]
system = p.System(body, frame, terms)
run = p.integrate(p.Problem(system, start, 0.0, 0.1))
q, t, states, some = run.q, run.t, run.states, run.at([0.05])
print(p.rates.effect(system, 0.0, start).v.shape)
"""


def test_a_script_ends_without_complaint():
    """Its globals hold functions that refer to its globals, and views onto runs."""
    run = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True)
    assert (run.returncode, run.stdout.strip(), run.stderr) == (0, "(3,)", "")


def test_functions_in_python_work_in_any_thread():
    system = System(BODY, Frame.orbit_plane(lambda t: 0.1 * t, 0.2),
                    [TorqueTerm(lambda t, s: -0.1 * s.g), DRIFT])
    t = np.linspace(0.0, 1.0, 400)
    expected = polhode.rates.effect(system, t, STATE)
    got = [None] * 4

    def work(k):
        got[k] = polhode.rates.effect(system, t, STATE)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(result == expected for result in got)


def test_a_term_that_was_never_made_is_named():
    class Forgetful(polhode.TorqueTerm):
        def __init__(self):
            pass

    with pytest.raises(TypeError, match="got a Forgetful that was never made; its __init__ must"):
        polhode.System(polhode.Body(1, 2, 2.5), terms=[Forgetful()])
