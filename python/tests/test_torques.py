# SPDX-License-Identifier: MIT
"""Gravity of higher degree, tides, friction inside and torque tables: against NumPy and SciPy."""

import copy
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import (
    AnelasticDamping,
    Body,
    GravityGradient,
    InternalDamping,
    KeplerElements,
    KeplerOrbit,
    Problem,
    RotorState,
    System,
    TidalTorque,
    TorqueTable,
    integrate,
)
from polhode.charts import attitude_matrix
from polhode.rates import effect, wobble_time
from polhode.shape import MassMoments
from polhode.types import DampedMaterial
from rejections import rejected
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator

BODY = Body(1.0, 2.0, 2.5)
STATE = RotorState([0.5, -0.3, 0.4, 0.7], [0.3, -1.1, 0.8])
ORBIT = KeplerOrbit(KeplerElements(gm=1.0, pericentre=1.5, eccentricity=0.2, inclination=0.4))
T = 1.7
RNG = np.random.default_rng(5)
MASSES = RNG.uniform(0.1, 1.0, 8)
POINTS = RNG.normal(size=(8, 3))
MOMENTS = MassMoments.of_points(MASSES, POINTS)


def about(term, body=BODY):
    return effect(System(body, None, term), T, STATE)


def test_mass_moments_are_sums():
    x, y, z = POINTS.T
    assert_allclose(MOMENTS.third[4], MASSES @ (x * y * z), rtol=budgets.numpy_formula)
    assert_allclose(MOMENTS.fourth[7], MASSES @ (x * y * y * z), rtol=budgets.numpy_formula)
    R = attitude_matrix(STATE.q)
    turned = MassMoments.of_points(MASSES, POINTS @ R.T)
    assert_allclose(MOMENTS.rotated(R).fourth, turned.fourth, rtol=0, atol=budgets.numpy_random)
    assert pickle.loads(pickle.dumps(MOMENTS)) == MOMENTS
    rejected(ValueError, "third", MassMoments, np.zeros(9), np.zeros(15))


@pytest.mark.parametrize("of", ["attractor", "body"])
def test_higher_gravity_is_its_series(of):
    r = attitude_matrix(STATE.q) @ ORBIT.position(T) * (1 if of == "attractor" else -1)
    size = np.linalg.norm(r)
    want = np.zeros(3)
    for m, x in zip(MASSES, POINTS, strict=True):
        s = np.linalg.norm(x)
        c = x @ r / (s * size)
        slope3, slope4 = (15 * c**2 - 3) / 2, (140 * c**3 - 60 * c) / 8
        pull = s**2 * slope3 / size**5 + s**3 * slope4 / size**6
        want += 0.7 * m * pull * np.cross(x, r)
    # degree 2 of a sphere has no torque
    got = about(GravityGradient(ORBIT, 0.7, third_moments=MOMENTS.third,
                                fourth_moments=MOMENTS.fourth, orbit_of=of), Body(1, 1, 1))
    assert_allclose(got.u, want, rtol=0, atol=budgets.numpy_formula * np.abs(want).max())
    assert not np.any(got.v)


def test_oblate_gravity_is_the_hessian_of_its_field():
    k, J2, R = np.array([0.2, -0.3, 0.9]), 0.3, 0.8
    k = k / np.linalg.norm(k)
    A = attitude_matrix(STATE.q)
    r, pole = A @ ORBIT.position(T), A @ k
    d, z = np.linalg.norm(r), r @ pole
    H = (
        3 * np.outer(pole, pole) / d**5
        - 15 * z * (np.outer(pole, r) + np.outer(r, pole)) / d**7
        + (105 / 2 * z**2 / d**9 - 15 / 2 / d**7) * np.outer(r, r)
    )
    S = 0.7 * J2 * R**2 * (np.diag(BODY.moments) @ H)
    # u_i = e_ijk S_jk of a quadratic energy -I:H/2
    want = -np.array([S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]])
    n, I = r / d, BODY.moments
    want = want + 3 * 0.7 / d**3 * np.cross(n, I * n)  # and that of the point mass
    got = about(GravityGradient(ORBIT, 0.7, J2=J2, primary_radius=R, pole=k)).u
    assert_allclose(got, want, rtol=0, atol=budgets.numpy_formula * np.abs(want).max())


def test_tidal_torque_is_mignards():
    A = attitude_matrix(STATE.q)
    r, v = A @ ORBIT.position(T), A @ ORBIT.velocity(T)
    w = STATE.g / BODY.moments
    d = np.linalg.norm(r)
    want = 3 * 0.3 * 0.7 * 0.4 * 0.5**5 * 0.01 / d**8
    want = want * ((r @ w) * r - d**2 * w + np.cross(r, v))
    got = about(TidalTorque(ORBIT, 0.4, 0.3, 0.01, 0.5, gm=0.7)).u
    assert_allclose(got, want, rtol=0, atol=budgets.numpy_formula * np.abs(want).max())
    with pytest.raises(TypeError, match="expected an orbit with a velocity"):
        TidalTorque(lambda t: [1, 0, 0], 0.4, 0.3, 0.01, 0.5, gm=0.7)


