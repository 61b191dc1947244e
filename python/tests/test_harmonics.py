# SPDX-License-Identifier: MIT
"""harmonic_fit: known series come back, periods are found, what cannot be fitted is refused."""

import pickle

import budgets
import numpy as np
import pytest
from closeness import assert_allclose
from polhode.analysis import harmonic_fit
from rejections import rejected

# A drift and the four terms of the Earth's nutation, far from t = 0, at uneven times.
P = np.array([6798.38, 3399.19, 365.26, 182.62])
T = 5000.0 + 14000.0 * np.sort(np.random.default_rng(5).random(3000))
ROUNDING = 84381 * budgets.harmonic_terms
COSINE, SINE = np.array([0.3, 0.0, -0.02, 1.0]), np.array([-17.2, 0.2, 0.15, -1.3])


def curve(t, cosine=COSINE, sine=SINE, polynomial=(84381.0, 0.1380)):
    angle = 2 * np.pi * t[:, None] / P
    drift = sum(c * t**k for k, c in enumerate(polynomial))
    return drift + np.cos(angle) @ cosine + np.sin(angle) @ sine


def test_a_sum_of_terms_comes_back():
    fit = harmonic_fit(T, curve(T), P)
    assert_allclose(fit.polynomial, [84381.0, 0.1380], rtol=budgets.harmonic_terms)
    assert_allclose(fit.cosine, COSINE, atol=ROUNDING)
    assert_allclose(fit.sine, SINE, atol=ROUNDING)
    assert_allclose(fit.periods, P, rtol=0)
    assert fit.rms < ROUNDING
    assert_allclose(fit.at(T), curve(T), rtol=budgets.harmonic_terms)
    size = np.abs(SINE).max()
    for part, ratio in ((fit.cosine, np.cos), (fit.sine, np.sin)):
        assert_allclose(fit.amplitude * ratio(fit.phase), part, atol=size * budgets.numpy_rounding)


def test_higher_powers_and_means():
    cubic = (1.0, -2e-4, 3e-8, 1e-12)
    fit = harmonic_fit(T, curve(T, polynomial=cubic), P, degree=3)
    # the powers of t at 2e4 are 1, 2e4, 4e8, 8e12
    assert_allclose(fit.polynomial * 2e4 ** np.arange(4), cubic * 2e4 ** np.arange(4),
                    atol=ROUNDING)  # fmt: skip
    mean = harmonic_fit(T, np.full(len(T), 7.0), [], degree=0)
    assert_allclose(mean.polynomial, [7.0])
    assert mean.periods.shape == mean.cosine.shape == (0,)
    assert_allclose(mean.at([0.0, 1.0]), [7.0, 7.0])


def test_what_is_left_is_measured():
    noise = np.random.default_rng(6).normal(0.0, 0.5, len(T))
    fit = harmonic_fit(T, curve(T) + noise, P)
    left = curve(T) + noise - fit.at(T)
    assert_allclose(fit.rms, np.sqrt(np.mean(left**2)), rtol=ROUNDING)
    assert 0.48 < fit.rms < 0.52
    # the normal equations: what is left is orthogonal to every term
    for period in P:
        assert abs(left @ np.cos(2 * np.pi * T / period)) < len(T) * ROUNDING


def test_several_series_share_times_and_periods():
    y = np.column_stack([curve(T), curve(T, 2 * COSINE, SINE), np.zeros(len(T))])
    fit = harmonic_fit(T, y, P * [1.004, 1.0, 0.9996, 1.0], adjust=[True, False, True, False])
    assert fit.polynomial.shape == (2, 3) and fit.cosine.shape == fit.sine.shape == (4, 3)
    assert fit.rms.shape == (3,) and fit.at(T).shape == (len(T), 3)
    assert_allclose(fit.periods, P, rtol=ROUNDING)
    one = harmonic_fit(T, y[:, 1], P)
    assert_allclose(fit.sine[:, 1], one.sine, atol=ROUNDING)
    assert_allclose(fit.at(T)[:, 0], y[:, 0], atol=ROUNDING)


@pytest.mark.parametrize("error", [-0.01, 0.03])
def test_a_period_is_found(error):
    y = 3.0 * np.cos(2 * np.pi * T / 800.0 - 0.7) + 1e-3 * T
    fit = harmonic_fit(T, y, [800.0 * (1 + error)], adjust=True)
    assert_allclose(fit.periods, [800.0], rtol=budgets.harmonic_terms)
    assert_allclose(fit.amplitude, [3.0], rtol=1e2 * budgets.harmonic_terms)
    assert_allclose(fit.phase, [0.7], rtol=1e3 * budgets.harmonic_terms)


