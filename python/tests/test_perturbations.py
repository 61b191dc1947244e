# SPDX-License-Identifier: MIT
"""Terms: their effect against formulas written in NumPy, and terms that Python writes."""

import copy
import gc
import math
import pickle
import weakref

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from differences import slope
from polhode import (
    Adaptive,
    Body,
    ConstantTorque,
    Frame,
    GravityGradient,
    HamiltonianTerm,
    KeplerElements,
    KeplerOrbit,
    LinearDamping,
    PrecessingKeplerOrbit,
    Problem,
    RotorState,
    System,
    TorqueTerm,
    energy,
    integrate,
)
from polhode.analysis import state_transitions
from polhode.charts import attitude_matrix, canonical_state, osculating_state
from polhode.rates import effect
from polhode.satellites import SecularRates
from rejections import rejected

EPS = np.finfo(float).eps
ROUNDED = budgets.numpy_formula
SLOPES = budgets.numpy_differences
BODY = Body(1.0, 2.0, 2.5)
GM = 0.7
ELEMENTS = KeplerElements(gm=1.0, pericentre=1.5, eccentricity=0.2, inclination=0.4, node=0.3)
ORBIT = KeplerOrbit(ELEMENTS)
FRAME = Frame.precessing([0.1, -0.3, 1.0], 0.2)
STATE = RotorState([0.5, -0.3, 0.4, 0.7], [0.3, -1.1, 0.8])
T = 1.7


def about(term, frame=None, body=BODY):
    """The effect of a term alone."""
    return effect(System(body, frame, term), T, STATE)


def gravity(t, s):
    """MacCullagh's potential, for positions in the axes of the state."""
    x = ORBIT.position(t)
    n = attitude_matrix(s.q) @ x / np.sqrt(x @ x)
    I = BODY.moments
    return GM / (2 * np.sqrt(x @ x) ** 3) * (3 * (n * I) @ n - I.sum())


def table(t):
    return ORBIT.position(t)


def gravity_torque(x_B):
    r = np.linalg.norm(x_B)
    n = x_B / r
    return 3 * GM / r**3 * np.cross(n, BODY.moments * n)


ORBITS = [ORBIT, PrecessingKeplerOrbit(ELEMENTS, SecularRates(node=0.1)), table,
          lambda t: list(ORBIT.position(t))]


@pytest.mark.parametrize("orbit", ORBITS, ids=["Kepler", "precessing", "function", "list"])
@pytest.mark.parametrize("axes", ["inertial", "reference"])
def test_gravity_gradient_is_maccullaghs(orbit, axes):
    term = GravityGradient(orbit, GM, axes=axes)
    x = np.array(orbit(T))
    if axes == "inertial":
        x = attitude_matrix(FRAME.at(T).q_IS) @ x
    moving = effect(System(BODY, FRAME, term), T, STATE)
    alone = effect(System(BODY, FRAME), T, STATE)
    torque = gravity_torque(attitude_matrix(STATE.q) @ x)
    assert_allclose(moving.u - alone.u, torque, rtol=ROUNDED)
    assert_allclose(moving.v, alone.v)


def test_a_hamiltonian_in_python_is_gravity_gradient_to_rounding():
    written, known = HamiltonianTerm(gravity), GravityGradient(ORBIT, GM)
    a, b = about(written), about(known)
    assert_allclose(a.u, b.u, atol=budgets.perturb_eps * EPS * np.linalg.norm(b.u))
    assert not a.v.any()
    h = [energy(System(BODY, None, term), T, STATE) for term in (written, known)]
    assert_allclose(h[0], h[1], rtol=budgets.perturb_eps * EPS)
    problems = [Problem(System(BODY, None, term), STATE, 0.0, 3.0) for term in (written, known)]
    ends = [integrate(p, [3.0]).states[0] for p in problems]
    assert_allclose(ends[0].q, ends[1].q, atol=budgets.adaptive_short_run)
    matrices = [state_transitions(p, [3.0]).transition[0] for p in problems]
    assert_allclose(matrices[0], matrices[1], atol=budgets.transition_method)


