# SPDX-License-Identifier: MIT
"""The normal form of the free triaxial rotor, against the exact motion and Sadov's frequencies."""

import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode.series import LieTransform, Series, TriaxialNormalForm, Truncation


# With the triaxiality e: a = 1, b = 1/4.
def body(e):
    return polhode.Body(1 / (1 + e / 4), 1 / (1 - e / 4), 4 / 3)


def state(J, l):
    return polhode.AndoyerState(l=l, g=0.7, h=0.3, L=2 * np.cos(J), G=2.0, H=1.1)


FORM = TriaxialNormalForm(body(0.01), 8)


@pytest.mark.parametrize("J", np.radians([10, 30]))
def test_the_motion_is_that_of_the_rotor(J):
    motion = polhode.FreeRotation(FORM.body, polhode.to_rotor(state(J, 1.0)))
    times = np.linspace(0.0, 40.0, 81)
    there = polhode.to_andoyer(motion.at(times))
    mean = FORM.mean(there)
    exact, n = polhode.to_sadov(motion, times), polhode.free.sadov_frequencies(motion)
    assert mean.l.shape == (81,)
    assert_allclose(mean.L, exact.I_l, rtol=budgets.normal_form_motion)
    assert_allclose(mean.G, exact.I_g, rtol=budgets.normal_form_motion)
    for angle, sadov, rate in (
            (mean.l, exact.phi_l + np.pi / 2, n.n_l), (mean.g, exact.phi_g, n.n_g)):
        turned = np.angle(np.exp(1j * (angle - sadov)))
        assert_allclose(turned, 0.0, atol=budgets.normal_form_motion)
        uniform = np.angle(np.exp(1j * (angle - angle[0] - rate * times)))
        assert_allclose(uniform, 0.0, atol=budgets.normal_form_motion)
    rates = FORM.frequencies(mean.L, mean.G)
    assert isinstance(rates, polhode.series.RotorFrequencies) and rates.n_l.shape == (81,)
    assert_allclose(rates.n_l, n.n_l, rtol=budgets.normal_form_motion)
    assert_allclose(rates.n_g, n.n_g, rtol=budgets.normal_form_motion)
    energy = polhode.kinetic_energy(FORM.body, motion.at(0.0))
    assert_allclose(FORM.energy(mean.L, mean.G), energy, rtol=budgets.normal_form_motion)
    back = FORM.osculating(mean)
    for name in "lgL":
        assert_allclose(getattr(back, name), getattr(there, name), rtol=budgets.normal_form_motion)
    assert np.array_equal(back.h, there.h) and np.array_equal(back.H, there.H)


def test_errors_fall_with_the_order():
    errors = {}
    for order in (1, 2, 3):
        for e in (0.1, 0.2):
            form = TriaxialNormalForm(body(e), order)
            motion = polhode.FreeRotation(form.body, polhode.to_rotor(state(0.4, 1.0)))
            exact = polhode.to_sadov(motion, 0.0)
            errors[order, e] = abs(form.mean(state(0.4, 1.0)).L - exact.I_l)
        slope = np.log2(errors[order, 0.2] / errors[order, 0.1])
        assert_allclose(slope, order + 1, atol=budgets.normal_form_slope)


def test_one_series_for_all_bodies():
    assert TriaxialNormalForm(body(0.2), 8).series == FORM.series and FORM.series.exact
    assert str(TriaxialNormalForm(body(0.2), 2).series) == (
        "-1/16*L^-2*G^4*e^2 - 1/8*G^2*e^2 - 1/2*L^2 + 3/16*L^2*e^2")
    h = Series(FORM.series.symbols, "-L^2/2 - e*(G^2 - L^2)*cos(2*l)/2")
    transform = LieTransform(h, Truncation({"e": 1}, 8), ["l"])
    assert transform.mean_hamiltonian == FORM.series
    assert_allclose(FORM.triaxiality, 0.01, rtol=budgets.normal_form_motion)


def test_numbers_and_shapes():
    one = FORM.frequencies(1.9, 2.0)
    assert isinstance(one.n_l, float) and isinstance(FORM.energy(1.9, 2), float)
    wide = FORM.frequencies(np.linspace(1.7, 1.9, 3)[:, None], [2.0, 2.1])
    assert wide.n_l.shape == (3, 2) and wide.n_l[2, 0] == one.n_l and wide.n_g[2, 0] == one.n_g
    assert FORM.energy([1.8, 1.9], 2.0)[1] == FORM.energy(1.9, 2.0)
    assert np.isnan(FORM.energy(0.0, 2.0)) and np.isnan(FORM.frequencies(np.nan, 2.0).n_l)
    assert isinstance(FORM.mean(state(0.1, 0.2)).l, float)


def test_it_is_a_value():
    same = pickle.loads(pickle.dumps(FORM))
    assert same == FORM and hash(same) == hash(FORM) and same.series == FORM.series
    assert FORM != TriaxialNormalForm(body(0.01), 7) and FORM.order == 8
    assert repr(FORM).startswith("TriaxialNormalForm(body=Body(") and "order=8)" in repr(FORM)


@pytest.mark.parametrize("wrong, kind, message", [
    (lambda: TriaxialNormalForm(body(0.1), 0), ValueError, "order 0 must be from 1 to 16"),
    (lambda: TriaxialNormalForm(body(0.1), 17), ValueError, "order 17 must be from 1 to 16"),
    (lambda: TriaxialNormalForm(polhode.Body(2, 1.5, 3), 2), ValueError,
     r"moments \(2, 1.5, 3\) must rise, A <= B < C"),
    (lambda: TriaxialNormalForm(polhode.Body(1, 2, 2), 2), ValueError, "must rise"),
    (lambda: FORM.energy([1, 2], [1, 2, 3]), ValueError, "broadcast"),
    (lambda: FORM.mean(1.0), TypeError,
     "osculating: got 1.0, a float; expected an AndoyerState"),
])
def test_what_is_wrong_is_named(wrong, kind, message):
    with pytest.raises(kind, match=message):
        wrong()
