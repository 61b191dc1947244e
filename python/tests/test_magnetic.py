# SPDX-License-Identifier: MIT
"""Magnetic fields and torques against formulas written in NumPy, and from scenarios."""

import copy
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import (
    Adaptive,
    Body,
    DipoleField,
    EddyCurrents,
    KeplerElements,
    KeplerOrbit,
    Problem,
    ResidualDipole,
    RotorState,
    SaveAt,
    Splitting,
    System,
    integrate,
)
from polhode.charts import attitude_matrix
from polhode.rates import effect
from rejections import rejected

ROUNDED = budgets.numpy_formula
BODY = Body(1.0, 2.0, 2.5)
ORBIT = KeplerOrbit(KeplerElements(gm=1.0, pericentre=1.5, eccentricity=0.2, inclination=0.4))
STATE = RotorState([0.5, -0.3, 0.4, 0.7], [0.3, -1.1, 0.8])
T = 1.7
POLE_Z = {"rate": 0.9, "meridian": 0.4, "epoch": -0.3}
M = np.array([[0.5, 0.1, -0.2], [0.1, 0.3, 0.05], [-0.2, 0.05, 0.4]])


def dipole(t, x):
    """Of Gauss coefficients -3, 0.5, -0.25 at radius 2, about axis 3."""
    angle = 0.4 + 0.9 * (t + 0.3)
    c, s = np.cos(angle), np.sin(angle)
    K = 8.0 * np.array([0.5 * c + 0.25 * s, 0.5 * s - 0.25 * c, -3.0])
    r = np.linalg.norm(x)
    return 3 * (K @ x) * x / r**5 - K / r**3


FIELD = DipoleField.from_gauss(-3.0, 0.5, -0.25, 2.0, **POLE_Z)


def in_body(vector):
    return attitude_matrix(STATE.q) @ vector


def torque(term):
    return effect(System(BODY, None, term), T, STATE).u


def test_the_field_of_a_dipole_that_turns():
    for t, x in ((0.0, [1.0, 0.0, 0.0]), (2.3, [0.4, -1.2, 0.7])):
        assert_allclose(FIELD.field(t, x), dipole(t, np.array(x)), rtol=ROUNDED)
    assert_allclose(FIELD.strength, [4.0, -2.0, -24.0], rtol=0)


def test_a_field_is_a_value():
    assert FIELD == DipoleField([4.0, -2.0, -24.0], **POLE_Z)
    assert FIELD != DipoleField([4.0, -2.0, -24.0])
    assert pickle.loads(pickle.dumps(FIELD)) == FIELD == copy.copy(FIELD)
    assert hash(FIELD) == hash(copy.copy(FIELD))


def test_a_residual_dipole_in_every_kind_of_field():
    m, x = np.array([0.3, -0.2, 0.9]), ORBIT.position(T)
    want = np.cross(m, in_body(dipole(T, x)))
    assert_allclose(torque(ResidualDipole(m, ORBIT, field=FIELD)), want, rtol=ROUNDED)
    assert_allclose(torque(ResidualDipole(m, ORBIT, field=dipole)), want, rtol=ROUNDED)
    assert_allclose(torque(ResidualDipole(m, field=dipole(T, x))), want, rtol=ROUNDED)
    assert_allclose(torque(ResidualDipole(m, field=lambda t: dipole(t, ORBIT.position(t)))), want,
                    rtol=ROUNDED)  # fmt: skip
    assert ResidualDipole(m, ORBIT, field=FIELD).is_kick


def test_eddy_currents():
    B = dipole(T, ORBIT.position(T))
    h = 2.0**-10
    weights = (-1 / 60, 3 / 20, -3 / 4, 0, 3 / 4, -3 / 20, 1 / 60)
    rate = sum(w * dipole(T + k * h, ORBIT.position(T + k * h)) for k, w in
               zip(range(-3, 4), weights)) / h  # fmt: skip
    w = STATE.g / np.array([1.0, 2.0, 2.5])
    B, rate = in_body(B), in_body(rate)
    whole = np.cross(M @ (np.cross(w, B) - rate), B)
    part = np.cross(M @ np.cross(w, B), B)
    eddy = torque(EddyCurrents(M, ORBIT, field=FIELD))
    assert_allclose(eddy, whole, rtol=budgets.numpy_differences)
    for field in (FIELD, dipole):
        term = EddyCurrents(M, ORBIT, field=field, field_rate=False)
        assert_allclose(torque(term), part, rtol=ROUNDED)
        assert not term.field_rate
        assert_allclose(term.tensor, M, rtol=0)
    assert pickle.loads(pickle.dumps(EddyCurrents(M, ORBIT, field=FIELD))) == (
        EddyCurrents(M, ORBIT, field=FIELD))


