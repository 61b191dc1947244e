# SPDX-License-Identifier: MIT
"""Mean rotation under a gravity gradient: against an integration of the body, against the
precession that an average of its free rotation gives, and there and back."""

import pickle
import threading

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import Adaptive, GravityGradient
from polhode.secular import GravityGradientTheory, MeanRotation

n = 0.0531  # mean motion; bodies turn about once in 2 pi
BODY = polhode.Body(1.0, 1.3, 1.7)
START = polhode.rotor_state(BODY, [0.6, 0.5, -0.3, 0.4], [0.3, 0.1, 1.0])
WEAK = 0.05 * n**2


def orbit_of(e, motion=n):
    return polhode.KeplerOrbit(
        polhode.KeplerElements(
            motion**2, 1 - e, e, inclination=0.3, node=0.4, argument=0.7, mean_anomaly=0.2
        )
    )


ORBIT = orbit_of(0.1)
THEORY = GravityGradientTheory(BODY, ORBIT, START, gm=WEAK)
MEAN = THEORY.mean(0.0, START)


def angle(p, q):
    vector = p[..., :1] * q[..., 1:] - q[..., :1] * p[..., 1:] - np.cross(p[..., 1:], q[..., 1:])
    return 2 * np.arcsin(np.linalg.norm(vector, axis=-1))


@pytest.mark.parametrize("averages", [True, False])
def test_states_are_those_of_an_integration(averages):
    times = np.linspace(30.0, 300.0, 10)
    system = polhode.System(BODY, terms=GravityGradient(ORBIT, WEAK))
    problem = polhode.Problem(system, START, 0.0, 300.0, Adaptive(1e-13))
    exact = polhode.integrate(problem, polhode.SaveAt.times(times)).states
    errors = []
    for order in (1, 2):
        theory = GravityGradientTheory(
            BODY, ORBIT, START, gm=WEAK, order=order, averages_orbit=averages
        )
        found = theory.states(0.0, theory.mean(0.0, START), times)
        errors.append(angle(found.q, exact.q).max())
    assert errors[0] < budgets.gravity_theory_python_first
    assert errors[1] < budgets.gravity_theory_python_second


# <n n> over the orbit is (1 - z z)/2 (1 - e^2)^(-3/2), and the tensor of inertia turns about the
# momentum: dphi_h/dt = -9/4 gm/a^3 (1 - e^2)^(-3/2) (<g.I g>/G^2 - tr I/3) cos I / G.
def test_the_momentum_precesses_as_the_mean_tensor_says():
    theory = GravityGradientTheory(BODY, ORBIT, START, gm=WEAK, order=1, least=1e-15)
    m = theory.mean(0.0, START)
    # the free motion with the mean actions
    motion = polhode.FreeRotation(BODY, theory.state_of(m))
    g = motion.at(np.arange(256) * motion.polhode_period / 256).g
    moments = np.array([1.0, 1.3, 1.7])
    part = np.mean(g**2 @ moments) / motion.momentum**2 - moments.sum() / 3
    expected = -2.25 * WEAK * (1 - 0.1**2) ** -1.5 * part * m.I_h / m.I_g**2
    rates = theory.rates(0.0, m)
    assert_allclose(rates[2] / expected, 1.0, atol=budgets.gravity_theory_python_rate)
    assert (rates[3:] == 0.0).all()


def test_mean_and_osculating_undo_each_other():
    t = np.array([[0.0], [7.0], [-20.0]])
    states = THEORY.states(0.0, MEAN, [0.0, 3.0])
    back = THEORY.osculating(t, THEORY.mean(t, states))
    assert back.shape == (3, 2)
    everywhere = np.broadcast_to(states.g, (3, 2, 3))
    assert_allclose(back.g, everywhere, atol=budgets.gravity_theory_python_back)
    assert angle(back.q, states.q).max() < budgets.gravity_theory_python_back
    elements = THEORY.elements(0.0, states)
    assert angle(THEORY.state_of(elements).q, states.q).max() < budgets.gravity_theory_python_back
    # another chart of the same: in the axes of the orbit
    e = ORBIT.elements
    axes = polhode.charts.attitude_matrix(states[1].q)
    normal = [np.sin(e.node) * np.sin(e.inclination), -np.cos(e.node) * np.sin(e.inclination),
              np.cos(e.inclination)]  # fmt: skip
    along = (states[1].g @ axes) @ normal
    assert_allclose(elements.I_h[1], along, atol=budgets.gravity_theory_python_back)