def test_internal_damping():
    across = np.cross(STATE.g, STATE.g / BODY.moments)
    got = about(InternalDamping([0.3, 0.7, 1.1]))
    assert_allclose(got.v, np.array([0.3, 0.7, 1.1]) * across, rtol=budgets.numpy_formula)
    assert not np.any(got.u)
    rock = DampedMaterial(3e4, 100.0, 1.0, 10.0)
    assert_allclose(wobble_time(rock, 2.0), 3e6 / (0.1 * 100 * 8), rtol=budgets.numpy_formula)
    G = np.linalg.norm(STATE.g)
    rate = G / 2.5
    by_time = InternalDamping(wobble_time=wobble_time(rock, rate), rate=rate, body=BODY)
    by_rock = about(AnelasticDamping(10.0, 3e4, 100.0, 1.0, body=BODY))
    assert_allclose(about(by_time).v, by_rock.v, rtol=budgets.numpy_formula)
    rejected(ValueError, ">= 0", InternalDamping, [-1.0, 0.0, 0.0])
    rejected(ValueError, "got none of them; expected exactly one of wobble_time with rate, k",
             InternalDamping)
    rejected(ValueError, "got rate, k; expected exactly one of", InternalDamping, [1, 1, 1], rate=1)
    rejected(ValueError, "body: got nothing; expected the body", InternalDamping,
             wobble_time=1.0, rate=1.0)


def test_internal_damping_is_the_limit_of_a_sphere_in_a_viscous_cavity():
    # two bodies: total momentum g, momentum h of the sphere along body axes; both in the moments
    J, c = 0.02, 1.0
    moments = np.array([1.0, 1.5, 2.0])

    def rates(t, y):
        g, h = y[:3], y[3:]
        w = (g - h) / (moments - J)
        return np.concatenate([np.cross(g, w), np.cross(h, w) - c * (h / J - w)])

    g0 = np.array([0.8, 0.3, 1.0])
    start = np.concatenate([g0, J * g0 / moments])
    end = 60.0
    tolerance = budgets.oracle_tolerance
    oracle = solve_ivp(rates, (0, end), start, "DOP853", rtol=tolerance, atol=tolerance)
    G = np.linalg.norm(oracle.y[:3, -1])
    assert_allclose(G, np.linalg.norm(g0), rtol=budgets.numpy_differences)
    term = InternalDamping(J**2 / c / moments**2)
    problem = Problem(System(Body(*moments), None, term), RotorState([1, 0, 0, 0], g0), 0.0, end)
    run = integrate(problem)

    def left(g):  # of the energy that friction can take
        return 0.5 * (g**2 / moments).sum() - 0.5 * (g @ g) / moments[2]

    lost = left(g0) - left(oracle.y[:3, -1])
    assert lost > 0.0
    assert_allclose(left(g0) - left(run.g[-1]), lost, rtol=budgets.kane_limit)


def test_torque_table_cubic_is_scipys_pchip():
    times = np.cumsum(RNG.uniform(0.2, 2.0, 12))
    torques = RNG.normal(size=(12, 3))
    table = TorqueTable(times, *torques.T, between="cubic", outside="error")
    system = System(BODY, None, table)
    pchip = PchipInterpolator(times, torques)
    for t in RNG.uniform(times[0], times[-1], 50):
        assert_allclose(
            effect(system, t, STATE).u, pchip(t), rtol=0, atol=budgets.numpy_formula * 10
        )
    rejected(ValueError, "before the first row", effect, system, 0.0, STATE)
    assert_allclose(table.breakpoints, times, rtol=0, atol=0)
    rejected(ValueError, "later", TorqueTable, [0, 0], [0, 0])
    rejected(ValueError, "expected 2 numbers, as many as times has", TorqueTable, [0, 1], [0, 1, 2])


def test_a_second_of_torque_in_a_day():
    table = TorqueTable([43210.25, 43211.25], torque_3=[1e-3, 0], between="step")
    start = RotorState([1, 0, 0, 0], [0, 0, 4e-3])
    run = integrate(Problem(System(Body(1, 1, 2), None, table), start, 0.0, 86400.0))
    assert_allclose(run.g[-1, 2], 5e-3, rtol=budgets.pulse_momentum)


@pytest.mark.parametrize(("J2", "radius", "pole", "words"), [
    (1e-3, -1, [0, 0, 1], "radius -1 must be positive and finite"),
    (np.nan, 1, [0, 0, 1], "J2 nan must be finite"),
    (1e-3, 1, [0, 0, 0], r"pole \(0, 0, 0\) must be a direction"),
    (1e-3, None, [0, 0, 1], "expected a key primary_radius as well"),
    (None, None, [0, 1, 0], "GravityGradient: pole: got .*; expected a key J2 as well"),
    (None, None, [0, 0, 1], "GravityGradient: pole: got .*; expected a key J2 as well"),
])
def test_what_is_no_oblateness_says_why(J2, radius, pole, words):
    rejected(ValueError, words, GravityGradient, ORBIT, J2=J2, primary_radius=radius, pole=pole)


