# SPDX-License-Identifier: MIT
"""Generating functions of Serret's and Sadov's transformations; Kinoshita's variables and Fukushima
and Ishizaki's elements."""

import copy
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, smallest
from polhode import Body, FreeRotation, RotorState, SadovState
from polhode.charts import EulerAngles
from polhode.free import SadovParameters

BODY = Body(3.0, 4.0, 6.0)
STATE = RotorState([0.6, -0.3, 0.7, 0.2], [0.3, 0.2, 1.0])
LONG = RotorState([0.6, -0.3, 0.7, 0.2], [1.0, 0.2, 0.3])
MOTION = FreeRotation(BODY, STATE, 0.5)
TIMES = np.linspace(-9.0, 40.0, 24).reshape(4, 6)


def angles(states):
    e = polhode.to_euler(states)
    return EulerAngles(e.phi, e.theta, e.psi)


def slope(f, h):
    """Central difference of the eighth order."""
    weights = [4 / 5, -1 / 5, 4 / 105, -1 / 280]
    return sum(w * (f(i * h) - f(-i * h)) for i, w in enumerate(weights, 1)) / h


def test_S_along_a_motion_is_continuous():
    """[SA (51)-(62)]: the momenta and constants of the motion, dS/dt = 2T - T along it."""
    c = polhode.to_serret(MOTION, 0.0)
    f = polhode.free.generating_function(BODY, angles(MOTION.at(TIMES)), c, TIMES)
    assert f.shape == TIMES.shape
    S = (TIMES - 2 * c.t0) * c.T + c.H * c.h + c.G * c.g0
    assert_allclose(f.S, S, atol=budgets.generating_motion)
    states = MOTION.at(TIMES)
    w, s3 = polhode.angular_velocity(BODY, states), polhode.charts.attitude_matrix(states.q)[..., 2]
    away = np.abs(np.sum(s3 * np.cross(states.g, w), axis=-1)) > 0.015  # from caustics
    assert away.sum() > 12
    euler, near = polhode.to_euler(states)[away], f[away]
    assert_allclose(near.Theta, euler.Theta, atol=budgets.generating_motion)
    assert_allclose(near.Psi, euler.Psi, atol=budgets.generating_motion)
    assert_allclose(near.minus_t0, np.full(near.shape, -c.t0), atol=budgets.generating_motion)


def test_gradients_of_S_and_the_jacobi_equation():
    c = polhode.to_serret(MOTION, 0.9)
    e = polhode.to_euler(MOTION.at(0.9))
    x = np.array([e.phi + 0.02, e.theta - 0.01, e.psi + 0.03, c.G, c.H, c.T, 0.9])

    def at(z):
        near = polhode.SerretState(c.g0, c.h, c.t0, z[3], z[4], z[5], c.sign_g1, c.sign_g3)
        return polhode.free.generating_function(BODY, EulerAngles(*z[:3]), near, z[6])

    f = at(x)
    exact = [f.Phi, f.Theta, f.Psi, f.g0, f.h, f.minus_t0, f.minus_T]
    for i, expected in enumerate(exact):
        direction = np.eye(7)[i]
        found = slope(lambda d, along=direction: at(x + d * along).S, 5e-5 if i == 5 else 4e-4)
        assert_allclose(found, expected, atol=budgets.generating_gradient)
    there = polhode.to_rotor(polhode.EulerState(*x[:3], f.Phi, f.Theta, f.Psi))
    assert_allclose(polhode.kinetic_energy(BODY, there), c.T, rtol=budgets.generating_jacobi)


def test_branches_are_motions_through_the_attitude():
    q = angles(MOTION.at(0.9))
    c = polhode.to_serret(MOTION, 0.9)
    all_branches = polhode.free.serret_branches(BODY, q, c.G, c.H, c.T, 0.9)
    assert len(all_branches) in (2, 4)
    expected = polhode.charts.attitude_matrix(MOTION.at(0.9).q)
    for branch in all_branches:
        there = polhode.charts.attitude_matrix(polhode.to_rotor(BODY, branch, 0.9).q)
        assert_allclose(there, expected, atol=budgets.generating_branches)
    assert smallest(abs(branch.t0 - c.t0) for branch in all_branches) < budgets.generating_motion


@pytest.mark.parametrize("state", [STATE, LONG], ids=["short axis", "long axis"])
def test_W_gives_the_transformation(state):
    """[SA "transf. eqs"] its derivatives, and the paper's quadratures for L > 0."""
    motion = FreeRotation(BODY, state)
    a, s = polhode.to_andoyer(motion.at(1.3)), polhode.to_sadov(motion, 1.3)
    assert a.L > 0.1
    f = polhode.free.sadov_generating_function(BODY, a.l, a.g, a.h, s)
    exact = [f.L, f.G, f.H, f.phi_l, f.phi_g, f.phi_h]
    known = [a.L, a.G, a.H, s.phi_l, s.phi_g, s.phi_h]
    assert_allclose(exact, known, atol=budgets.generating_motion)
    x = np.array([a.l, a.g, a.h, s.I_l, s.I_g, s.I_h])

    def at(z):
        near = SadovState(s.phi_l, s.phi_g, s.phi_h, *z[3:], s.region, s.lobe)
        return polhode.free.sadov_generating_function(BODY, *z[:3], near)

    for i, expected in enumerate(exact):
        direction = np.eye(6)[i]
        found = slope(lambda d, along=direction: at(x + d * along).W, 2e-4)
        assert_allclose(found, expected, atol=budgets.generating_gradient)
    p = polhode.free.sadov_parameters(BODY, motion.momentum, motion.energy)
    assert (p.lambda_ > 1) == motion.circulates_long_axis
    q = polhode.free.sadov_quadratures(p, s.I_g, a.l)
    assert_allclose([q.I_l, q.L_dl], [s.I_l, f.V], atol=budgets.generating_quadrature)
    assert_allclose(np.cos(q.phi_l - f.phi_l), 1.0, atol=budgets.generating_quadrature)
    many = polhode.free.sadov_generating_function(BODY, [a.l] * 3, a.g, a.h, s)
    assert many.shape == (3,) and many[1] == f


