# SPDX-License-Identifier: MIT
"""Light curves in Python: a tumbler is found again from its scan, derivatives are those of the
residuals, threads change no bit."""

import budgets
import numpy as np
import pytest
from closeness import assert_allclose, largest
from interrupts import LATEST, seconds_from_signal
from polhode import light
from polhode.light import LightCurve, LightModel

# that of tests/unit/fit/light_fit.cpp
BODY = LightModel.homogeneous([0.6, 0.3, -0.5, 0.2], [0.6, 0.5, 1.0], [1.0, 0.85, 0.5])
SUN, OBSERVER = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
NOISE = 0.01


def night(body=BODY, count=90, turns=5.0, name="night", seed=4, noise=NOISE):
    motion = body.spin.free_rotation
    random = np.random.default_rng(seed)
    span = turns * 2.0 * np.pi / motion.precession_rate_long
    t = np.sort(random.uniform(0.0, span, count))
    blank = LightCurve(t, np.ones(count), 1.0, SUN, OBSERVER)
    (flux,) = light.model_fluxes(body, blank)
    flux *= 1.0 + noise * random.normal(size=count)
    return LightCurve(t, 3.0 * flux, 3.0 * noise * flux.mean(), SUN, OBSERVER, name=name)


def periods_of(body):
    motion = body.spin.free_rotation
    mode = {"short_axis": "SAM", "long_axis": "LAM"}[motion.regime.name]
    return mode, 2.0 * np.pi / motion.precession_rate_long, motion.polhode_period


CURVE = night()


def test_one_start_finds_the_body_near_it():
    spin = BODY.spin
    start = LightModel.homogeneous(spin.q, 1.001 * spin.w, [1.0, 0.83, 0.52])
    found = light.fit_light(start, CURVE)
    assert found.converged and found.names[:3] == ("turn_x", "turn_y", "turn_z")
    truth = [*spin.w, 0.85, 0.5 / 0.85]
    off = (found.values[3:] - truth) / found.errors[3:]
    assert largest(np.abs(off)) < budgets.python_fit_off
    mode, precession, rotation = periods_of(BODY)
    assert found.mode == mode
    assert_allclose(found.precession_period, precession, rtol=budgets.labelled_period)
    assert_allclose(found.rotation_period, rotation, rtol=budgets.labelled_period)
    (model,) = found.model(CURVE)
    chi_square = np.sum(((CURVE.flux - model) / CURVE.sigma) ** 2)
    assert_allclose(chi_square, found.chi_square, rtol=budgets.python_optimum)
    assert "P_phi" in repr(found) and "90 points, relative" in repr(CURVE)


def test_a_robust_fit_has_the_factors_of_its_loss():
    flux = CURVE.flux.copy()
    flux[[7, 30, 55]] *= 3.0
    bad = LightCurve(CURVE.t, flux, CURVE.sigma, CURVE.to_sun, CURVE.to_observer)
    loss = ("cauchy", 3.0)
    clean, found = light.fit_light(BODY, CURVE), light.fit_light(BODY, bad, loss=loss)
    assert found.converged and found.loss == loss and clean.loss == ("squared", 1.0)
    assert_allclose(clean.cost, clean.chi_square, rtol=budgets.python_optimum)
    # the bad points are all of chi-square, and do not scale errors
    assert found.chi_square > 100 * found.degrees_of_freedom and found.error_scale < 1.5
    (model,) = found.model(bad)
    r2 = ((bad.flux - model) / bad.sigma) ** 2
    assert_allclose(np.sum(9.0 * np.log1p(r2 / 9.0)), found.cost, rtol=budgets.python_optimum)
    (same,) = light.model_fluxes(found.body, bad, loss)
    assert same.tobytes() == model.tobytes()
    # the factor of the true body, over that of the clean curve, in its error
    (true,) = light.model_fluxes(BODY, CURVE)
    (robust,), (squares,) = (
        light.model_fluxes(BODY, bad, kind) for kind in (loss, "squared")
    )
    error = 1.0 / np.sqrt(np.sum((true / CURVE.sigma) ** 2))
    assert abs(robust[0] / true[0] - 1.0) < error
    assert squares[0] / true[0] - 1.0 > 30.0 * error
    search = light.search_light(bad, [periods_of(BODY)], starts=6, finalists=1, loss=loss)
    assert f"0: loss {search.solutions[0].cost:.5g}, " in repr(search)


@pytest.mark.parametrize("keys, budget", [
    ({}, budgets.python_residual_difference),
    ({"moments": "fit"}, budgets.python_residual_difference),
    ({"loss": ("soft_l1", 0.7)}, budgets.python_residual_difference),
    # Lambert's law and its gradient are quadratures, each with its own error
    ({"moments": "fit", "multiple": True}, budgets.python_lambert),
])
def test_derivatives_are_those_of_the_residuals(keys, budget):
    f = light.LightResiduals(BODY, [CURVE, night(count=40, seed=5)], **keys)
    x = f.start
    J = f.jacobian(x)
    assert J.shape == (130, len(f.names))
    for k in range(len(x)):
        h = 3e-5 if k > 5 or k < 3 else 1e-5
        e = np.eye(len(x))[k] * h
        r = [f.residuals(x + m * e) for m in (1, -1, 2, -2)]
        slope = (8.0 * (r[0] - r[1]) - (r[2] - r[3])) / (12.0 * h)
        size = np.abs(J[:, k]).max()
        assert_allclose(slope / size, J[:, k] / size, atol=budget)
    gradient = f.log_likelihood_gradient(x)
    assert_allclose(gradient, -J.T @ f.residuals(x), rtol=budgets.numpy_random)
    assert f.state(x).shape[0] == 1.0


