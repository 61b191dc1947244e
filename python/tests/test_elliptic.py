# SPDX-License-Identifier: MIT
"""polhode.elliptic: shapes, domains, messages, and values against mpmath."""

import math

import budgets
import mpmath
import numpy as np
import pytest
from polhode import elliptic
from rejections import rejected

SIGNATURES = {
    "carlson_rf": (0.5, 1.0, 2.0),
    "carlson_rc": (0.5, 1.0),
    "carlson_rd": (0.5, 1.0, 2.0),
    "carlson_rj": (0.5, 1.0, 2.0, 3.0),
    "agm": (1.0, 2.0),
    "cel": (0.5, 2.0, 1.0, 1.0),
    "complete_k": (0.3,),
    "complete_e": (0.3,),
    "complete_b": (0.3,),
    "complete_d": (0.3,),
    "complete_pi": (0.5, 0.3),
    "legendre_f": (1.0, 0.3),
    "legendre_e": (1.0, 0.3),
    "legendre_d": (1.0, 0.3),
    "legendre_b": (1.0, 0.3),
    "legendre_pi": (1.0, 0.5, 0.3),
    "amplitude": (1.0, 0.3),
    "jacobi_zeta": (1.0, 0.3),
    "heuman_lambda0": (1.0, 0.3),
    "nome": (0.3,),
    "complementary_nome": (0.3,),
}


def test_all_names_are_tried():
    assert set(SIGNATURES) | {"jacobi", "JacobiFunctions", "Modulus"} == set(elliptic.__all__)


@pytest.mark.parametrize("name", SIGNATURES)
def test_shapes(name):
    function, arguments = getattr(elliptic, name), SIGNATURES[name]
    value = function(*arguments)
    assert type(value) is float
    assert math.isfinite(value)
    # every argument an axis of its own
    rank = len(arguments)
    axes = [np.full((2,) + (1,) * (rank - 1 - i), x) for i, x in enumerate(arguments)]
    out = function(*axes)
    assert out.shape == (2,) * rank
    assert np.all(out == value)
    assert function(*(np.empty((0, 3)) for _ in arguments)).shape == (0, 3)
    assert np.all(np.isnan(function(*([x, math.nan] for x in arguments))) == [False, True])


def test_shapes_that_do_not_broadcast():
    rejected(ValueError, "broadcast", elliptic.legendre_f, [0.1, 0.2, 0.3], [0.1, 0.2])
    rejected(ValueError, "broadcast", elliptic.complete_k, [0.1, 0.2, 0.3], m1=[0.1, 0.2])
    rejected(TypeError, "m: got a ragged or mixed list", elliptic.complete_k, [[0.1], [0.2, 0.3]])


def test_jacobi():
    one = elliptic.jacobi(0.7, 0.3)
    assert all(type(x) is float for x in one)
    many = elliptic.jacobi([[0.7, -0.7]], [[0.3], [1.0]])
    assert many.sn.shape == many.cn.shape == many.dn.shape == (2, 2)
    for name in ("sn", "cn", "dn"):  # arrays are computed in lanes
        lane, alone = getattr(many, name)[0, 0], getattr(one, name)
        assert lane == pytest.approx(alone, rel=budgets.elliptic_python)
    assert many.sn[1, 1] == -math.tanh(0.7)
    assert np.all(np.isnan(elliptic.jacobi(0.7, math.nan)))


def test_jacobi_of_arrays_depends_on_each_argument_alone():
    u = np.linspace(-30.0, 30.0, 1201)
    m1 = np.geomspace(1e-12, 1.0, 7)[:, None]
    all_at_once = elliptic.jacobi(u, 1.0 - m1, m1=m1)
    assert all_at_once.dn.shape == (7, 1201)
    for i, complement in enumerate(m1[:, 0]):
        row = elliptic.jacobi(u[::-1], 1.0 - complement, m1=complement)
        one_by_one = [elliptic.jacobi(x, 1.0 - complement, m1=complement).sn for x in u[::40]]
        assert np.array_equal(row.sn[::-1], all_at_once.sn[i])
        apart = np.abs(all_at_once.sn[i, ::40] - one_by_one)
        assert np.all(apart <= budgets.elliptic_python * (1.0 + np.abs(u[::40])))
    u[3] = math.nan
    assert np.isnan(elliptic.jacobi(u, 0.5).sn).tolist() == [k == 3 for k in range(1201)]
    rejected(ValueError, r"breaks m \+ m1 = 1", elliptic.jacobi, u, 0.5, m1=[0.25] * 1201)


@pytest.mark.parametrize("m", [-50.0, -0.25, 0.0, 0.3, 0.96875])
@pytest.mark.parametrize("phi", [-2.0, 0.5, 1.5, 400.0])
def test_values(m, phi):
    with mpmath.workdps(40):
        expected = {"legendre_f": mpmath.ellipf(phi, m), "legendre_e": mpmath.ellipe(phi, m),
                    "legendre_pi": mpmath.ellippi(-0.5, phi, m), "complete_k": mpmath.ellipk(m),
                    "complete_e": mpmath.ellipe(m), "complete_pi": mpmath.ellippi(-0.5, m)}
    got = {"legendre_f": elliptic.legendre_f(phi, m), "legendre_e": elliptic.legendre_e(phi, m),
           "legendre_pi": elliptic.legendre_pi(phi, -0.5, m), "complete_k": elliptic.complete_k(m),
           "complete_e": elliptic.complete_e(m), "complete_pi": elliptic.complete_pi(-0.5, m)}
    for name, value in expected.items():
        assert got[name] == pytest.approx(float(value), rel=budgets.elliptic_python), name


def test_principal_values():
    with mpmath.workdps(40):
        assert elliptic.carlson_rj(2.0, 3.0, 4.0, -5.0) == pytest.approx(
            float(mpmath.elliprj(2, 3, 4, -5).real), rel=budgets.elliptic_python)
        assert elliptic.carlson_rc(1.0, -2.0) == pytest.approx(
            float(mpmath.elliprc(1, -2).real), rel=budgets.elliptic_python)
        assert elliptic.complete_pi(1.5, 0.25) == pytest.approx(
            float(mpmath.ellippi(1.5, 0.25).real), rel=budgets.elliptic_python)


def test_next_to_the_separatrix():
    # K = ln(4/k1) and more: m alone cannot tell
    assert elliptic.complete_k(1.0) == math.inf
    assert elliptic.complete_k(1.0, m1=1e-300) == pytest.approx(
        math.log(4.0) + 150.0 * math.log(10.0), rel=budgets.elliptic_python)
    assert elliptic.legendre_f(1.0, 1.0, m1=[0.0, 1e-300]) == pytest.approx(
        math.asinh(math.tan(1.0)), rel=budgets.elliptic_python)


def test_outside_the_domain():
    for name in ("complete_k", "complete_e", "complete_d", "complete_b", "nome"):
        assert math.isnan(getattr(elliptic, name)(1.5)), name
    assert math.isnan(elliptic.legendre_f(1.5, 1.5))
    assert math.isnan(elliptic.complete_k(-math.inf))
    assert math.isnan(elliptic.carlson_rf(-1.0, 1.0, 1.0))
    assert elliptic.complete_pi(1.0, 0.5) == math.inf
    with pytest.raises(ValueError, match=r"pair \(0.25, 0.5\) breaks m \+ m1 = 1"):
        elliptic.complete_k([0.5, 0.25], m1=[0.5, 0.5])
    rejected(TypeError, "expected real numbers", elliptic.legendre_f, "1", 0.5)