def test_a_hamiltonian_in_python_runs_in_double_double():
    still = ORBIT.position(0.0)

    def held(t, s):
        n = attitude_matrix(s.q) @ still
        return 0.1 * (n * BODY.moments) @ n + 0.1 * s.g[0] ** 2

    method = Adaptive(1e-25, "double_double")
    system = System(BODY, None, HamiltonianTerm(held))
    end = integrate(Problem(system, STATE, 0.0, 2.0, method), [2.0]).states[0]
    rough = integrate(Problem(system, STATE, 0.0, 2.0), [2.0]).states[0]
    assert_allclose(end.q, rough.q, atol=budgets.adaptive_short_run)
    # the sum of energies is known to 25 digits: rounded once
    E = energy(system, 0.0, STATE)
    assert_allclose(energy(system, 2.0, end), E, rtol=budgets.numpy_rounding)


def test_the_effect_of_any_energy_is_its_slope():
    def H(t, s):
        a, b = s.g @ [0.1, 0.2, -0.3], attitude_matrix(s.q)[0] @ [1.0, 2.0, 0.5]
        return np.sin(t) * a**2 * np.exp(0.1 * b) + np.arctan2(a, 2.0 + b)

    e = about(HamiltonianTerm(H))
    for k in range(3):
        axis = np.eye(3)[k]

        def pushed(d, axis=axis):
            return RotorState(STATE.q, STATE.g + d * axis)

        def turned(d, axis=axis):
            w, v = np.cos(d / 2), np.sin(d / 2) * axis
            p, u = STATE.q[0], STATE.q[1:]
            return RotorState(np.r_[p * w - u @ v, p * v + w * u + np.cross(u, v)], STATE.g)

        assert_allclose(e.v[k], slope(lambda d: H(T, pushed(d))), atol=SLOPES)
        assert_allclose(e.u[k], -slope(lambda d: H(T, turned(d))), atol=SLOPES)


def test_second_derivatives_of_a_python_energy():
    """canonical_state needs dv/dg, which an energy of fourth degree in g has not constant."""
    system = System(BODY, FRAME, HamiltonianTerm(lambda t, s: 0.05 * (s.g @ s.g) ** 2))
    back = canonical_state(system, T, osculating_state(system, T, STATE))
    assert_allclose(back.g, STATE.g, rtol=budgets.osculation_round_trip)
    assert np.linalg.norm(osculating_state(system, T, STATE).g - STATE.g) > 0.1


def test_torques():
    u = np.array([0.1, -0.2, 0.3])
    in_frame = attitude_matrix(STATE.q) @ u
    assert_allclose(about(ConstantTorque(u)).u, u)
    assert_allclose(about(ConstantTorque(u, "inertial")).u, in_frame, atol=budgets.numpy_rounding)
    alone = about(())
    assert_allclose(about(ConstantTorque(u, "reference"), FRAME).u - effect(
        System(BODY, FRAME), T, STATE).u, in_frame, rtol=ROUNDED)
    q_IS = FRAME.at(T).q_IS
    assert_allclose(about(ConstantTorque(u, "inertial"), FRAME).u - effect(
        System(BODY, FRAME), T, STATE).u, attitude_matrix(STATE.q) @ attitude_matrix(q_IS) @ u,
        rtol=ROUNDED)
    assert not alone.u.any() and not alone.v.any()


FULL = np.array([[0.3, 0.1, 0.0], [0.1, 0.2, 0.05], [0.0, 0.05, 0.4]])


@pytest.mark.parametrize(("term", "D"), [
    (LinearDamping(0.2), 0.2 * np.eye(3)),
    (LinearDamping([0.1, 0.2, 0.0]), np.diag([0.1, 0.2, 0.0])),
    (LinearDamping(FULL, BODY), FULL),
], ids=["one", "diagonal", "matrix"])
def test_damping(term, D):
    assert_allclose(about(term).u, -D @ (STATE.g / BODY.moments), rtol=budgets.numpy_rounding)
    assert_allclose(term.coefficients if term.body else np.diag(term.coefficients), D)
    assert term.supports_flow and not term.supports_energy


def test_a_torque_in_python():
    calls = []

    def drag(t, s):
        calls.append((t, s))
        return -0.1 * s.g * t

    term = TorqueTerm(drag)
    assert_allclose(about(term).u, -0.1 * STATE.g * T)
    t, s = calls[0]
    assert t == T and isinstance(s, RotorState) and s.shape == ()
    assert term.name == "drag" and term.function is drag
    assert not (term.supports_energy or term.supports_flow or term.supports_any_real)
    # the exact solution of dg/dt = -0.1 t g, for a sphere
    ball = System(Body(1, 1, 1), terms=term)
    end = integrate(Problem(ball, STATE, 0.0, 2.0), [2.0]).states[0]
    assert_allclose(end.g, STATE.g * np.exp(-0.1 * 2.0**2 / 2), rtol=budgets.adaptive_short_run)


