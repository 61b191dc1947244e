# SPDX-License-Identifier: MIT
"""Many spin axes on one orbit: one at a time to the last bit, and Taylor's series in mpmath."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import budgets
import mpmath
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import Splitting
from polhode.secular import ElementSeries, PrecessionRates, spin_histories, spin_history

ARCSEC = np.pi / 648000
ELLIPSE = [[4.249e3 * ARCSEC, 0.019, 0.53], [7.455e3 * ARCSEC, 0.0163, 3.49]]
PLANE = [[0.0, 0.0138, 1.88], [-18.85e3 * ARCSEC, 0.008, 4.28]]
SERIES = ElementSeries(ELLIPSE, PLANE)  # kyr
METHOD = Splitting(2.0, "order8")
TIMES = [0.0, 3.0, 10.0, 31.4]


def many(count):
    draw = np.random.default_rng(7)
    rates = [PrecessionRates(*row) for row in draw.uniform(0, 0.2, (count, 2))]
    return rates, draw.normal(size=(count, 3))


def test_each_is_that_of_one_body_to_the_last_bit():
    rates, poles = many(70)
    for orbit in (SERIES, polhode.secular.shipped_orbit("mars", year=1e-3)):
        for sign in (1, -1):
            times = sign * np.array(TIMES)
            found = spin_histories(orbit, rates, poles, times, METHOD)
            assert found.s.shape == (70, 4, 3) and found.failures == {}
            assert found.t.tolist() == times.tolist()
            for k in (0, 1, 33, 69):
                alone = spin_history(orbit, rates[k], poles[k], times, METHOD)
                assert found.s[k].tobytes() == alone.s.tobytes()
                assert found.obliquity[k].tobytes() == alone.obliquity.tobytes()
                assert found.precession[k].tobytes() == alone.precession.tobytes()


def test_it_is_the_motion_by_taylors_series():
    """20 digits, series of degree 12; ds/dt of the docstring written once more."""
    rates, poles = many(2)
    found = spin_histories(SERIES, rates, poles, [10.0], Splitting(0.5, "order8"))
    with mpmath.workdps(20):
        mpf, cos, sin = mpmath.mpf, mpmath.cos, mpmath.sin

        def summed(rows, t):
            angles = [(mpf(a), mpf(f) * t + mpf(p)) for f, a, p in rows]
            return sum(a * cos(x) for a, x in angles), sum(a * sin(x) for a, x in angles)

        for rate, pole, s in zip(rates, poles, found.s, strict=True):

            def slope(t, y, rate=rate):
                (k, h), (q, p) = summed(ELLIPSE, t), summed(PLANE, t)
                c = 2 * mpmath.sqrt(1 - q * q - p * p)
                n = (p * c, -q * c, 1 - 2 * (q * q + p * p))
                alpha = mpf(rate.star) * (1 - k * k - h * h) ** mpf(-1.5) + mpf(rate.satellites)
                turn = alpha * sum(a * b for a, b in zip(y, n, strict=True))
                return [turn * (y[(i + 1) % 3] * n[(i + 2) % 3] - y[(i + 2) % 3] * n[(i + 1) % 3])
                        for i in range(3)]  # fmt: skip

            start = [mpf(x) for x in pole]
            length = mpmath.sqrt(sum(x * x for x in start))
            start = [x / length for x in start]
            exact = mpmath.odefun(slope, 0, start, tol=mpf("1e-15"), degree=12)(10)
            assert_allclose(s[0], [float(x) for x in exact], rtol=0, atol=budgets.spin_taylor)


def test_shapes_broadcast_and_numbers_are_rates():
    rates, poles = many(6)
    numbers = np.array([[r.star, r.satellites, r.geodetic, r.drift] for r in rates])
    found = spin_histories(SERIES, numbers.reshape(2, 3, 4), poles.reshape(2, 3, 3), TIMES, METHOD)
    same = spin_histories(SERIES, rates, poles, TIMES, METHOD)
    assert found.s.shape == (2, 3, 4, 3) and found.obliquity.shape == (2, 3, 4)
    assert found.s.tobytes() == same.s.tobytes()
    one = spin_histories(SERIES, rates[2], poles, polhode.SaveAt.steps(0, 4, 2), METHOD)
    assert one.s.shape == (6, 3, 3)
    assert (
        spin_histories(SERIES, rates[2], poles[2], TIMES, METHOD).s.tobytes() == same.s[2].tobytes()
    )
    assert spin_histories(SERIES, [], np.empty((0, 3)), TIMES, METHOD).s.shape == (0, 4, 3)


def test_a_body_that_fails_fails_alone():
    rates, poles = many(40)
    healthy = spin_histories(SERIES, rates, poles, TIMES, METHOD)
    poles[7, 1] = np.nan
    rates[20] = PrecessionRates(np.inf)
    with pytest.warns(RuntimeWarning, match="index 7, the first of 2 that failed: the run failed"):
        found = spin_histories(SERIES, rates, poles, TIMES, METHOD)
    assert list(found.failures) == [7, 20]
    assert "direction of length nan" in found.failures[7].advice and found.failures[7].t == 0.0
    assert "rates: got inf; expected finite rates" in found.failures[20].advice
    assert np.isnan(found.s[[7, 20]]).all()
    rest = np.delete(np.arange(40), [7, 20])
    assert found.s[rest].tobytes() == healthy.s[rest].tobytes()
    with pytest.warns(RuntimeWarning, match=r"index \(1, 1\), the first of 1"):
        found = spin_histories(SERIES, rates[0], poles[:9].reshape(3, 3, 3)[[0, 2, 1]], TIMES,
                               METHOD)  # fmt: skip
    assert list(found.failures) == [(1, 1)]


def test_a_table_that_ends_ends_all():
    orbit = polhode.secular.shipped_orbit("mars", year=1e-3)
    rates, poles = many(3)
    with pytest.warns(RuntimeWarning, match="does what it depends on end there"):
        found = spin_histories(orbit, rates, poles, [-10.0, -30.0], Splitting(5.0), epoch=0.0)
        late = spin_histories(
            orbit, rates, poles, [19990.0, 20010.0], Splitting(5.0), epoch=19980.0
        )
    assert found.failures == {} and list(late.failures) == [0, 1, 2]
    assert all(outcome.t == 20000.0 for outcome in late.failures.values())
    assert np.isfinite(late.s[:, 0]).all() and np.isnan(late.s[:, 1]).all()


def test_threads_change_nothing():
    rates, poles = many(64)
    whole = spin_histories(SERIES, rates, poles, TIMES, METHOD)
    with ThreadPoolExecutor(4) as pool:
        parts = pool.map(
            lambda k: spin_histories(SERIES, rates[k : k + 5], poles[k : k + 5], TIMES, METHOD).s,
            range(0, 64, 5),
        )
    assert np.concatenate(list(parts)).tobytes() == whole.s.tobytes()


def test_it_is_pickled_and_shown():
    rates, poles = many(3)
    poles[1] = 0.0
    with pytest.warns(RuntimeWarning, match="index 1"):
        found = spin_histories(SERIES, rates, poles, TIMES, METHOD)
    again = pickle.loads(pickle.dumps(found))
    assert again.s.tobytes() == found.s.tobytes() and again.t.tobytes() == found.t.tobytes()
    assert again.obliquity.tobytes() == found.obliquity.tobytes()
    assert again.failures[1].advice == found.failures[1].advice
    assert repr(again) == "<SpinHistories: (3, 4) samples; splitting order 8, step 2>"


@pytest.mark.parametrize("call, kind, what", [
    (lambda r, p: spin_histories(SERIES, r, p[:2], TIMES, METHOD), ValueError,
     "rates of shape .3,. and poles of shape"),
    (lambda r, p: spin_histories(SERIES, r, p, [], METHOD), ValueError, "got no times"),
    (lambda r, p: spin_histories(SERIES, r, p, [-1.0, 1.0], METHOD), ValueError,
     "got times -1 and 1, on two sides of the epoch 0"),
    (lambda r, p: spin_histories(SERIES, r, p, [0.0, 2.0, 1.0, 3.0], METHOD), ValueError,
     "spin_histories: got times 2 and 1, running towards the epoch 0"),
    (lambda r, p: spin_histories(SERIES, 3.0, p, TIMES, METHOD), TypeError, "rates: got a float"),
    (lambda r, p: spin_histories(SERIES, [*r, 1.0], p, TIMES, METHOD), TypeError, "at index 3"),
    (lambda r, p: spin_histories(SERIES, r, p, TIMES, polhode.Adaptive()), TypeError,
     "expected Splitting"),
    (lambda r, p: spin_histories(polhode.secular.shipped_orbit("mars"), r, p, TIMES, METHOD, 3e7),
     ValueError, "epoch: got 30000000.0; expected one that the table covers"),
])  # fmt: skip
def test_what_cannot_be_says_why(call, kind, what):
    with pytest.raises(kind, match=what):
        call(*many(3))
