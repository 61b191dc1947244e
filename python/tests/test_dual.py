# SPDX-License-Identifier: MIT
"""Dual numbers: every rule against central differences, and how they live with NumPy."""

import math
import pickle

import budgets
import numpy as np
import pytest
from closeness import assert_allclose
from differences import slope
from polhode import Body, HamiltonianTerm, RotorState, System
from polhode.charts import attitude, attitude_matrix
from polhode.rates import effect
from polhode.types import Dual
from rejections import rejected

EPS = np.finfo(float).eps
SLOPES = budgets.numpy_differences


def variable(x: float, index: int = 0, size: int = 6) -> Dual:
    derivative = np.zeros(size)
    derivative[index] = 1.0
    return Dual(x, derivative)


FUNCTIONS = [
    np.sin, np.cos, np.tan, np.arctan, np.exp, np.expm1, np.sinh, np.cosh, np.tanh, np.sqrt,
    np.cbrt, np.log, np.log1p, np.log2, np.log10, np.arcsin, np.arccos, np.fabs, np.deg2rad,
    np.rad2deg, np.radians, np.degrees, np.abs, np.negative, np.square, np.reciprocal, np.conj,
]


@pytest.mark.parametrize("f", FUNCTIONS, ids=lambda f: f.__name__)
@pytest.mark.parametrize("x", [0.3, 0.71])
def test_a_function_of_numpy_has_the_value_and_the_slope_of_its_float(f, x):
    y = f(variable(x, 2))
    assert isinstance(y, Dual)
    assert_allclose(y.value, f(x), rtol=budgets.dual_derivative * EPS)
    assert_allclose(y.derivative[2], slope(f, x), rtol=SLOPES)
    assert np.count_nonzero(y.derivative) == 1


@pytest.mark.parametrize("f", [np.cbrt, np.abs, np.arctan, np.sin])
def test_negative_arguments(f):
    y = f(variable(-0.3))
    assert_allclose([y.value, y.derivative[0]], [f(-0.3), slope(f, -0.3)], rtol=SLOPES)


BINARY = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "**": lambda a, b: a**b,
    "arctan2": np.arctan2,
    "hypot": np.hypot,
    "power": np.power,
}


@pytest.mark.parametrize("f", BINARY.values(), ids=BINARY)
def test_operators_of_two(f):
    x, y = 0.7, 1.3
    by_x, by_y = slope(lambda a: f(a, y), x), slope(lambda b: f(x, b), y)
    both = f(variable(x, 0), variable(y, 1))
    assert_allclose(both.value, f(x, y), rtol=budgets.dual_derivative * EPS)
    assert_allclose(both.derivative[:2], [by_x, by_y], rtol=SLOPES)
    assert_allclose(f(variable(x, 0), y).derivative[0], by_x, rtol=SLOPES)
    assert_allclose(f(x, variable(y, 1)).derivative[1], by_y, rtol=SLOPES)
    # numbers of NumPy are constants too
    assert_allclose(f(np.float64(x), variable(y, 1)).derivative[1], by_y, rtol=SLOPES)
    assert_allclose(f(variable(x, 0), np.float32(1.5)).derivative[0],
                    slope(lambda a: f(a, 1.5), x), rtol=SLOPES)


@pytest.mark.parametrize("n", [0, 1, 2, 3, -1, -2, 0.5])
def test_powers(n):
    y = variable(0.8) ** n
    assert_allclose([y.value, y.derivative[0]], [0.8**n, n * 0.8 ** (n - 1)],
                    rtol=budgets.numpy_rounding)
    assert_allclose((variable(-0.8) ** 3).derivative[0], 3 * 0.8**2, rtol=budgets.numpy_rounding)
    assert (variable(0.0) ** 2).derivative[0] == 0.0
    assert (variable(0.0) ** 1).derivative[0] == 1.0


def test_remainder_is_that_of_python():
    for x in (7.5, -7.5):
        y = variable(x) % 2.0
        assert (y.value, y.derivative[0]) == (x % 2.0, 1.0)
    with pytest.raises(TypeError, match="divisor"):
        variable(1.0) % variable(2.0)


def test_comparisons_look_at_the_value():
    x = variable(2.0)
    assert x == 2.0 and x != 3.0 and x > 1 and x >= 2.0 and x < 3.0 and x <= np.float64(2.0)
    assert 1.0 < x and x == Dual(2.0) and bool(x) and not bool(Dual(0.0))
    assert max(x, Dual(3.0)).value == 3.0  # NaN: none; max itself is asked
    assert (x == "2") is False
    with pytest.raises(TypeError):
        hash(x)