def test_times_have_any_shape_and_order():
    times = np.array([[5.0, -3.0], [0.0, 5.0]])
    means = THEORY.means(0.0, MEAN, times)
    states = THEORY.states(0.0, MEAN, times)
    assert means.shape == states.shape == (2, 2)
    assert means[1, 0] == MEAN
    assert states[0, 0] == states[1, 1] == THEORY.osculating(5.0, means[0, 0])
    one = THEORY.states(0.0, MEAN, 5.0)
    assert one.shape == ()
    assert THEORY.states(0.0, MEAN, []).shape == (0,)
    assert (means.I_l == MEAN.I_l).all()


def test_parts_and_defaults():
    assert THEORY.order == 2
    assert THEORY.averages_orbit
    assert THEORY.least == 1e-15
    assert THEORY.gm == WEAK
    assert THEORY.orbit == ORBIT
    assert THEORY.term_count > 100
    assert isinstance(THEORY.reference, MeanRotation)
    weak = orbit_of(0.1, 0.005)
    assert GravityGradientTheory(BODY, weak, START).gm == 0.005**2
    names = ("I_l", "I_g", "I_h")
    m = THEORY.means(0.0, MEAN, 100.0)
    at = {name: getattr(m, name) - getattr(THEORY.reference, name) for name in names}
    at.update(k=1.0, phi_l=m.phi_l, phi_g=m.phi_g, phi_h=m.phi_h, M=0.0)
    K = THEORY.mean_hamiltonian
    rates = THEORY.rates(100.0, m)
    for i, name in enumerate(names):
        assert_allclose(K.derivative(name)(**at), rates[i], rtol=budgets.gravity_theory_python_rate)
    assert_allclose(-K.derivative("phi_h")(**at), rates[5], rtol=budgets.gravity_theory_python_rate)
    again = pickle.loads(pickle.dumps(THEORY))
    assert again.mean(1.0, START) == THEORY.mean(1.0, START)
    assert repr(THEORY) == f"<GravityGradientTheory: order 2, {THEORY.term_count} terms>"


def test_a_mean_rotation_is_a_set_of_numbers():
    m = MeanRotation(0.1, 0.2, 0.3, [1.0, 2.0], 3.0, 0.5)
    assert m.shape == (2,)
    assert pickle.loads(pickle.dumps(m)) == m
    assert np.asarray(m).shape == (2, 6)
    with pytest.raises(ValueError, match="MeanRotation: got nan; expected finite numbers"):
        MeanRotation(0.1, 0.2, 0.3, float("nan"), 3.0, 0.5)


def test_threads_share_a_theory():
    expected = THEORY.states(0.0, MEAN, np.linspace(0, 50, 60))
    found = [None] * 3

    def run(i):
        found[i] = THEORY.states(0.0, MEAN, np.linspace(0, 50, 60))

    threads = [threading.Thread(target=run, args=(i,)) for i in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(states == expected for states in found)


UPRIGHT = polhode.rotor_state(BODY, [1, 0, 0, 0], [0, 0, 1.0])
ONCE_A_TURN = polhode.free.sadov_frequencies(polhode.FreeRotation(BODY, START)).n_g
LONG = polhode.rotor_state(BODY, [1, 0, 0, 0], [1, 0.1, 0.1])


def made(body=BODY, orbit=ORBIT, state=START, t=0.0, **options):
    return GravityGradientTheory(body, orbit, state, t, **{"gm": WEAK, **options})


@pytest.mark.parametrize(("make", "sentence"), [
    (lambda: made(polhode.Body(1, 1, 1)), "a sphere has no gravity gradient"),
    (lambda: made(state=UPRIGHT), "next to spin about an axis"),
    (lambda: made(gm=-1.0), "gm = -1 must be positive"),
    (lambda: made(order=3), "the order 3 must be 1 or 2"),
    (lambda: made(least=0.0), "least = 0 must be positive"),
    (lambda: made(orbit=orbit_of(0.95)), "0.95 must be at most 0.9"),
    (lambda: made(t=np.inf), "the time inf must be finite"),
    (lambda: made(orbit=orbit_of(0.1, ONCE_A_TURN), gm=1e-6), "a resonance: phi_g"),
    (lambda: THEORY.mean(0.0, LONG), "in another mode than the motion"),
    (lambda: THEORY.mean(0.0, polhode.RotorState(START.q, 2 * START.g)), "is made for"),
    (lambda: THEORY.states(0.0, MEAN, [1.0, np.nan]), "the time nan must be finite"),
    (lambda: made(state=THEORY.states(0.0, MEAN, [1.0, 2.0])),
     r"state: got shape \(2,\); expected one"),
])
def test_refusals_say_why(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()
