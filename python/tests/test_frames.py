# SPDX-License-Identifier: MIT
"""Frames: attitudes and their rates against quaternions and differences by NumPy."""

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
from polhode import Frame, KeplerElements, KeplerOrbit
from polhode.charts import attitude, attitude_matrix
from polhode.types import FrameMotion
from rejections import rejected
from scipy.spatial.transform import Rotation

EPS = np.finfo(float).eps
SLOPES = budgets.numpy_differences
ORBIT = KeplerOrbit(KeplerElements(gm=1.0, pericentre=3.0, eccentricity=0.1, inclination=0.3))


def node(t):
    return 0.3 - 0.2 * t + 0.05 * np.sin(t)


def inclination(t):
    return 0.9 + 0.1 * np.cos(2.0 * t)


def orbit_axes(t):
    """Radial, along the track, normal."""
    r, v = ORBIT.position(t), ORBIT.velocity(t)
    h = np.cross(r, v)
    x, z = r / np.sqrt(r @ r), h / np.sqrt(h @ h)
    return attitude(np.array([x, np.cross(z, x), z]))


def tilted(t):
    return [np.cos(0.1 * t), 0.2 * t, 0.3, t**2 / 9]


MOVING = {
    "precessing": Frame.precessing([1.0, 2.0, -1.0], 0.3, epoch=0.5),
    "orbit_plane": Frame.orbit_plane(node, inclination),
    "orbit_plane_pq": Frame.orbit_plane_pq(lambda t: 0.3 * np.sin(0.2 * t),
                                           lambda t: 0.3 * np.cos(0.2 * t)),
    "local_vertical": Frame.local_vertical(
        polhode.KeplerOrbit(polhode.KeplerElements(0.3, 0.9, 0.3, 0.9, 2.0, 1.0, 0.4, 0.5))),
    "from_attitude": Frame.from_attitude(tilted),
    "of an orbit": Frame.from_attitude(orbit_axes),
}
EVERY_FRAME = pytest.mark.parametrize("frame", MOVING.values(), ids=MOVING)


@EVERY_FRAME
def test_the_rate_is_the_slope_of_the_attitude(frame):
    t = 1.3
    rate = slope(lambda x: frame.at(x).q_IS, t)
    q = frame.at(t).q_IS
    conjugate = q * [1, -1, -1, -1]
    w, v = conjugate[0], conjugate[1:]
    mu = 2 * (w * rate[1:] + rate[0] * v + np.cross(v, rate[1:]))
    assert_allclose(frame.at(t).mu_S, mu, atol=SLOPES)
    assert np.linalg.norm(mu) > 0.05
    assert_allclose(np.linalg.norm(q), 1.0, atol=budgets.numpy_rounding)


def test_precession_is_a_turn_about_its_axis():
    axis = np.array([1.0, 2.0, -1.0])
    motion = MOVING["precessing"].at(3.5)
    vector_first = Rotation.from_rotvec(0.3 * 3.0 * axis / np.linalg.norm(axis)).as_quat()
    turn = np.roll(vector_first, 1)
    assert_allclose(motion.q_IS, turn, atol=budgets.frame_attitude_eps * EPS)
    assert_allclose(motion.mu_S, 0.3 * axis / np.linalg.norm(axis), rtol=budgets.numpy_rounding)
    assert_allclose(MOVING["precessing"].at(0.5).q_IS, [1, 0, 0, 0], atol=budgets.numpy_rounding)


def test_the_axes_of_an_orbit_plane():
    t = 2.0
    S = attitude_matrix(Frame.orbit_plane(node, inclination).at(t).q_IS)
    Omega, i = node(t), inclination(t)
    normal = [np.sin(i) * np.sin(Omega), -np.sin(i) * np.cos(Omega), np.cos(i)]
    assert_allclose(S[2], normal, atol=budgets.numpy_rounding)
    assert_allclose(S[0], [np.cos(Omega), np.sin(Omega), 0.0], atol=budgets.numpy_rounding)


def test_the_plane_without_a_node_has_the_same_normal():
    Omega, i = 0.7, 0.4
    p, q = np.sin(i) * np.sin(Omega), np.sin(i) * np.cos(Omega)
    normal = [attitude_matrix(f.at(0.0).q_IS)[2]
              for f in (Frame.orbit_plane(Omega, i), Frame.orbit_plane_pq(p, q))]
    assert_allclose(normal[0], normal[1], atol=budgets.numpy_rounding)
    assert (Frame.orbit_plane_pq(0.0, 0.0).at(1.0).q_IS == [1, 0, 0, 0]).all()
    assert np.isnan(Frame.orbit_plane_pq(0.9, 0.9).at(0.0).q_IS).any()