def test_arrays_of_duals_are_arrays():
    v = np.array([variable(1.0, 0), variable(2.0, 1), variable(3.0, 2)])
    assert v.dtype == object
    assert isinstance(2.0 * v[0], Dual) and isinstance(np.ones(3) @ v, Dual)
    assert_allclose((v @ v).derivative[:3], [2.0, 4.0, 6.0])
    assert_allclose((v @ [1.0, 0.0, -1.0]).derivative[:3], [1, 0, -1])
    length = np.linalg.norm(v)
    direction = np.array([1, 2, 3]) / np.sqrt(14.0)
    assert_allclose(length.derivative[:3], direction, rtol=budgets.numpy_rounding)
    cross = np.cross(v, [0.0, 0.0, 1.0])
    assert [c.value for c in cross] == [2.0, -1.0, 0.0]
    assert (np.eye(3) @ v).shape == (3,)
    assert [x.value for x in np.sin(v)] == [math.sin(k) for k in (1.0, 2.0, 3.0)]
    # an array combined with a Dual makes an array
    assert isinstance(np.sum(v), Dual) and isinstance(np.multiply(2.0, v[0]), Dual)
    assert np.arctan2(v, v[0]).shape == np.add.outer(v, [1.0]).ravel().shape == (3,)
    assert np.less(v[0], 2.0) and np.maximum(v[0], 2.0) == 2.0
    assert (v[0] * np.array([2.0])).shape == (1,)
    assert (np.array([2.0, 3.0]) + v[0]).shape == (2,)


@pytest.mark.parametrize(("call", "message"), [
    (lambda: math.sin(variable(1.0)), r"np\.sin, not math\.sin"),
    (lambda: np.array([variable(1.0)]).astype(float), "no float"),
    (lambda: np.zeros(3)[0:1].__setitem__(0, variable(1.0)), "no float"),
    (lambda: variable(1.0) + "1", None),
    (lambda: variable(1.0) + None, None),
    (lambda: variable(1.0, size=1) + variable(1.0, size=6), "do not mix"),
])  # fmt: skip
def test_derivatives_are_not_lost_silently(call, message):
    rejected(TypeError, message, call)


def test_making_one():
    x = Dual(1.5)
    assert x.value == 1.5 and x.derivative.shape == (6,) and not x.derivative.any()
    y = Dual(1.5, [2.0])
    assert y.derivative.tolist() == [2.0] and repr(y) == "Dual(1.5, [2.0])"
    again = pickle.loads(pickle.dumps(y))
    assert again.value == 1.5 and again.derivative.tolist() == [2.0]
    rejected(ValueError, r"shape \(2,\)", Dual, 1.0, [1.0, 2.0])
    with pytest.raises(TypeError):
        Dual("one")


def test_not_a_number_stays_one():
    assert math.isnan(np.sin(variable(math.nan)).value)
    assert math.isnan((variable(math.nan) * 2).value)


def test_the_matrix_of_an_attitude_and_back():
    q = np.array([0.5, -0.1, 0.7, 0.3])
    q /= np.linalg.norm(q)
    dual = np.array([variable(c, k) for k, c in enumerate(q)])
    R = attitude_matrix(dual)
    assert R.shape == (3, 3) and R.dtype == object
    values = np.vectorize(lambda x: x.value)(R)
    assert_allclose(values, attitude_matrix(q), atol=budgets.numpy_rounding)
    for k in range(4):
        by_differences = slope(lambda x, k=k: attitude_matrix(q + (x - q[k]) * np.eye(4)[k]), q[k])
        by_rule = np.vectorize(lambda x, k=k: x.derivative[k])(R)
        assert_allclose(by_rule, by_differences, atol=SLOPES)
    assert_allclose([c.value for c in attitude(R)], q, atol=budgets.numpy_rounding)
    rejected(TypeError, "one kind", attitude_matrix, [dual[0], Dual(1.0, [0.0]), 0, 0])
    rejected(TypeError, "real numbers", attitude_matrix, np.array([dual, dual]))


@pytest.mark.parametrize("axis", range(4))
def test_attitudes_next_to_half_a_turn(axis):
    q = np.full(4, 1e-3)
    q[axis] = 1.0
    q /= np.linalg.norm(q)
    back = attitude(attitude_matrix([variable(c, k) for k, c in enumerate(q)]))
    assert_allclose([c.value for c in back], q, atol=budgets.numpy_rounding)


def test_second_derivatives_are_duals_of_duals():
    seen = []

    def energy(t, s):
        seen.append(s)
        return s.g[0] ** 2

    body = Body(1, 2, 2.5)
    system = System(body, terms=HamiltonianTerm(energy))
    effect(system, 0.0, RotorState([1, 0, 0, 0], [3, 0, 0]))
    assert_allclose(seen[-1].g[0].derivative, [0, 0, 0, 1, 0, 0])
    assert "DualState" in repr(seen[-1])
