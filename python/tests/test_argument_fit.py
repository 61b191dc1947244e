# SPDX-License-Identifier: MIT
"""argument_fit: terms of known arguments come back, with their phases and their changes."""

import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode.analysis import argument_fit

# The Earth: l, lp, F, D, Om in rad and rad per day, and four terms.
EARTH = polhode.secular.nutation_theory(order=1, least=1e-6)
EPOCH, RATES = EARTH.at_epoch, EARTH.rates * 86400.0
M = np.array([[0, 0, 0, 0, 1], [0, 0, 0, 0, 2], [0, 1, 0, 0, 0], [0, 0, 2, -2, 2]])
T = -5000.0 + 14000.0 * np.sort(np.random.default_rng(5).random(3000))
COSINE, SINE = np.array([0.3, 0.0, -0.02, 1.0]), np.array([-17.2, 0.2, 0.15, -1.3])
CHANGE = np.array([2e-5, 0.0, 0.0, -3e-6])
ROUNDING = 84381 * budgets.harmonic_terms
OF_CHANGES = 84381 * budgets.argument_changes


def curve(t, change=0.0):
    angle = (EPOCH + np.outer(t, RATES)) @ M.T
    return (84381.0 + 0.1380 * t + np.cos(angle) @ COSINE + np.sin(angle) @ SINE
            + t * (np.sin(angle) @ (change * np.ones(4))))  # fmt: skip


def test_a_sum_of_terms_comes_back_with_its_phases():
    fit = argument_fit(T, curve(T), EPOCH, RATES, M)
    assert_allclose(fit.polynomial, [84381.0, 0.1380], rtol=budgets.harmonic_terms)
    assert_allclose(fit.cosine, COSINE, atol=ROUNDING)
    assert_allclose(fit.sine, SINE, atol=ROUNDING)
    assert np.all(fit.cosine_change == 0) and np.all(fit.sine_change == 0)
    assert fit.rms < ROUNDING
    assert_allclose(fit.at(T), curve(T), rtol=budgets.harmonic_terms)
    # days: the node of the Moon, and half a year
    assert_allclose(fit.periods[[0, 3]], [6798.38, 182.62], rtol=budgets.argument_period)


def test_changes_of_coefficients_come_back():
    which = [True, False, False, True]
    fit = argument_fit(T, curve(T, CHANGE), EPOCH, RATES, M, changes=which)
    assert_allclose(fit.sine_change * 1e4, CHANGE * 1e4, atol=OF_CHANGES)
    assert_allclose(fit.cosine_change * 1e4, np.zeros(4), atol=OF_CHANGES)
    assert_allclose(fit.sine, SINE, atol=OF_CHANGES)
    without = argument_fit(T, curve(T, CHANGE), EPOCH, RATES, M)
    assert without.rms > 1e3 * fit.rms
    assert_allclose(fit.at(T), curve(T, CHANGE), rtol=budgets.harmonic_terms)


def test_several_series_share_the_arguments():
    y = np.column_stack([curve(T), 2 * curve(T), np.zeros(len(T))])
    fit = argument_fit(T, y, EPOCH, RATES, M, 2, changes=True)
    assert fit.polynomial.shape == (3, 3) and fit.sine_change.shape == (4, 3)
    one = argument_fit(T, y[:, 1], EPOCH, RATES, M, 2, changes=True)
    assert_allclose(fit.sine[:, 1], one.sine, atol=ROUNDING)
    assert fit.at(T).shape == y.shape
    again = pickle.loads(pickle.dumps(fit))
    assert np.array_equal(again.sine, fit.sine)


def test_a_mean_alone():
    fit = argument_fit(T, np.full(len(T), 7.0), EPOCH, RATES, np.zeros((0, 5)), 0)
    assert_allclose(fit.polynomial, [7.0])
    assert fit.cosine.shape == (0,)


@pytest.mark.parametrize(("changed", "message"), [
    ({"t": T[1:]}, r"got t of shape \(2999,\)"),
    ({"y": np.full(len(T), np.nan)}, "must be finite"),
    ({"rates": RATES[1:]}, r"at_epoch of shape \(5,\) and rates of \(4,\)"),
    ({"rates": np.full(5, np.inf)}, "must be finite"),
    ({"multiples": M[:, 1:]}, r"got multiples of shape \(4, 4\); expected \(J, 5\)"),
    ({"multiples": 0.5 * M}, "whole numbers"),
    ({"multiples": [[0, 0, 0, 0, 0]]}, r"the term \[0, 0, 0, 0, 0\] does not turn"),
    ({"multiples": [M[0], -M[0]]}, r"do not tell apart the term \[0, 0, 0, 0, -?1\] and"),
    # l' and 2F - 2D + 2Om - l' beat in 10,467 years
    ({"multiples": [[0, 1, 0, 0, 0], [0, -1, 2, -2, 2]]}, r"do not tell apart .* span is 13"),
    ({"degree": -1}, "degree -1"),
    ({"changes": [True]}, "one per term"),
    ({"t": T[:9], "y": T[:9]}, "9 rows are fewer than the 10 unknowns"),
])  # fmt: skip
def test_what_cannot_be_fitted_is_refused(changed, message):
    given = {"t": T, "y": curve(T), "at_epoch": EPOCH, "rates": RATES, "multiples": M}
    with pytest.raises(ValueError, match=message):
        argument_fit(**{**given, **changed})
