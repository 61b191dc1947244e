# SPDX-License-Identifier: MIT
"""Charts as Python sees them: what they hold, how they convert, how they behave as arrays."""

import copy
import gc
import pickle
import sys

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import charts
from rejections import rejected
from scipy.spatial.transform import Rotation

CANONICAL = [
    (polhode.EulerState, polhode.to_euler),
    (polhode.AndoyerState, polhode.to_andoyer),
    (polhode.PoincareState, charts.nearest_poincare),
]
BODY = polhode.Body(1.0, 2.0, 2.5)


@pytest.fixture
def states():
    random = np.random.default_rng(20260401)
    return polhode.RotorState(random.normal(size=(3, 4, 4)), random.normal(size=(3, 4, 3)))


def passive(axis, angle):
    """R1 and R3 of the paper: components in turned axes."""
    c, s = np.cos(angle), np.sin(angle)
    block = {1: [[1, 0, 0], [0, c, s], [0, -s, c]], 3: [[c, s, 0], [-s, c, 0], [0, 0, 1]]}
    return np.array(block[axis])


@pytest.mark.parametrize(("chart", "convert"), CANONICAL, ids=lambda x: x.__name__)
def test_a_chart_gives_the_state_back_in_its_shape(states, chart, convert):
    there = convert(states)
    assert isinstance(there, chart)
    assert there.shape == states.shape == (3, 4)
    back = polhode.to_rotor(there)
    same = np.sum(back.q * states.q, axis=-1)
    assert_allclose(np.abs(same), 1.0, atol=budgets.chart_rounding)
    assert_allclose(back.g, states.g, atol=budgets.round_trip_floor)


def test_andoyer_is_the_matrix_product_of_section_3_2(states):
    a = polhode.to_andoyer(states)
    for k in np.ndindex(a.shape):
        tilt_J, tilt_I = np.arccos(a.L[k] / a.G[k]), np.arccos(a.H[k] / a.G[k])
        product = (passive(3, a.l[k]) @ passive(1, tilt_J) @ passive(3, a.g[k])
                   @ passive(1, tilt_I) @ passive(3, a.h[k]))
        matrix = charts.attitude_matrix(states.q[k])
        assert_allclose(matrix, product, atol=budgets.round_trip_floor)
        assert_allclose(a.G[k], np.linalg.norm(states.g[k]), rtol=budgets.chart_rounding)


def test_euler_angles_are_the_matrix_product_of_section_1(states):
    e = charts.euler_angles(states.q)
    for k in np.ndindex(e.shape):
        product = passive(3, e.psi[k]) @ passive(1, e.theta[k]) @ passive(3, e.phi[k])
        matrix = charts.attitude_matrix(states.q[k])
        assert_allclose(matrix, product, atol=budgets.round_trip_floor)
    for same in (e, charts.attitude_matrix(states.q)):
        cosines = np.abs(np.sum(charts.attitude(same) * states.q, -1))
        assert_allclose(cosines, 1.0, atol=budgets.chart_rounding)


def test_momenta_rates_and_energy_are_their_formulas(states):
    omega = states.g / BODY.moments
    assert_allclose(polhode.angular_velocity(BODY, states), omega, rtol=budgets.chart_rounding)
    assert_allclose(polhode.kinetic_energy(BODY, states), 0.5 * np.sum(states.g * omega, -1),
                    rtol=budgets.chart_rounding)
    to_inertial = np.swapaxes(charts.attitude_matrix(states.q), -1, -2)
    turned = np.einsum("...ij,...j->...i", to_inertial, omega)
    inertial = charts.inertial_angular_velocity(BODY, states)
    assert_allclose(inertial, turned, atol=budgets.round_trip_floor)
    again = polhode.rotor_state(BODY, states.q, omega)
    assert_allclose(again.g, states.g, rtol=budgets.chart_rounding)
    from_inertial = charts.rotor_state_inertial(BODY, states.q, turned)
    assert_allclose(from_inertial.g, states.g, atol=budgets.round_trip_floor)
    momentum = np.einsum("...ij,...j->...i", to_inertial, states.g)
    assert_allclose(
        charts.inertial_momentum(states), momentum, atol=budgets.round_trip_floor
    )
    rates = charts.to_euler_rates(BODY, states)
    assert_allclose(polhode.to_rotor(BODY, rates).g, states.g, atol=budgets.andoyer_generic)