def test_the_axes_of_a_body_in_orbit():
    motion = MOVING["of an orbit"].at(1.0)
    r, v = ORBIT.position(1.0), ORBIT.velocity(1.0)
    h = np.linalg.norm(np.cross(r, v))
    first = attitude_matrix(motion.q_IS)[0]
    assert_allclose(first, r / np.linalg.norm(r), atol=budgets.numpy_rounding)
    assert_allclose(motion.mu_S, [0, 0, h / (r @ r)], atol=budgets.numpy_rounding)


def test_constants_are_functions_too():
    a, b = Frame.orbit_plane(0.3, 0.9), Frame.orbit_plane(lambda t: 0.3, lambda t: 0.9 + 0 * t)
    assert a.at(5.0) == b.at(5.0)
    assert (a.at(5.0).mu_S == 0).all()
    assert Frame.orbit_plane(np.float64(0.3), np.array(0.9)).at(0.0) == a.at(0.0)


def test_inertial_axes():
    frame = Frame.inertial()
    assert frame.is_inertial and frame.kind == "inertial" and frame.arguments == {}
    motion = frame.at([0.0, 1.0])
    assert motion.shape == (2,) and (motion.q_IS == [1, 0, 0, 0]).all() and not motion.mu_S.any()


@EVERY_FRAME
def test_times_of_any_shape(frame):
    t = np.linspace(0.0, 1.0, 60).reshape(3, 20)
    motion = frame.at(t)
    assert isinstance(motion, FrameMotion)
    assert motion.shape == (3, 20) and motion.q_IS.shape == (3, 20, 4)
    assert motion.mu_S.shape == (3, 20, 3)
    assert motion[2, 5] == frame.at(t[2, 5])
    assert np.isnan(frame.at(math.nan).q_IS).any()
    assert not frame.is_inertial
    with pytest.raises(ValueError, match="read-only"):
        motion.q_IS[0] = 0


def fails(t):
    raise LookupError("no table for this time")


@pytest.mark.parametrize("make", [
    lambda f: Frame.orbit_plane(f, 0.1),
    lambda f: Frame.orbit_plane_pq(0.1, f),
    Frame.from_attitude,
])
def test_what_a_function_raises_passes_through(make):
    with pytest.raises(LookupError, match="no table"):
        make(fails).at(np.zeros(100))
    with pytest.raises(TypeError, match=r"np\.sin, not math\.sin"):
        make(lambda t: math.sin(t)).at(0.0)


@pytest.mark.parametrize("returned", [None, "0.3", [0.1, 0.2], 1j])
def test_what_is_no_angle(returned):
    with pytest.raises((TypeError, ValueError), match="Frame.orbit_plane: Omega: .* returned"):
        Frame.orbit_plane(lambda t: returned, 0.1).at(0.0)


@pytest.mark.parametrize("returned", [None, 1.0, [1.0, 0.0, 0.0], [1, 0, 0, "0"], "abcd"])
def test_what_is_no_attitude(returned):
    with pytest.raises((TypeError, ValueError), match="Frame.from_attitude: q_IS: .* returned"):
        Frame.from_attitude(lambda t: returned).at(0.0)


LINE = polhode.TableOrbit([0.0, 1.0, 2.0], [[1, 0, 0], [0, 1, 0], [-1, 0, 0]], order=2)


@pytest.mark.parametrize(("call", "error", "message"), [
    (lambda: Frame.orbit_plane(0.1, "a"), TypeError,
     "Frame.orbit_plane: i: got 'a'; expected a function"),
    (lambda: Frame.from_attitude([1, 0, 0, 0]), TypeError, "expected a function"),
    (lambda: Frame.precessing([0, 0, 0], 1.0), ValueError, "axis"),
    (lambda: Frame.precessing([0, 0, 1], math.inf), ValueError, "rate"),
    (lambda: Frame.precessing([0, 1], 1.0), ValueError, r"axis: got shape \(2,\)"),
    (lambda: Frame.local_vertical(3), TypeError, "Frame.local_vertical: orbit: got 3"),
    (lambda: Frame.local_vertical(LINE), ValueError, "table of order 2; expected 4 or more"),
    (lambda: Frame.plane_of(LINE), ValueError, "table of order 2; expected 4 or more"),
    (lambda: Frame.plane_of(MOON, "x"), ValueError,
     'axis_1: got "x"; expected "node" or "shortest-turn"'),
    (lambda: Frame.plane_of(3), TypeError, "Frame.plane_of: orbit: got 3; expected a KeplerOrbit"),
])  # fmt: skip
def test_what_makes_no_frame(call, error, message):
    rejected(error, message, call)