@pytest.mark.parametrize("returned", [
    None, 1.0, (1.0, 2.0), [1, 2, None], "abc", np.zeros(4), np.zeros((3, 1)), [1j, 0, 0]])
def test_what_is_no_torque(returned):
    match = 'TorqueTerm "drag": the function returned .*; expected 3 numbers'
    rejected((TypeError, ValueError), match, about, TorqueTerm(lambda t, s: returned, name="drag"))


@pytest.mark.parametrize("returned", [None, "abc", [1.0, 2.0], 1j])
def test_what_is_no_energy(returned):
    with pytest.raises((TypeError, ValueError), match='HamiltonianTerm "H": the function returned'):
        about(HamiltonianTerm(lambda t, s: returned, name="H"))


@pytest.mark.parametrize("returned", [None, 1.0, (1.0, 2.0), "abc"])
def test_what_is_no_position(returned):
    match = 'GravityGradient "moon": orbit: the function returned'
    with pytest.raises((TypeError, ValueError), match=match):
        about(GravityGradient(lambda t: returned, 1.0, name="moon"))


def test_a_choice_of_numpy_is_an_energy():
    chosen = HamiltonianTerm(lambda t, s: np.where(s.g[0] > 0, 2.0 * s.g[0], -s.g[0]))
    assert about(chosen).v.tolist() == [2, 0, 0]
    assert energy(System(BODY, terms=chosen), T, STATE) == pytest.approx(
        polhode.kinetic_energy(BODY, STATE) + 2 * STATE.g[0])


def test_any_three_numbers_are_a_torque():
    for three in ([1, 2, 3], (1.0, 2, 3), np.arange(1, 4), np.float32([1, 2, 3])):
        assert about(TorqueTerm(lambda t, s, three=three: three)).u.tolist() == [1, 2, 3]
    assert np.isnan(about(TorqueTerm(lambda t, s: [math.nan, 0, 0])).u[0])
    assert about(HamiltonianTerm(lambda t, s: 3)).u.tolist() == [0, 0, 0]
    assert np.isnan(about(HamiltonianTerm(lambda t, s: math.nan * s.g[0])).v[0])


class Lost(Exception):
    pass


def raises(*_):
    raise Lost("out of range")


@pytest.mark.parametrize("term", [TorqueTerm(raises), HamiltonianTerm(raises),
                                  GravityGradient(raises, 1.0)], ids=lambda t: type(t).__name__)
def test_what_a_term_raises_passes_through(term):
    system = System(BODY, terms=term)
    rejected(Lost, "out of range", effect, system, 0.0, STATE)
    with pytest.raises(Lost):
        effect(system, np.zeros(1000), STATE)
    with pytest.raises(Lost):
        integrate(Problem(system, STATE, 0.0, 1.0))


def test_what_python_on_floats_cannot_do():
    push = TorqueTerm(lambda t, s: s.g, name="push")
    problem = Problem(System(BODY, terms=push), STATE, 0.0, 1.0)
    rejected(ValueError, "push", state_transitions, problem, [1.0])
    precise = Adaptive(1e-20, "double_double")
    rejected(ValueError, "push", integrate, Problem(problem.system, STATE, 0.0, 1.0, precise))
    rejected(ValueError, "push", energy, problem.system, 0.0, STATE)
    follows = System(BODY, terms=GravityGradient(table, 1.0, name="moon"))
    rejected(ValueError, "moon.*float alone", integrate, Problem(follows, STATE, 0.0, 1.0, precise))
    assert state_transitions(Problem(follows, STATE, 0.0, 1.0), [1.0]).transition.shape == (1, 6, 6)


def test_a_term_said_to_be_a_kick_can_be_split():
    scheme = polhode.Splitting(0.02)
    written = System(BODY, None, HamiltonianTerm(gravity, kick=True))
    pushed = System(BODY, None, TorqueTerm(
        lambda t, s: gravity_torque(attitude_matrix(s.q) @ ORBIT.position(t)), kick=True))
    known = System(BODY, None, GravityGradient(ORBIT, GM))
    runs = [integrate(Problem(of, STATE, 0.0, 2.0, scheme), [2.0]).states[0]
            for of in (written, pushed, known)]
    assert_allclose(runs[0].q, runs[2].q, atol=ROUNDED)
    assert_allclose(runs[1].q, runs[2].q, atol=ROUNDED)
    assert written.terms[0].is_kick and written.terms[0].supports_energy
    matrices = [state_transitions(Problem(of, STATE, 0.0, 2.0, scheme), [2.0]).transition
                for of in (written, known)]
    assert_allclose(matrices[0], matrices[1], atol=budgets.transition_method)
    with pytest.raises(ValueError, match="no exact flow"):
        integrate(Problem(System(BODY, None, HamiltonianTerm(gravity)), STATE, 0.0, 2.0, scheme))
    no_kick = HamiltonianTerm(lambda t, s: s.g[0], name="drift", kick=True)
    rejected(ValueError, '"drift": depends on the momentum', about, no_kick)