def test_one_state_holds_floats_and_enums():
    s = polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])
    a = polhode.to_andoyer(s)
    assert a.shape == ()
    assert isinstance(a.G, float)
    assert charts.nearest_poincare(s).pole_J is charts.Pole.zero
    assert isinstance(polhode.kinetic_energy(BODY, s), float)
    rejected(TypeError, "no len", len, a)
    rejected(TypeError, "not iterable", iter, a)


def test_a_member_of_an_enum_may_be_named():
    s = polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])
    a = polhode.to_poincare(s, "zero", "pi")
    assert (a.pole_J, a.pole_I) == (charts.Pole.zero, charts.Pole.pi)
    assert polhode.SadovState(0, 0, 0, 0, 1, 0, "long_axis").region == charts.SadovRegion.long_axis
    assert polhode.TumblerState(1, 2, [0, 0, 1], "short_axis", 0, 0).mode == 2
    with pytest.raises(ValueError, match="mode: got 'sam'; expected one of .* short_axis"):
        polhode.TumblerState(1, 2, [0, 0, 1], "sam", 0, 0)
    rejected(TypeError, "pole_J: got 3", polhode.to_poincare, s, 3, "pi")


def test_arguments_broadcast():
    a = polhode.AndoyerState(np.zeros((2, 1)), [0.0, 1.0, 2.0], 0, 0.5, 1, 0.25)
    assert a.shape == (2, 3)
    assert_allclose(a.g, [[0, 1, 2], [0, 1, 2]])
    assert_allclose(a.L, 0.5)
    s = polhode.RotorState([1, 0, 0, 0], np.ones((5, 3)))
    assert s.q.shape == (5, 4)
    assert polhode.RotorState(np.ones((0, 4)), np.ones((0, 3))).size == 0


def test_fields_are_read_only_views_that_outlive_their_owner(states):
    a = polhode.to_andoyer(states)
    assert np.shares_memory(a.l, a.G[1:]) is False
    assert np.shares_memory(a.l, a.l)
    assert np.shares_memory(np.asarray(a), a.H)
    with pytest.raises(ValueError, match="read-only"):
        a.l[0, 0] = 1.0
    kept, value = a.l, a.l.copy()
    del a
    gc.collect()
    trash = [np.full(1000, 7.0) for _ in range(100)]
    assert_allclose(kept, value, rtol=0)
    assert trash[0][0] == 7.0


@pytest.mark.parametrize("key", [
    0, -1, (1, 2), slice(None, None, -1), (slice(None), slice(1, 3)), (..., 0), [0, 2],
    np.array([True, False, True]), (None, 1), (slice(0, 0),)], ids=repr)
def test_indexing_is_that_of_numpy(states, key):
    picked = states[key]
    expected = states.q[(*(key if isinstance(key, tuple) else (key,)), Ellipsis, slice(None))] \
        if not (isinstance(key, tuple) and Ellipsis in key) else states.q[(*key, slice(None))]
    np.testing.assert_array_equal(picked.q, expected)
    assert picked.shape == expected.shape[:-1]


def test_indexing_past_the_end_is_an_index_error(states):
    for key in (3, (0, 4), (0, 0, 0)):
        with pytest.raises(IndexError):
            states[key]


def test_iteration_reshape_and_numpy_conversion(states):
    assert [s.shape for s in states] == [(4,)] * 3
    assert len(states) == 3
    flat = states.reshape(12)
    assert flat.shape == (12,)
    assert flat.reshape((3, 4)) == states
    assert states.ndim == 2
    a = polhode.to_andoyer(states)
    table = np.asarray(a)
    assert table.shape == (3, 4, 6)
    assert_allclose(table[..., 4], a.G, rtol=0)
    assert np.array(a).flags.writeable
    assert np.asarray(a, dtype=np.float32).dtype == np.float32


@pytest.mark.parametrize("again", [lambda x: pickle.loads(pickle.dumps(x)), copy.copy,
                                   copy.deepcopy], ids=["pickle", "copy", "deepcopy"])
def test_everything_can_be_copied(states, again):
    motion = polhode.FreeRotation(BODY, states[0, 0], 3.0)
    several = [states, states[0, 0], states[:, ::2], polhode.to_andoyer(states),
               charts.nearest_poincare(states), polhode.to_sadov(BODY, states),
               polhode.to_serret(motion, 1.0), polhode.to_tumbler(motion, 1.0), BODY]
    for thing in several:
        assert again(thing) == thing
    twin = again(motion)
    assert twin.at(7.0) == motion.at(7.0)
    assert twin.epoch == 3.0
    tensor = polhode.Body.from_tensor([[2.0, 0.1, 0.0], [0.1, 1.5, 0.2], [0.0, 0.2, 1.2]])
    assert again(tensor) == tensor