def test_terms_compare_copy_and_pickle():
    terms = [GravityGradient(ORBIT, 0.7, third_moments=MOMENTS.third, orbit_of="body", J2=1e-3,
                             primary_radius=0.5, name="planet"),
             TidalTorque(ORBIT, 0.4, 0.3, 0.01, 0.5, gm=0.7),
             InternalDamping([0.3, 0.3, 0.3]),
             InternalDamping(wobble_time=2.0, rate=1.0, body=BODY),
             AnelasticDamping(10.0, 3e4, 100.0, 1.0, body=BODY),
             TorqueTable([0, 1], torque_2=[0, 1], torque_3=[1, 0], axes="inertial")]
    for term in terms:
        again = pickle.loads(pickle.dumps(term))
        assert again == term
        assert copy.copy(term) is term
        assert type(term).__name__ in repr(term)
        assert np.array_equal(about(again).u, about(term).u)


HEAD = """\
schema = 1
[units]
time = "min"
moment = "kg m2"
length = "m"
[body]
moments = [1.0, 2.0, 2.5]
[state.attitude-rate]
quaternion = [0.5, -0.3, 0.4, 0.7]
omega_body = [0.3, -0.55, 0.32]
"""


def test_scenario_has_every_degree_once():
    text = HEAD + """
[orbit.planet]
gm = 1.0
semi_major_axis = 10
[[perturbation]]
kind = "gravity-gradient"
orbit = "planet"
"""
    extra = f"""
orbit_of = "body"
third_moments = {MOMENTS.third.tolist()}
fourth_moments = {MOMENTS.fourth.tolist()}
J2 = 0.1
primary_radius = 3
pole = [0, 1, 2]
[[perturbation]]
kind = "tide"
orbit = "planet"
mass = 2.0
k2 = 0.3
time_lag = 0.1
radius = 0.5
[[perturbation]]
kind = "internal-damping"
wobble_time = 5
rate = 2
"""
    scenario = polhode.Scenario.from_text(text + extra)
    state = scenario.initial_state
    orbit = scenario.orbits["planet"]
    body = scenario.body
    parts = System(
        body,
        None,
        [GravityGradient(orbit, 1.0, third_moments=MOMENTS.third, fourth_moments=MOMENTS.fourth,
                         orbit_of="body", J2=0.1, primary_radius=3.0, pole=[0, 1, 2]),
         TidalTorque(orbit, 2.0, 0.3, 0.1, 0.5),
         InternalDamping(wobble_time=5.0, rate=2.0, body=body)],
    )
    got, want = effect(scenario.system, 0.3, state), effect(parts, 0.3, state)
    assert_allclose(got.u, want.u, rtol=budgets.numpy_formula)
    assert_allclose(got.v, want.v, rtol=budgets.numpy_formula)
    for gone, message in [
        ('orbit_of = "body"\n', "expected a key orbit_of as well"),
        ("primary_radius = 3\n", "expected a key primary_radius as well"),
        ("J2 = 0.1\n", "expected a key J2 as well"),
    ]:
        with pytest.raises(polhode.DomainError, match=message):
            polhode.Scenario.from_text(text + extra.replace(gone, ""))


TABLE = HEAD + """
[[perturbation]]
kind = "torque-table"
between = "step"
"""


def test_torque_table_of_a_scenario(tmp_path):
    inline = TABLE + "times = [1, 2]\ntorque_3 = [0.25, 0]\n"
    rows = "# thruster\nsecond, x, y, z, w\n60, 0, 0, 0.0009, 1\n120, 0, 0, 0, 2\n"
    (tmp_path / "thruster.csv").write_text(rows)
    other = 'file = "thruster.csv"\ntime_unit = "s"\ntorque_unit = "N m"\n'
    path = tmp_path / "table.toml"
    path.write_text(TABLE + other)
    for scenario in (polhode.Scenario.from_text(inline), polhode.load(path)):
        (term,) = scenario.system.terms
        assert_allclose(term.breakpoints, [1, 2], rtol=budgets.numpy_rounding)
        u = effect(scenario.system, 1.5, scenario.initial_state).u
        assert u[2] > 0
        assert not np.any(effect(scenario.system, 0.5, scenario.initial_state).u)
    # 0.0009 N m is 3.24 kg m2/min2
    assert_allclose(u, [0, 0, 3.24], rtol=budgets.numpy_formula)
    for text, message in [
        (inline.replace("[0.25, 0]", "[0.25]"), "expected 2 numbers, as many as times has"),
        (inline.replace("[1, 2]", "[2, 1]"), "must be later than 2"),
        (inline + 'time_unit = "s"\n', "expected a key file as well"),
        (TABLE, "expected exactly one of times, file"),
    ]:
        rejected(polhode.DomainError, message, polhode.Scenario.from_text, text)
    (tmp_path / "thruster.csv").write_text(rows.replace("120,", "60,"))
    rejected(polhode.DomainError, "time 60 stands twice", polhode.load, path)
