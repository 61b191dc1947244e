# SPDX-License-Identifier: MIT
"""Fits of scenarios that observed light curves in Python: what the command line says, as objects;
the same residuals, curves and landscape as arrays; figures that take them; and Ctrl-C."""

import functools
import pathlib

import budgets
import matplotlib
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from interrupts import LATEST, seconds_from_signal

matplotlib.use("Agg")
from polhode import figures  # noqa: E402
from polhode.figures.pole_sky import pole_and_covariance  # noqa: E402

NIGHT = pathlib.Path(__file__).resolve().parents[2] / "examples/tumbling-night.toml"
NEARBY = {"fit.from": "start", "fit.starts": None, "fit.scan": None}


@pytest.fixture(scope="module")
def night():
    told = []
    found = polhode.fit.fit_scenario(
        NIGHT, starts=60, progress=lambda done, of: told.append((done, of))
    )
    return found, told


def test_a_night_has_four_poles(night):
    found, told = night
    # one start of each reading, and twice fifty of that which is near
    assert len(found) == 4 and found.starts == 160 and 0 < found.failed < 240
    assert [one.light.beside for one in found] == ["first", "image", "image", "image"]
    best = found[0]
    assert isinstance(best, polhode.fit.LightScenarioSolution)
    for number, truth in ((best.precession_period, 12.0), (best.rotation_period, 20.0),
                          (best.unknowns["b/a"], 0.6), (best.unknowns["c/b"], 0.75)):  # fmt: skip
        assert abs(number.value - truth) < 4 * number.error
        assert number.scaled_error == pytest.approx(best.error_factor * number.error)
    assert (best.precession_period.unit, best.unknowns["w_x"].unit) == ("min", "deg/min")
    errors = [best.unknowns[name].error for name in best.names]
    assert_allclose(np.sqrt(np.diag(best.covariance)), errors)
    assert_allclose(best.scaled_covariance, best.error_factor**2 * best.covariance)
    assert best.light.mode == "LAM" and best.light.names == best.names
    assert "P_phi" in found.text and "<LightScenarioSolution" in repr(best)
    assert "b/a" in found._repr_html_()
    # an estimate, which may fall where more solutions turn up than the starts promised
    assert told[-1] == (1000, 1000) and all(0 < done <= 1000 and of == 1000 for done, of in told)
    assert told[-1][0] == 1000


def test_curves_and_residuals_are_those_of_the_file(night):
    found, _ = night
    (curve,) = found.curves
    best = found[0]
    residuals = best.residuals
    assert_allclose(residuals["t"], curve.t)
    assert_allclose(residuals["flux"], curve.flux)
    (model,) = best.light.model(curve)
    assert_allclose(residuals["model"], model, rtol=budgets.fit_motion)
    assert_allclose(residuals["r"], (model - curve.flux) / curve.sigma, atol=budgets.fit_motion)
    assert_allclose(np.sum(residuals["r"] ** 2), best.chi_square, rtol=budgets.fit_freedom)


def test_the_scan_is_that_of_the_arrays(night):
    found, _ = night
    scan = found.scan
    step = scan.f1[1] - scan.f1[0]
    assert_allclose(1.0 / scan.f1[[0, -1]], [40.0, 5.0], rtol=step / scan.f1[0])
    again = polhode.light.fourier_scan(
        found.curves, (scan.f1[0], scan.f1[-1] + 0.5 * step, found.report["scan"]["step"]),
        order=2, minima=8,
    )  # fmt: skip
    assert_allclose(again.chi_square, scan.chi_square, rtol=budgets.fit_exact)
    assert scan.order == 2 and scan.points == 121
    assert [m.chi_square for m in scan.minima] == [
        m["chi_square"] for m in found.report["scan"]["minima"]
    ]
    assert scan.periods(pairs=1) == [
        (p["mode"], p["precession_period"], p["rotation_period"]) for p in found.report["periods"]
    ][: len(scan.periods(pairs=1))]


def test_a_solution_is_a_scenario_that_runs(night):
    found, _ = night
    best = found[0]
    assert best.scenario.text == best.text and "light.semiaxes" in best.text
    (again,) = polhode.fit.fit_scenario(best.scenario.replace(NEARBY))
    assert_allclose(again.chi_square, best.chi_square, rtol=budgets.fit_freedom)
    run = best.scenario.with_columns(["q"]).run()
    assert run.outcome.ok
    expected = best.state.free_rotation.at(np.array([run["t"][0], run["t"][-1]]))
    q = np.stack([run[name] for name in ("qw", "qx", "qy", "qz")], axis=1)[[0, -1]]
    assert_allclose(np.abs(np.sum(q * expected.q, axis=1)), 1.0, atol=budgets.fit_motion)