@pytest.mark.parametrize(("call", "error", "message"), [
    (lambda: GravityGradient(ORBIT, -1.0), ValueError, "gm"),
    (lambda: GravityGradient(ELEMENTS, 1.0), TypeError,
     "expected a function|or a function of time"),
    (lambda: GravityGradient(ORBIT, 1.0, axes="equator"), ValueError,
     "axes: got 'equator'; expected one of inertial reference"),
    (lambda: GravityGradient(ORBIT, 1.0, name=3), TypeError, "name"),
    (lambda: ConstantTorque([1, 2]), ValueError, r"torque: got shape \(2,\)"),
    (lambda: ConstantTorque([1, 2, math.nan], "inertial"), ValueError, "ConstantTorque"),
    (lambda: LinearDamping(FULL), ValueError, "body: got nothing; expected the body"),
    (lambda: LinearDamping(np.zeros((2, 3)), BODY), ValueError, r"got shape \(2, 3\)"),
    (lambda: LinearDamping(-1.0), ValueError, "LinearDamping"),
    (lambda: LinearDamping(FULL, 1.0), TypeError, "body: got 1.0, a float; expected a Body"),
    (lambda: TorqueTerm([1, 2, 3]), TypeError, "expected a function|or a function of time"),
    (lambda: polhode.types.AnyPerturbation(), TypeError, None),
])  # fmt: skip
def test_wrong_arguments(call, error, message):
    rejected(error, message, call)


TERMS = [
    GravityGradient(ORBIT, GM, axes="reference", name="moon"),
    GravityGradient(table, GM),
    ConstantTorque([1, 2, 3]),
    ConstantTorque([1, 2, 3], "reference", name="sail"),
    LinearDamping(0.2),
    LinearDamping([0.1, 0.2, 0.3], name="eddies"),
    LinearDamping(FULL, BODY),
    HamiltonianTerm(gravity, name="gravity"),
    HamiltonianTerm(gravity, kick=True),
]


@pytest.mark.parametrize("term", TERMS, ids=lambda t: f"{type(t).__name__}-{t.name}-{t.is_kick}")
def test_terms_compare_copy_and_pickle(term):
    again = pickle.loads(pickle.dumps(term))
    assert type(again) is type(term) and again == term and hash(again) == hash(term)
    assert again.name == term.name and isinstance(term, polhode.types.AnyPerturbation)
    assert about(again, FRAME) == about(term, FRAME)
    assert copy.copy(term) == term
    assert term != ConstantTorque([3, 2, 1]) and term != 1
    assert repr(term).startswith(type(term).__name__)


def test_what_a_term_was_made_from():
    moon = TERMS[0]
    assert (moon.gm, moon.orbit, moon.axes, moon.name) == (GM, ORBIT, "reference", "moon")
    assert moon.orbit is ORBIT and TERMS[1].orbit is table
    assert TERMS[2].torque.tolist() == [1, 2, 3] and TERMS[2].axes == "body"
    assert TERMS[3].axes == "reference" and TERMS[3].name == "sail"
    assert moon.is_kick and moon.supports_energy and moon.supports_flow and moon.supports_any_real
    assert repr(TERMS[4]) == "LinearDamping(coefficients=(0.2, 0.2, 0.2))"
    rejected(Exception, "lambda", pickle.dumps, TorqueTerm(lambda t, s: s.g))


class Owner:
    """Something that a function and a system refer to."""


@pytest.mark.parametrize("make", [
    TorqueTerm, HamiltonianTerm, lambda f: GravityGradient(lambda t: f(t, None), 1.0)])
def test_terms_of_functions_are_collected(make):
    def held():
        owner = Owner()
        owner.system = System(BODY, terms=make(lambda t, s: owner and 1.0))
        return weakref.ref(owner)

    gone = held()
    assert gone() is not None  # in a cycle
    gc.collect()
    assert gone() is None