def test_repr_says_what_is_there(states):
    assert repr(BODY) == "Body(1.0, 2.0, 2.5)"
    one = polhode.AndoyerState(0, 1, 2, 0.5, 1, 0.25)
    assert repr(one) == "AndoyerState(l=0.0, g=1.0, h=2.0, L=0.5, G=1.0, H=0.25)"
    assert repr(states).startswith("<RotorState of shape (3, 4), first: q=[")
    assert repr(states[:0]) == "<RotorState of shape (0, 4)>"
    assert "pole_J=Pole.zero" in repr(charts.nearest_poincare(
        polhode.RotorState([1, 0, 0, 0], [0, 0, 1])))


def test_scipy_rotations_are_attitudes():
    rotation = Rotation.from_euler("zxz", [0.3, 0.2, 0.1])  # active, about fixed axes
    s = polhode.RotorState(rotation, [1.0, 2.0, 3.0])
    body_axis = charts.attitude_matrix(s.q).T @ [0, 0, 1]
    assert_allclose(rotation.apply([0, 0, 1]), body_axis, atol=budgets.chart_rounding)
    many = Rotation.random(5, random_state=1)
    assert polhode.RotorState(many, np.ones(3)).shape == (5,)
    matrix = charts.to_scipy(s).as_matrix()
    assert_allclose(matrix, rotation.as_matrix(), atol=budgets.chart_rounding)
    there = charts.to_scipy(polhode.RotorState(many, np.ones(3)))
    assert_allclose((there * many.inv()).magnitude(), 0.0, atol=budgets.chart_rounding)
    assert_allclose(charts.to_scipy([1, 0, 0, 0]).as_matrix(), np.eye(3))


def test_rotations_without_scipy_name_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.spatial.transform", None)
    with pytest.raises(ImportError, match="^to_scipy needs SciPy: pip install scipy$"):
        charts.to_scipy([1, 0, 0, 0])


@pytest.mark.parametrize(("make", "error", "says"), [
    (lambda: polhode.RotorState([1, 0, 0], [1, 2, 3]), ValueError,
     r"q: got shape \(3,\); expected \(..., 4\)"),
    (lambda: polhode.RotorState([1, 0, 0, 0], [1, 2, np.nan]), ValueError, "g: got nan"),
    (lambda: polhode.RotorState([0, 0, 0, 0], [1, 2, 3]), ValueError,
     r"q: got \(0, 0, 0, 0\); expected an attitude, which is not zero"),
    (lambda: polhode.RotorState([1, 0, 0, 0], 3), ValueError, r"expected \(..., 3\)"),
    (lambda: polhode.AndoyerState([0, 1], 0, 0, [0.1, 3], 1, 0), polhode.DomainError,
     r"L = 3 must be within \+-G, G = 1 \(at index \(1,\)\)"),
    (lambda: polhode.AndoyerState("x", 0, 0, 0, 1, 0), TypeError, "l: got a str"),
    (lambda: polhode.AndoyerState(1j, 0, 0, 0, 1, 0), TypeError, "complex"),
    (lambda: polhode.AndoyerState(np.array(["a"]), 0, 0, 0, 1, 0), TypeError, "expected real"),
    (lambda: polhode.AndoyerState(None, 0, 0, 0, 1, 0), TypeError, "l: got None; expected numbers"),
    (lambda: polhode.AndoyerState(np.datetime64("2029-04-13"), 0, 0, 0, 1, 0), TypeError,
     "expected real numbers"),
    (lambda: polhode.AndoyerState(np.timedelta64(1, "s"), 0, 0, 0, 1, 0), TypeError,
     "expected real numbers"),
    (lambda: polhode.AndoyerState(np.ma.array([1.0, 2.0], mask=[1, 0]), 0, 0, 0, 1, 0), ValueError,
     "l: got masked values"),
    (lambda: polhode.AndoyerState([[1], [1, 2]], 0, 0, 0, 1, 0), TypeError, "ragged"),
    (lambda: polhode.AndoyerState([1, 2], [1, 2, 3], 0, 0, 1, 0), ValueError,
     r"l of shape \(2,\) and g of shape \(3,\) do not broadcast"),
    (lambda: polhode.AndoyerState(10**400, 0, 0, 0, 1, 0), OverflowError, "too large"),
    (lambda: polhode.PoincareState(0, 0, 0, 1, 0, 0, 7, 0), ValueError, "pole"),
    (lambda: polhode.PoincareState(0, 0, 0, 1, 0, 0, 0.5, 0), ValueError, "pole"),
    (lambda: polhode.SadovState(0, 0, 0, 0, 1, 0, lobe=2), ValueError, "lobe"),
    (lambda: polhode.TumblerState(
        1, 2, [0, 0, 1], polhode.free.Regime.rest, 0, 0
    ), ValueError, "mode"),
    (lambda: polhode.EulerState(0, np.inf, 0, 0, 0, 0), ValueError, "inf"),
    (lambda: polhode.Body(1, 1, 3), ValueError, r"Body: moments \(1, 1, 3\) break I3 <= I1 \+ I2"),
    (lambda: polhode.Body.from_tensor(np.eye(2)), ValueError, r"expected \(..., 3, 3\)"),
    (lambda: charts.attitude(np.ones((3, 3))), ValueError, "orthogonal|rotation"),
    (lambda: polhode.to_andoyer(3), TypeError, "RotorState"),
    (lambda: polhode.to_rotor(polhode.RotorState([1, 0, 0, 0], [1, 2, 3])), TypeError, "to_rotor"),
], ids=lambda x: "" if callable(x) else str(x)[:24])
def test_bad_input_is_named(make, error, says):
    rejected(error, says, make)