@pytest.mark.parametrize("frame", [Frame.inertial(), MOVING["precessing"], MOVING["orbit_plane"],
                                   Frame.orbit_plane(0.1, 0.2), MOVING["from_attitude"],
                                   MOVING["local_vertical"],
                                   Frame.orbit_plane_pq(0.1, 0.2)], ids=lambda f: f.kind)
def test_frames_compare_copy_and_pickle(frame):
    again = pickle.loads(pickle.dumps(frame))
    assert again == frame and hash(again) == hash(frame) and again.kind == frame.kind
    assert again.at(1.5) == frame.at(1.5)
    assert copy.copy(frame) == frame
    assert frame != Frame.orbit_plane(0.5, 0.2) and frame != "frame"


def test_the_local_vertical_is_that_of_position_and_velocity():
    elements = polhode.KeplerElements(1.0, 0.7, 0.3, inclination=0.9, node=2.0, argument=1.0)
    orbit = polhode.KeplerOrbit(elements)
    frame = Frame.local_vertical(orbit)
    assert frame.arguments == {"orbit": orbit}
    for t in (-3.0, 0.0, 0.4, 40.0):
        r, v = orbit.position(t), orbit.velocity(t)
        z, h = -r / np.sqrt(r @ r), np.cross(r, v)
        y = -h / np.sqrt(h @ h)
        axes = attitude_matrix(frame.at(t).q_IS)  # its rows are the axes
        assert_allclose(axes, [np.cross(y, z), y, z], atol=budgets.numpy_formula)
        assert_allclose(frame.at(t).mu_S, [0, -np.sqrt(h @ h) / (r @ r), 0],
                        atol=budgets.numpy_formula)
    precessing = polhode.PrecessingKeplerOrbit(elements, polhode.satellites.SecularRates())
    assert_allclose(Frame.local_vertical(precessing).at(1.0).q_IS, frame.at(1.0).q_IS,
                    atol=budgets.numpy_formula)


EPOCH = polhode.ephemeris.Date("2026-05-01 TT")
MOON = polhode.ephemeris.planetary_orbit("moon", "earth", EPOCH, -1e5, 40 * 86400.0)


@pytest.mark.parametrize("frame", [
    Frame.plane_of(MOON), Frame.plane_of(MOON, "shortest-turn"), Frame.local_vertical(MOON)],
    ids=lambda frame: frame.kind)  # fmt: skip
def test_frames_of_an_ephemeris(frame):
    for t in (0.0, 1e6, 40 * 86400.0):
        r, v = MOON.position(t), MOON.velocity(t)
        normal = np.cross(r, v) / np.linalg.norm(np.cross(r, v))
        axes = attitude_matrix(frame.at(t).q_IS)
        vertical = frame.kind == "local_vertical"
        assert_allclose(axes[1] if vertical else axes[2], -normal if vertical else normal,
                        atol=budgets.numpy_formula)
        # the angular velocity, from the turn between two times
        h = 100.0
        turn = np.array([attitude_matrix(frame.at(t + d).q_IS) for d in (-h, -2 * h)] if t else
                        [attitude_matrix(frame.at(t + d).q_IS) for d in (h, 2 * h)])
        sign = -1.0 if t else 1.0
        slope = sign * (-3 * axes + 4 * turn[0] - turn[1]) / (2 * h)  # of rows that are the axes
        w = axes.T @ frame.at(t).mu_S
        assert_allclose(slope, np.cross(w, axes), atol=budgets.frame_slope)
    assert np.isnan(frame.at(41 * 86400.0).q_IS).all()
    assert pickle.loads(pickle.dumps(frame)).at(7.0).q_IS.tolist() == frame.at(7.0).q_IS.tolist()


@pytest.mark.parametrize("frame", [Frame.plane_of(MOON), Frame.plane_of(MOON, "shortest-turn"),
                                   Frame.local_vertical(MOON)], ids=lambda frame: frame.kind)