def test_residual_functions_begin_at_the_solution(night):
    best = night[0][0]
    f = best.residual_function()
    assert f.names == best.names and f.size == 121
    assert_allclose(f.log_likelihood(f.start), -0.5 * best.chi_square, rtol=budgets.fit_freedom)
    assert_allclose(f.state(f.start).shape, best.body.shape)
    core = np.array(best.report["covariance_core"])
    assert_allclose(np.sqrt(np.diag(f.covariance(f.start))), np.sqrt(np.diag(core)),
                    rtol=budgets.python_covariance)  # fmt: skip
    scaled = best.residual_function(scaled=True)
    assert_allclose(-2 * scaled.log_likelihood(f.start), best.degrees_of_freedom,
                    rtol=budgets.fit_freedom)  # fmt: skip
    with pytest.raises(ValueError, match="expected None: it is the middle of the light curves"):
        best.residual_function(epoch=3.0)


def test_a_start_nearby_and_any_number_of_threads():
    near = polhode.load(NIGHT).replace(NEARBY)
    found = polhode.fit.fit_scenario(near, threads=1)
    (one,) = found
    robust = polhode.fit.fit_scenario(near.replace({"fit.loss": "huber"}))
    (label,) = figures.pole_sky(robust).get_legend().get_texts()
    assert label.get_text() == f"1: loss {robust[0].light.cost:.4g}"
    assert found.scan is None and found.failed == 0 and one.converged
    assert abs(one.precession_period.value - 12.0) < 4 * one.precession_period.error
    assert one.unknowns["w_x"].start != one.unknowns["w_x"].value
    short = one.short_axis_period
    assert abs(short.value - 7.5) < 4 * short.error < 0.1 and one.describes_data
    assert list(one.predicted([0.0, 90.0])["t"]) == [0.0, 90.0]
    assert polhode.fit.fit_scenario(near, threads=2).text == found.text
    with pytest.raises(ValueError, match="threads: got 0"):
        polhode.fit.fit_scenario(near, threads=0)


def test_figures_take_them(night):
    found, _ = night
    axis = figures.pole_sky(found)
    assert len(axis.get_legend().get_texts()) == 4
    pole, covariance = pole_and_covariance(found[0])
    same, of_arrays = pole_and_covariance(found[0].light)
    assert_allclose(pole, same)
    assert_allclose(covariance, of_arrays)
    axes = figures.light_curve_fit(found.curves, found[0])
    assert axes.shape == (1, 2) and axes[0, 1].get_xlabel() == "$t$ (min)"
    assert figures.scan_landscape(found.scan, minima=2).get_xlabel() == "$f_2$ (1/min)"
    assert len(figures.body_as_seen(found[0], [0.0, 3.0], [1, 0.2, 0.3], [0.8, 0.6, 0.1])) == 2


# Of order 4, for which 121 points are enough: the next one is refused, and nothing goes on.
WIDE = {"fit.scan.order": 4, "fit.scan.shortest": 0.5}


def test_an_interrupt_ends_a_scan():
    done = []
    wide = polhode.load(NIGHT).replace(WIDE)
    call = functools.partial(
        polhode.fit.fit_scenario, wide, progress=lambda part, of: done.append(part)
    )
    assert seconds_from_signal(call) < LATEST
    assert all(part < 500 for part in done)  # of thousandths, half are the scan's


def test_an_interrupt_ends_a_search():
    done = [0]
    long = polhode.load(NIGHT).replace({"fit.starts": 1_000_000})
    call = functools.partial(
        polhode.fit.fit_scenario, long, progress=lambda part, of: done.append(part)
    )
    assert seconds_from_signal(call, lambda: done[-1] >= 500) < LATEST
    assert done[-1] < 1000


def test_an_order_that_the_points_do_not_determine_is_refused_at_once():
    wide = polhode.load(NIGHT).replace({**WIDE, "fit.scan.order": 5})
    with pytest.raises(polhode.ScenarioError, match="121 points do not determine 121 coefficients"):
        polhode.fit.fit_scenario(wide)