@pytest.mark.parametrize("state", [STATE, LONG], ids=["short axis", "long axis"])
def test_sets_of_kinoshita_and_of_fukushima_and_ishizaki(state):
    motion = FreeRotation(BODY, state)
    hub = motion.at(TIMES)
    kinoshita = polhode.to_kinoshita(motion, TIMES)
    sadov = polhode.to_sadov(motion, TIMES)
    assert_allclose(np.sin(kinoshita.l), np.cos(sadov.phi_l), atol=budgets.named_sets_round_trip)
    assert_allclose(kinoshita.L, sadov.I_l, rtol=0)
    again = polhode.to_rotor(BODY, kinoshita)
    assert_allclose(again.g, hub.g, atol=budgets.named_sets_round_trip)
    assert polhode.to_kinoshita(BODY, hub, TIMES).shape == TIMES.shape
    elements = polhode.to_fukushima_ishizaki(motion, 2.0)
    a = polhode.to_andoyer(motion.at(2.0))
    assert [elements.l0, elements.g0, elements.h, elements.L0, elements.G, elements.H] == [
        a.l, a.g, a.h, a.L, a.G, a.H]  # fmt: skip
    assert_allclose(
        polhode.to_rotor(BODY, elements, TIMES).g, hub.g, atol=budgets.named_sets_round_trip
    )
    assert polhode.free.free_rotation(BODY, elements).epoch == 2.0
    for B, s in [
        (polhode.charts.chart_jacobian(BODY, kinoshita[0, 0]), hub[0, 0]),
        (polhode.charts.chart_jacobian(BODY, elements, TIMES[0, 0]), hub[0, 0]),
    ]:
        inverse = polhode.charts.inverse_chart_jacobian(s.g, B)
        assert_allclose(inverse @ B, np.eye(6), atol=budgets.named_sets_canonical)


def test_values_are_kept():
    f = polhode.free.generating_function(
        BODY, angles(MOTION.at(0.4)), polhode.to_serret(MOTION, 0.0), 0.4
    )
    w = polhode.free.sadov_generating_function(
        BODY, 2.0, 0.1, 0.2, SadovState(0, 0, 0, 0.9, 1.0, 0.4)
    )
    p = SadovParameters(1.0, 0.5)
    values = [
        *(f, w, p, polhode.free.sadov_quadratures(p, 1.0, [1.0, 2.0])),
        polhode.to_kinoshita(MOTION, TIMES),
        polhode.to_fukushima_ishizaki(MOTION, 0.3),
    ]
    for value in values:
        assert pickle.loads(pickle.dumps(value)) == copy.deepcopy(value) == value


def test_what_has_no_motion_is_rejected():
    c = polhode.SerretState(0.1, 0.2, 0.3, 1.0, 0.4, 0.11)

    def changed(**values):
        names = "g0 h t0 G H T sign_g1 sign_g3".split()
        return polhode.SerretState(**({name: getattr(c, name) for name in names} | values))

    q = EulerAngles(0.3, 1.0, 0.2)
    for angles_, elements, message in [
        (q, changed(T=0.2), r"0\.2.* needs T in \[G\^2/2I3"),
        (q, changed(H=1.5), r"1\.5.* needs G > 0 and \|H\| <= G"),
        (q, changed(H=1.0), r"H = 1(\.0)? of G = 1(\.0)? must have \|H\| < G"),
        (EulerAngles(0.3, 0.0, 0.2), c, r"theta = 0(\.0)? must be in \(0, pi\)"),
        (EulerAngles(0.3, 0.05, 0.2), changed(H=0.999), r"T = 0\.11 must be in \[0\.08"),
    ]:
        with pytest.raises(ValueError, match=message):
            polhode.free.generating_function(BODY, angles_, elements, 0.0)
    with pytest.raises(ValueError, match="expected one EulerAngles"):
        polhode.free.serret_branches(BODY, EulerAngles([0.3, 0.4], 1.0, 0.2), 1.0, 0.4, 0.11)
    with pytest.raises(ValueError, match=r"l = 0\.1 must be within"):
        polhode.free.sadov_generating_function(
            BODY, 0.1, 0, 0, SadovState(0, 0, 0, 0.1, 1.0, 0.4, "long_axis")
        )
    with pytest.raises(ValueError, match="lambda not 1"):
        polhode.free.sadov_quadratures(SadovParameters(1.0, 1.0), 1.0, 1.0)