def test_it_is_pickled_and_does_not_change():
    fit = harmonic_fit(T, curve(T), P)
    again = pickle.loads(pickle.dumps(fit))
    assert np.array_equal(again.sine, fit.sine)
    with pytest.raises(AttributeError):
        fit.rms = 0.0


@pytest.mark.parametrize(("arguments", "message"), [
    ((T, T[1:], [1.0]), "expected"),
    ((T[:, None], T, [1.0]), "expected"),
    ((T, np.full(len(T), np.nan), [1.0]), "finite"),
    ((T, T, [0.0]), "positive"),
    ((T, T, [np.inf]), "positive"),
    ((T, T, [100.0], -1), "degree -1"),
    ((T[:3], T[:3], [100.0]), "fewer than the unknowns"),
    (([], [], [], 0), "fewer than the unknowns"),
    ((T, T, [100.0, 100.0]), "do not tell apart"),
    ((np.full(9, 2.0), np.ones(9), [100.0]), "do not tell apart"),
])  # fmt: skip
def test_what_cannot_be_fitted_is_refused(arguments, message):
    rejected(ValueError, message, harmonic_fit, *arguments)


def test_periods_that_lead_nowhere_are_refused():
    rejected(ValueError, "one per period", harmonic_fit, T, T, [1.0, 2.0], adjust=[True])
    t = np.linspace(0.0, 1.0, 40)  # a parabola: the longer the period, the better
    rejected(ValueError, "come to an end", harmonic_fit, t, t**2, [30.0], degree=0, adjust=True)


SPAN = np.linspace(0.0, 30.0, 400)


@pytest.mark.parametrize(("periods", "message"), [
    # the beat of 10 and 10.01 is 10 10.01 / 0.01
    ([10.0, 10.01], r"the periods 10\.0 and 10\.01: their span is 30; expected a span of their "
                    r"beat, 10010"),
    ([3.0, 10.0, 11.0], r"the periods 10\.0 and 11\.0: .* beat, 110,"),
    ([300.0], r"the period 300\.0 and the polynomial: their span is 30; expected a span of 450"),
    ([60.0], r"the period 60\.0 and the polynomial: their span is 30; expected a span of 90"),
])  # fmt: skip
def test_periods_that_the_span_cannot_separate_are_named(periods, message):
    y = np.random.default_rng(8).normal(size=len(SPAN))
    rejected(ValueError, message, harmonic_fit, SPAN, y, periods)


@pytest.mark.parametrize("periods", [[3.0, 1.5], [10.0, 10.0 / 9.0], [2.0]])
def test_periods_that_even_rows_cannot_separate_are_named(periods):
    """A row a unit of time: turns per row that differ by a whole number, or of opposite sign."""
    t = np.arange(100.0)
    with pytest.raises(ValueError, match=r"do not tell apart .*: at these times they are alike"):
        harmonic_fit(t, np.sin(t), periods)
    uneven = 100.0 * np.sort(np.random.default_rng(9).random(100))
    assert np.all(harmonic_fit(uneven, np.sin(uneven), periods).amplitude < 1.0)


NOISE = np.random.default_rng(10).normal(size=(len(SPAN), 2000))


@pytest.fixture(scope="module", params=[1.0, 3.7, 11.0])
def alone(request):
    """A period, and the fits of its term to draws of noise."""
    return request.param, harmonic_fit(SPAN, NOISE, [request.param])


@pytest.mark.parametrize("beats", [0.02, 0.1, 0.3, 0.4, 0.6, 1.0, 3.0])
def test_noise_is_at_most_doubled_or_the_fit_is_refused(beats, alone):
    """The scatter of amplitudes over many draws of noise, next to that of the term alone."""
    period, one = alone
    other = 1.0 / (1.0 / period + beats / 30.0)
    try:
        both = harmonic_fit(SPAN, NOISE, [period, other])
    except ValueError as refused:
        assert beats < 1.0 and "do not tell apart" in str(refused)
        return
    assert beats > 0.2
    for of_both, of_one in ((both.cosine, one.cosine), (both.sine, one.sine)):
        assert np.all(of_both.std(axis=1) < budgets.harmonic_growth * of_one.std(axis=1))


def test_a_period_that_the_rows_do_not_show_cannot_be_adjusted():
    with pytest.raises(ValueError, match="which way a period changes"):
        harmonic_fit(SPAN, np.zeros(len(SPAN)), [3.0], adjust=True)