def test_a_sphere_loses_its_spin_across_the_field():
    eddy = EddyCurrents(0.02, field=[0.0, 0.0, 0.5])
    system = System(Body(1, 1, 1), None, eddy)
    want = np.array([np.exp(-0.02 * 0.25 * 10), 0.0, 2.0])
    for method in (Adaptive(1e-15), Splitting(0.5)):
        problem = Problem(system, RotorState([1, 0, 0, 0], [1.0, 0.0, 2.0]), 0.0, 10.0, method)
        end = integrate(problem, SaveAt.times([10.0]))
        g = attitude_matrix(end.q[-1]).T @ end.g[-1]
        assert_allclose(g, want, rtol=budgets.numpy_formula, atol=budgets.numpy_formula)


@pytest.mark.parametrize(("call", "message"), [
    (lambda: ResidualDipole([1, 0, 0], field=FIELD), "orbit: got nothing; expected the name"),
    (lambda: EddyCurrents(1.0, ORBIT, field=dipole), "no derivative"),
    (lambda: EddyCurrents([1.0, 2.0], ORBIT, field=FIELD),
     "expected \\(\\), \\(3,\\) or \\(3, 3\\)"),
    (lambda: EddyCurrents(-1.0, ORBIT, field=FIELD), "eigenvalue"),
    (lambda: DipoleField([1, 0, 0], pole=[0, 0, 0]), "not zero"),
    (lambda: DipoleField.from_gauss(1, 0, 0, 0), "reference radius"),
])  # fmt: skip
def test_refusals(call, message):
    rejected(ValueError, message, call)


TEXT = """
schema = 1
[units]
time = "s"
moment = "kg m2"
length = "km"
[body]
tensor = [[2.0, 0.1, 0.0], [0.1, 3.0, 0.2], [0.0, 0.2, 4.0]]
[state.attitude-rate]
quaternion = [0.5, -0.5, 0.5, 0.5]
omega_body = [0.01, 0.02, 0.03]
[orbit.earth]
gm = 398600.4418
semi_major_axis = 7144.0
inclination = "98 deg"
node_rate = "1 deg/d"
[[perturbation]]
kind = "eddy-currents"
orbit = "earth"
tensor = { value = [1e5, 2e5, 3e5], unit = "S m4" }
gauss = { value = [-29442.0, -1501.0, 4797.1], unit = "nT" }
reference_radius = 6371.2
rotation_rate = "360.98564736629 deg/d"
meridian = 0
[[perturbation]]
kind = "residual-dipole"
orbit = "earth"
moment = { value = [1.0, -2.0, 3.0], unit = "A m2" }
gauss = { value = [-29442.0, -1501.0, 4797.1], unit = "nT" }
reference_radius = 6371.2
rotation_rate = 0
meridian = 0
[time]
stop = 10
count = 2
"""


def test_from_a_scenario_in_its_units():
    scenario = polhode.Scenario.from_text(TEXT)
    eddy, magnet = scenario.system.terms
    assert isinstance(eddy, EddyCurrents)
    assert isinstance(magnet, ResidualDipole)
    R = polhode.charts.attitude_matrix(scenario.body.q_FB).T
    # core units: kg m2, km, s, A
    assert_allclose(eddy.tensor, R.T @ np.diag([1e5, 2e5, 3e5]) @ R * 1e-12, rtol=ROUNDED)
    assert_allclose(magnet.moment, R.T @ [1e-6, -2e-6, 3e-6], rtol=ROUNDED)
    tesla = 1e6  # kg/(s2 A) in kg m2/(km2 s2 A)
    K = np.array([-1501.0, 4797.1, -29442.0]) * 1e-9 * tesla * 6371.2**3
    g10, g11, h11 = eddy.gauss * eddy.reference_radius**3
    assert_allclose([g11, h11, g10], K, rtol=ROUNDED)
    assert_allclose(eddy.rotation_rate, np.radians(360.98564736629) / 86400, rtol=ROUNDED)


@pytest.mark.parametrize("old, new, words", [
    ("reference_radius = 6371.2", "reference_radius = 0", "positive length"),
    ("[1e5, 2e5, 3e5]", "[1e5, -2e5, 3e5]", "must not drive"),
    ('unit = "S m4"', 'unit = "nT"', "magnetic tensor"),
    ("rotation_rate", "pole = [0.0, 0.0, 0.0]\nrotation_rate", "not zero"),
])
def test_refusals_of_a_scenario(old, new, words):
    rejected(polhode.ScenarioError, words, polhode.Scenario.from_text, TEXT.replace(old, new, 1))