def test_what_is_inertial_does_not_depend_on_the_frame(frame):
    """The same motion, in inertial axes and in the frame of date: attitude and inertial angular
    velocity, which the canonical formulas give, are the same, and the relative rate is not."""
    body, term = polhode.Body(1.0, 2.0, 2.5), polhode.GravityGradient(MOON, 398600.4418)
    moving, still = polhode.System(body, frame, [term]), polhode.System(body, terms=[term])
    start = polhode.rotor_state(body, [0.5, 0.5, -0.5, 0.5], [1e-6, 2e-6, 3e-5])
    q_IS = frame.at(0.0).q_IS
    own = polhode.RotorState(product(q_IS * [1, -1, -1, -1], start.q), start.g)
    times = np.linspace(0, 20 * 86400.0, 5)
    runs = [polhode.integrate(polhode.Problem(system, state, 0.0, times[-1]), times)
            for system, state in ((still, start), (moving, own))]
    for t, one, other in zip(times, runs[0].states, runs[1].states, strict=True):
        there = product(frame.at(t).q_IS, other.q)
        assert_allclose(there * np.sign(there @ one.q), one.q, atol=budgets.frame_of_date)
        w = polhode.angular_velocity(moving, t, other)
        assert_allclose(w.inertial, polhode.angular_velocity(still, t, one).inertial,
                        atol=budgets.frame_of_date_rate)
        assert np.linalg.norm(w.inertial - w.relative) > 1e-10


def product(p, q):
    w = p[0] * q[0] - p[1:] @ q[1:]
    return np.array([w, *(p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:]))])


def test_a_scenario_is_built_in_the_plane_of_an_orbit():
    orbit = polhode.PrecessingKeplerOrbit(
        polhode.KeplerElements(398600.4418, 7000.0, 0.1, inclination=0.5),
        polhode.satellites.SecularRates(1e-6, 2e-6, 0.0, 3e-7, -1e-9),
    )
    system = polhode.System(polhode.Body(100.0, 110.0, 20.0), Frame.plane_of(orbit))
    start = polhode.rotor_state(system.body, [1, 0, 0, 0], [0, -1e-3, 0])
    scenario = polhode.Scenario.build(system, start, time=(0.0, 100.0, 50.0),
                                      orbits={"earth": orbit})
    assert scenario.to_dict()["frame"] == {"orbit-plane": {"orbit": "earth", "axis_1": "node"}}
    assert scenario.orbits["earth"] == orbit
    assert_allclose(scenario.frame.at(33.0).mu_S, system.frame.at(33.0).mu_S,
                    rtol=budgets.numpy_formula)


def test_a_scenario_is_built_in_the_local_vertical():
    orbit = polhode.KeplerOrbit(polhode.KeplerElements(398600.4418, 7000.0, 0.1))
    system = polhode.System(polhode.Body(100.0, 110.0, 20.0), Frame.local_vertical(orbit),
                            [polhode.GravityGradient(orbit, orbit.gm)])
    start = polhode.rotor_state(system.body, [1, 0, 0, 0], [0, -1e-3, 0])
    scenario = polhode.Scenario.build(system, start, time=(0.0, 100.0, 50.0),
                                      columns=["roll_pitch_yaw"], orbits={"earth": orbit})
    assert scenario.to_dict()["frame"] == {"local-vertical": {"orbit": "earth"}}
    assert_allclose(scenario.frame.at(33.0).q_IS, system.frame.at(33.0).q_IS,
                    atol=budgets.numpy_rounding)
    assert set(scenario.run()) == {"t", "roll", "pitch", "yaw"}


def test_what_a_frame_was_made_from():
    frame = MOVING["precessing"]
    assert repr(frame) == "Frame.precessing(axis=(1.0, 2.0, -1.0), rate=0.3, epoch=0.5)"
    assert frame.arguments == {"axis": (1.0, 2.0, -1.0), "rate": 0.3, "epoch": 0.5}
    assert MOVING["orbit_plane"].arguments["Omega"] is node
    rejected(Exception, "lambda", pickle.dumps, MOVING["orbit_plane_pq"])


class Owner:
    """Something that a function and a frame refer to."""


def test_frames_of_functions_are_collected():
    def held():
        owner = Owner()
        owner.frame = Frame.orbit_plane(lambda t: 0.1 * t if owner else t, 0.2)
        owner.frame.at([0.0, 1.0])
        return weakref.ref(owner)

    gone = held()
    assert gone() is not None  # in a cycle
    gc.collect()
    assert gone() is None


def test_motions_can_be_made():
    motion = FrameMotion([1, 0, 0, 0], [[0, 0, 1], [0, 0, 2]])
    assert motion.shape == (2,) and motion[1].mu_S.tolist() == [0, 0, 2]
    rejected(polhode.DomainError, "FrameMotion", FrameMotion, [1, 0, 0, 0], [0, 0, math.nan])