def test_any_real_dtype_and_any_memory_layout_is_taken():
    g = np.arange(24, dtype=np.float32).reshape(2, 4, 3)
    expected = g.astype(float)
    for array in (g, g.astype(int), np.asfortranarray(expected), expected[::1],
                  expected.astype(">f8"), expected.tolist()):
        s = polhode.RotorState([1, 0, 0, 0], array)
        np.testing.assert_array_equal(s.g, expected)
    reverse = expected[:, ::-1]
    np.testing.assert_array_equal(polhode.RotorState([1, 0, 0, 0], reverse).g, reverse)
    frozen = expected.copy()
    frozen.flags.writeable = False
    np.testing.assert_array_equal(polhode.RotorState([1, 0, 0, 0], frozen).g, frozen)


def test_results_are_not_checked_nan_in_nan_out():
    motion = polhode.FreeRotation(BODY, polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0]))
    lost = motion.at([0.0, np.nan])
    assert np.isnan(lost.q[1]).all()
    assert np.isnan(polhode.to_andoyer(lost).G[1])
    assert np.isfinite(polhode.to_andoyer(lost).G[0])


def test_a_body_prints_what_makes_it():
    body = polhode.Body(1.0, 1.7, 2.1)
    assert repr(body) == "Body(1.0, 1.7, 2.1)"
    turned = polhode.Body.with_axes([1.0, 1.7, 2.1], [0.6, 0.0, 0.8, 0.0])
    assert repr(turned) == "Body.with_axes((1.0, 1.7, 2.1), (0.6, 0.0, 0.8, 0.0))"
    for one in (body, turned):
        assert eval(repr(one), {"Body": polhode.Body}) == one


def test_many_states_have_the_bits_of_one_at_a_time():
    random = np.random.default_rng(4)
    states = polhode.RotorState(random.normal(size=(5, 41, 4)), random.normal(size=(5, 41, 3)))
    body = polhode.Body(1.0, 1.7, 2.1)
    there = (polhode.to_andoyer, polhode.to_euler, lambda s: polhode.to_sadov(body, s))
    back = (polhode.to_rotor, polhode.to_rotor, lambda s: polhode.to_rotor(body, s))
    for to_chart, to_rotor in zip(there, back, strict=True):
        chart = to_chart(states)
        for key in ((0, 0), (3, 17), (4, 40)):
            assert to_chart(states[key]) == chart[key]
            assert to_rotor(chart[key]) == to_rotor(chart)[key]
        # in another order, from memory that is not in a row
        assert to_chart(states[::-2, ::3]) == chart[::-2, ::3]


def test_a_state_that_is_none_is_named_by_its_index():
    g = np.ones((3, 40, 3))
    g[1, 7, 2] = 1e308
    states = polhode.RotorState([1.0, 0.0, 0.0, 0.0], g)
    body = polhode.Body(1e-10, 1.7e-10, 2.1e-10)
    rejected(ValueError, r"a rate too large for a double.*\(1, 7\)", polhode.to_sadov, body, states)
    rejected(ValueError, "t0 = inf is not finite", polhode.to_sadov, body, states[0, 0], np.inf)