def test_a_search_finds_the_body_on_any_threads():
    periods = [periods_of(BODY)]
    found = [
        light.search_light(CURVE, periods, starts=20, finalists=2, threads=n, seed=1)
        for n in (1, 3)
    ]
    best, same = (one.solutions[0] for one in found)
    assert best.values.tobytes() == same.values.tobytes()
    assert best.chi_square == same.chi_square and repr(found[0]) == repr(found[1])
    assert best.converged and best.beside == "first"
    assert_allclose(sorted(best.body.shape), [0.5, 0.85, 1.0], atol=budgets.python_axes)
    images = [one for one in found[0].solutions if one.beside == "image"]
    assert images and all(one.relation for one in images)  # one night: four poles


def test_a_scan_has_a_minimum_at_lines_of_the_motion():
    mode, precession, rotation = periods_of(BODY)
    curve = night(count=150, turns=8.0)
    advice = light.scan_advice(curve, 2)
    step = advice.step
    # in short-axis mode lines are at j f_phi + k f_psi with j + k even
    f1, f2 = 1.0 / precession + 1.0 / rotation, 2.0 / precession
    grids = [(f - 6.0 * step, f + 6.0 * step, step) for f in (f1, f2)]
    scans = [light.fourier_scan(curve, *grids, order=2, threads=n) for n in (1, 2)]
    assert scans[0].chi_square.tobytes() == scans[1].chi_square.tobytes()
    scan = scans[0]
    assert scan.chi_square.shape == (len(scan.f1), len(scan.f2))
    best = scan.minima[0]
    for found, sigma, true in ((best.f1, best.sigma_f1, f1), (best.f2, best.sigma_f2, f2)):
        scale = np.sqrt(best.chi_square / best.degrees_of_freedom)
        assert abs(found - true) < budgets.scanned_frequency * sigma * largest(1.0, scale)
    assert scan.to_xarray().sizes == {"f1": len(scan.f1), "f2": len(scan.f2)}
    labels = light.period_labels(best.f1, best.f2)
    near = [
        label for label in labels if label.mode == mode
        and abs(label.precession_period / precession - 1.0) < budgets.labelled_period
        and abs(label.rotation_period / rotation - 1.0) < budgets.labelled_period
    ]  # fmt: skip
    assert near and near[0].of_ellipsoid
    listed = scan.periods(pairs=1)
    assert any(m == mode and abs(p / precession - 1.0) < budgets.labelled_period
               for m, p, _ in listed)  # fmt: skip
    assert "FourierScan" in repr(scan)


@pytest.mark.parametrize(
    "call, said",
    [
        (lambda: LightCurve([0.0, 1.0], [1.0], 0.1), r"flux: got shape \(1,\)"),
        (lambda: LightCurve([0.0, 1.0], [1.0, 2.0], [0.1, 0.1, 0.1]), "sigma: got shape"),
        (lambda: light.fit_light(BODY, 3), "not iterable"),
        (lambda: light.fit_light(BODY, [3]), "got 3; expected LightCurve"),
        (lambda: light.fit_light(3, CURVE), "got 3; expected LightModel"),
        (lambda: light.fit_light(BODY, CURVE, moments="own"), "moments: got 'own'"),
        (lambda: light.search_light(CURVE, []), "periods"),
        (lambda: light.search_light(CURVE, [("SAM", 1.0, -2.0)]), "-2"),
        (lambda: light.search_light(CURVE, [("XAM", 1.0, 2.0)]), "periods: got 'XAM'"),
        (lambda: light.fourier_scan(CURVE, (1.0, 0.5, 0.1)), "must rise"),
        (lambda: light.fourier_scan(CURVE, (1.0,)), r"f1: got \(1.0,\)"),
        (lambda: light.fourier_scan(CURVE, threads=0), "threads: got 0"),
        (lambda: light.period_labels(0.0, 1.0), "positive"),
        (lambda: light.fit_light(
            BODY, LightCurve([0, 1], [1, 1], 0.1)
        ), "vector|to_sun|Sun"),
    ],
)  # fmt: skip
def test_what_is_no_fit_is_refused(call, said):
    with pytest.raises((ValueError, TypeError), match=said):
        call()


def test_ctrl_c_ends_a_search_and_a_scan():
    calls = (lambda: light.search_light(CURVE, [periods_of(BODY)], starts=1_000_000),
             lambda: light.fourier_scan(CURVE, (0.01, 9.0, 4e-3), order=3, threads=2))
    for call in calls:
        assert seconds_from_signal(call) < LATEST
