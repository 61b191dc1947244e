# SPDX-License-Identifier: MIT
"""Fits of scenarios and of arrays in Python: Toutatis in 1992, what was simulated and is found
again, residuals with their derivatives for another optimiser, and what a fit refuses."""

import copy
import json
import pathlib
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest
from polhode import Scenario
from polhode.fit import SpinState
from rejections import rejected
from scipy.optimize import least_squares

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOUTATIS = ROOT / "examples/toutatis-1992.toml"
TRUTH = SpinState([0.6, 0.3, -0.5, 0.2], [0.06, 0.07, 0.21], np.diag([1.0, 2.2, 2.6]))
TIMES = np.linspace(0.0, 60.0, 25)
SIGMA = 0.03
TUMBLER = """schema = 1
kind = "fit"
[units]
time = "h"
angle = "deg"
[body]
moments = [1, 2.2, 2.6]
[state.attitude-rate]
euler = { phi = 20, theta = 60, psi = 110 }
omega_body = [3, 4, 12]
[time]
stop = 60
step = 1.5
[[observation]]
kind = "attitude"
file = "seen.csv"
times = "at-body"
sigma = 2
[free]
unknowns = ["attitude", "rate", "moments"]
"""


def seen_of(state, noise=0.0, seed=3):
    """Attitudes and rates of a motion, with normal errors about the body axes."""
    motion = state.free_rotation
    rotor = motion.at(TIMES)
    random = np.random.default_rng(seed)
    half = 0.5 * noise * random.normal(size=(len(TIMES), 3))
    small = np.column_stack([np.sqrt(1.0 - np.sum(half**2, axis=1)), half])
    w, x, y, z = rotor.q.T
    a, b, c, d = small.T
    q = np.column_stack([w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c,
                         w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a])  # fmt: skip
    return polhode.fit.Snapshots(attitudes=(TIMES, q, noise or SIGMA))


DRIVEN = """
[[perturbation]]
kind = "constant-torque"
torque = [0.02, 0, -0.05]
[[free.parameter]]
key = "perturbation[0].torque[2]"
[[free.jump]]
kind = "rate"
t = 30
change = [0.5, -1, 2]
"""


@pytest.fixture(scope="module")
def toutatis():
    return polhode.fit.fit_scenario(TOUTATIS)


def test_toutatis_of_1992(toutatis):
    """An independent fit: 4.1 deg rms, chi-square 3.8 on 43 degrees of freedom, moments 2.98 and
    3.22 with raw errors 0.64 and 0.76, scaled 0.19 and 0.23."""
    (one,) = toutatis.solutions
    assert one.converged and len(toutatis) == 1 and toutatis[0] is one
    assert round(one.chi_square, 1) == 3.8
    assert one.degrees_of_freedom == pytest.approx(43, abs=budgets.fit_freedom)
    x, y = one.unknowns["Ixx/Izz"], one.unknowns["Iyy/Izz"]
    assert_allclose([x.value, y.value], [2.98, 3.22], atol=budgets.toutatis_free)
    assert_allclose([x.error, y.error], [0.64, 0.76], atol=budgets.toutatis_free)
    assert_allclose([x.scaled_error, y.scaled_error], [0.19, 0.23], atol=budgets.toutatis_free)
    assert (x.unit, one.unknowns["w_x"].unit, one.unknowns["turn_z"].unit) == ("1", "deg/d", "deg")
    errors = [one.unknowns[name].error for name in one.names]
    assert_allclose(np.sqrt(np.diag(one.covariance)), errors)
    scaled = [one.unknowns[name].scaled_error for name in one.names]
    assert_allclose(np.sqrt(np.diag(one.scaled_covariance)), scaled)
    assert_allclose(np.diag(one.correlations), np.ones(len(one.names)))


def test_residuals_are_those_of_the_file(toutatis, tmp_path):
    (one,) = toutatis.solutions
    residuals = one.residuals
    assert len(residuals["t"]) == 17 and residuals.units["turn_x"] == "deg"
    turns = np.stack([residuals[f"turn_{k}"] for k in "xyz"])
    rms = np.sqrt(np.mean(turns**2))
    assert_allclose(rms, 4.1, atol=budgets.toutatis_rms)
    r = np.stack([residuals[f"r{k}"] for k in (1, 2, 3)])
    assert_allclose(np.sum(r**2), one.chi_square, rtol=budgets.fit_freedom)
    data = residuals.to_xarray()
    assert data["turn_x"].attrs["units"] == "deg" and data.sizes["t"] == 17
    assert "table 1: attitude, Goldstone" in residuals.notes


def test_predictions_have_times_and_errors(toutatis):
    """Of the state of the solution in free rotation; errors at t = 0 are those of the turns, and
    grow."""
    (one,) = toutatis.solutions
    ahead = one.predicted([0.0, 45.0])
    assert ahead.units["error_x"] == "deg" and list(ahead["t"]) == [0.0, 45.0]
    errors = [one.unknowns[f"turn_{k}"] for k in "xyz"]
    assert_allclose([ahead[f"error_{k}"][0] for k in "xyz"], [e.error for e in errors])
    assert_allclose([ahead[f"scaled_error_{k}"][0] for k in "xyz"],
                    [e.scaled_error for e in errors])  # fmt: skip
    assert_allclose(ahead.covariance[0], one.covariance[:3, :3])
    motion = one.state.free_rotation
    assert_allclose(np.abs(np.sum(ahead.q * motion.at([0.0, 45.0]).q, axis=1)), np.ones(2))
    assert (np.diag(ahead.scaled_covariance[1]) > np.diag(ahead.scaled_covariance[0])).any()
    (dated,) = one.predicted("1992-12-24T17:49:47 UTC")["t"]
    assert_allclose(dated, 45.0)
    assert len(one.predicted()["t"]) == 181 and "FitPredictions" in repr(ahead)
    for wrong in ("soon", "1992-13-01", [np.nan], []):
        rejected(ValueError, "expected a time|none", one.predicted, wrong)


def test_fits_pickle_as_what_they_are_made_of(toutatis):
    """Results and solutions by their scenario, fits of arrays by their arrays, residual functions
    by either; the same bits come out, and copies are what they are of."""
    again = pickle.loads(pickle.dumps(toutatis))
    assert again.report == toutatis.report and again.text == toutatis.text
    one = pickle.loads(pickle.dumps(toutatis[0]))
    assert one.report == toutatis[0].report and one.residuals == toutatis[0].residuals
    f = toutatis[0].residual_function(scaled=True)
    g = pickle.loads(pickle.dumps(f))
    assert np.array_equal(f.residuals(f.start), g.residuals(f.start)) and g.data == f.data
    seen = seen_of(TRUTH, SIGMA)
    found = polhode.fit.fit_spin(TRUTH, seen, priors={"Ixx/Izz": (0.4, 0.1)})
    same = pickle.loads(pickle.dumps(found))
    assert np.array_equal(same.values, found.values)
    assert np.array_equal(same.covariance, found.covariance)
    assert all(map(np.array_equal, same.predicted([70.0]), found.predicted([70.0])))
    h = polhode.fit.SpinResiduals(TRUTH, seen, ["attitude", "rate"], loss=("huber", 2.0))
    k = pickle.loads(pickle.dumps(h))
    assert np.array_equal(h.jacobian(h.start), k.jacobian(h.start)) and k.names == h.names
    bare = polhode.fit.SpinResiduals._of(h._compiled)
    rejected(TypeError, "not made of arrays or a scenario", pickle.dumps, bare)
    for whole in (toutatis, toutatis[0], found, f, h):
        assert copy.copy(whole) is whole and copy.deepcopy(whole) is whole


def test_a_solution_is_a_scenario_that_runs(toutatis):
    (one,) = toutatis.solutions
    assert one.scenario.text == one.text and 'kind = "fit"' not in one.text
    run = one.scenario.with_columns(["q", "g"]).run()
    assert run.outcome.ok
    state = one.state
    assert_allclose(one.scenario.body.moments / one.scenario.body.moments[2],
                    np.diag(state.inertia) / state.inertia[2, 2])  # fmt: skip
    assert_allclose(np.abs(run.states.q[0] @ state.q), 1.0)


def test_results_are_shown(toutatis):
    (one,) = toutatis.solutions
    assert repr(toutatis).startswith("<FitResults: Toutatis in December 1992: 1 solutions of 1")
    assert "Ixx/Izz 2.977859 +- 0.641 (scaled 2.977859 +- 0.191)" in repr(one)
    assert str(toutatis) == toutatis.text and "4.1" in toutatis.text
    assert "<th" in toutatis._repr_html_() and "Ixx/Izz" in toutatis._repr_html_()
    assert toutatis.report["solutions"][0]["chi_square"] == one.chi_square
    json.dumps(one.report)


def test_what_is_simulated_is_found_again(tmp_path):
    path = tmp_path / "fit.toml"
    path.write_text(TUMBLER, encoding="utf-8")
    (written,) = polhode.fit.simulate(path, tmp_path)
    assert pathlib.Path(written) == tmp_path / "seen.csv"
    rejected(ValueError, "seen.csv", polhode.fit.simulate, path, tmp_path)
    polhode.fit.simulate(Scenario.from_text(TUMBLER), tmp_path, overwrite=True)
    told = []
    found = polhode.fit.fit_scenario(path, progress=lambda done, of: told.append((done, of)))
    assert told == [(1, 1)]
    truth = np.array([1.0 / 2.6, 2.2 / 2.6, 3.0, 4.0, 12.0])
    names = ["Ixx/Izz", "Iyy/Izz", "w_x", "w_y", "w_z"]
    unknowns = found[0].unknowns
    off = np.array([(unknowns[n].value - x) / unknowns[n].error for n, x in zip(names, truth)])
    assert largest(np.abs(off)) < budgets.python_fit_off
    again = polhode.fit.fit_scenario(path, starts=2, seed=5)
    assert again.starts == 2
    assert_allclose(again[0].chi_square, found[0].chi_square, rtol=budgets.fit_exact)


def test_torques_and_jumps_are_unknowns(tmp_path):
    path = tmp_path / "driven.toml"
    path.write_text(TUMBLER + DRIVEN, encoding="utf-8")
    polhode.fit.simulate(path, tmp_path)
    found = polhode.fit.fit_scenario(path)
    (one,) = found
    assert one.names[8:] == ("perturbation[0].torque[2]", *(f"jump[0].change[{k}]" for k in "012"))
    truth = [-0.05, 0.5, -1.0, 2.0]
    for name, value in zip(one.names[8:], truth):
        assert abs(one.unknowns[name].value - value) < budgets.python_fit_off * (
            one.unknowns[name].error)
    assert one.unknowns["jump[0].change[1]"].unit == "deg/h"
    errors = [one.unknowns[name].error for name in one.names]
    assert_allclose(np.sqrt(np.diag(one.covariance)), errors)
    assert_allclose(np.sqrt(np.diag(one.scaled_covariance)),
                    [one.unknowns[name].scaled_error for name in one.names])
    assert "free" not in one.text and one.scenario.with_columns(["q"]).run().outcome.ok
    assert len(one.residuals["t"]) == 41 and found.curves == [] and found.scan is None
    assert_driven_residuals(one)


def assert_driven_residuals(one):
    """Those of data square to chi-square; derivatives are those of differences; another optimiser
    ends where the fit did."""
    f = one.residual_function()
    assert f.names == one.names and f.data == f.size == 123 and f.state(f.start).t0 == 30.0
    r, J = f.residuals_and_jacobian(f.start)
    assert_allclose(np.sum(r**2), one.chi_square, rtol=budgets.python_residual_difference)
    for k in (1, 4, 7, 8, 10):
        step = 1e-3 * np.sqrt(f.covariance(f.start)[k, k]) * np.eye(f.start.size)[k]
        by = (f.residuals(f.start + step) - f.residuals(f.start - step)) / (2.0 * step[k])
        size = largest(np.abs(J[:, k]))
        assert largest(np.abs(by - J[:, k])) < budgets.python_residual_difference * size
    off = f.start + 0.5 * np.sqrt(np.diag(f.covariance(f.start)))
    theirs = least_squares(f.residuals, off, f.jacobian, x_scale="jac")
    near = np.abs(theirs.x - f.start) / np.sqrt(np.diag(f.covariance(f.start)))
    assert largest(near) < budgets.python_optimum
    again = pickle.loads(pickle.dumps(f))
    assert np.array_equal(again.residuals(off), f.residuals(off)) and again.names == f.names


def test_what_progress_raises_ends_a_fit(tmp_path):
    path = tmp_path / "fit.toml"
    path.write_text(TUMBLER, encoding="utf-8")
    polhode.fit.simulate(path, tmp_path)

    def stop(done, of):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        polhode.fit.fit_scenario(path, starts=1000, progress=stop)


def test_exact_attitudes_give_the_state():
    start = SpinState(TRUTH.q, 1.002 * TRUTH.w, np.diag([1.02, 2.15, 2.6]))
    found = polhode.fit.fit_spin(start, seen_of(TRUTH))
    assert found.converged and found.chi_square < budgets.fit_exact
    assert_allclose(found.state.w, TRUTH.w, atol=budgets.fit_exact)
    assert_allclose(found.state.inertia / found.state.inertia[2, 2], TRUTH.inertia / 2.6,
                    atol=budgets.fit_exact)  # fmt: skip
    q, w, covariance = found.predicted([0.0, 100.0])
    expected = TRUTH.free_rotation.at([0.0, 100.0])
    assert_allclose(np.abs(np.sum(q * expected.q, axis=1)), 1.0, atol=budgets.fit_exact)
    assert covariance.shape == (2, 3, 3) and w.shape == (2, 3)
    assert "Ixx/Izz" in repr(found)


def test_a_body_and_its_axes_are_a_start():
    tensor = [[2.0, 0.1, 0.0], [0.1, 2.5, 0.2], [0.0, 0.2, 1.2]]
    body = polhode.Body.from_tensor(tensor)
    state = SpinState([1, 0, 0, 0], [0.1, 0.2, 0.3], body)
    assert_allclose(state.inertia, tensor, atol=budgets.fit_motion)
    motion = state.free_rotation
    momentum = polhode.charts.inertial_momentum(motion.at(0.0))
    assert_allclose(momentum, np.array(tensor) @ [0.1, 0.2, 0.3], atol=budgets.fit_motion)


def test_another_optimiser_finds_the_same():
    seen = seen_of(TRUTH, SIGMA)
    start = SpinState(TRUTH.q, 1.001 * TRUTH.w, TRUTH.inertia)
    prior = {"Ixx/Izz": (0.4, 0.1), ("w_x", "w_y"): (TRUTH.w[:2], 1e-2 * np.eye(2))}
    found = polhode.fit.fit_spin(start, seen, priors=prior)
    f = polhode.fit.SpinResiduals(start, seen, priors=prior)
    assert f.names == found.names and f.data == seen.size == 75 and f.size == 78
    theirs = least_squares(f.residuals, f.start, f.jacobian, bounds=f.bounds, x_scale="jac")
    sizes = found.errors
    ours = np.concatenate([theirs.x[:3], found.values[3:]])  # turns are about the start there
    assert_allclose(theirs.x[3:] / sizes[3:], ours[3:] / sizes[3:], atol=budgets.python_optimum)
    assert_allclose(f.log_likelihood(theirs.x), -0.5 * found.chi_square,
                    rtol=budgets.python_optimum)  # fmt: skip
    state = f.state(theirs.x)
    assert_allclose(np.abs(state.q @ found.state.q), 1.0, atol=budgets.python_optimum)
    assert_allclose(f.covariance(theirs.x)[3:, 3:], found.covariance[3:, 3:],
                    rtol=budgets.python_covariance)  # fmt: skip


def differences(function, x, h):
    """Of fourth order."""
    columns = []
    for k, step in enumerate(h):
        e = np.zeros(len(x))
        e[k] = step
        columns.append((8.0 * (np.asarray(function(x + e)) - function(x - e))
                        - (np.asarray(function(x + 2 * e)) - function(x - 2 * e))) / (12.0 * step))
    return np.array(columns).T  # fmt: skip


@pytest.mark.parametrize("loss", ["squared", ("cauchy", 1.5)])
def test_derivatives_are_those_of_the_residuals(loss):
    prior = {"Iyy/Izz": (0.8, 0.1)}
    f = polhode.fit.SpinResiduals(TRUTH, seen_of(TRUTH, SIGMA), priors=prior, loss=loss)
    x = f.start + np.array([0.01, -0.02, 0.015, 1e-4, -2e-4, 1e-4, 0.01, -0.01])
    h = np.array([1e-3, 1e-3, 1e-3, 1e-5, 1e-5, 1e-5, 1e-4, 1e-4])
    J = f.jacobian(x)
    sizes = np.abs(J).max(axis=0)
    assert_allclose(J / sizes, differences(f.residuals, x, h) / sizes,
                    atol=budgets.python_residual_difference)  # fmt: skip
    for value, gradient in ((f.log_likelihood, f.log_likelihood_gradient),
                            (f.log_posterior, f.log_posterior_gradient)):  # fmt: skip
        slope = gradient(x)
        assert_allclose(differences(value, x, h) * h, slope * h,
                        atol=budgets.python_residual_difference * np.abs(slope * h).max())


def test_all_rotations_are_alike_before_data():
    """Of the rotation vector v, |v| = a, the volume of rotations is (sin(a/2) / (a/2))^2 d3v."""
    seen = polhode.fit.Snapshots(rates=([0.0], [[0.1, 0.2, 0.3]], 1.0))
    f = polhode.fit.SpinResiduals(TRUTH, seen, ["attitude"],
                              attitude_prior=(TRUTH.q, 1e3))  # fmt: skip
    for v in ([0.3, -0.2, 0.4], [1.5, 1.0, -2.0], [1e-5, 0.0, 2e-5]):
        a = np.linalg.norm(v)
        r = f.residuals(v)
        said = f.log_posterior(v) + 0.5 * r @ r
        assert_allclose(said, 2.0 * np.log(np.sin(a / 2) / (a / 2)), atol=budgets.fit_rotation)
        step = 1e-3 * np.ones(3)
        assert_allclose(differences(f.log_posterior, np.array(v), step),
                        f.log_posterior_gradient(v), atol=budgets.python_residual_difference)
    assert f.log_posterior([3.2, 0.0, 0.0]) == -np.inf  # fmt: skip


def test_where_there_is_no_body_there_are_no_residuals():
    f = polhode.fit.SpinResiduals(TRUTH, seen_of(TRUTH, SIGMA))
    x = f.start
    x[6:] = 3.0, 0.5
    assert np.isnan(f.residuals(x)).all() and np.isnan(f.jacobian(x)).all()
    assert f.log_likelihood(x) == f.log_posterior(x) == -np.inf


@pytest.mark.parametrize(
    "call, said",
    [
        (lambda: polhode.fit.fit_scenario(TUMBLER.replace('kind = "fit"\n', "")),
            "No such file|too long"),
        (lambda: polhode.fit.fit_scenario(Scenario.from_text(TUMBLER.split("[[obs")[0].replace(
            'kind = "fit"\n', ""))), "kind"),
        (lambda: polhode.fit.fit_scenario(3), "got 3; expected a Scenario or a path"),
        (lambda: polhode.fit.fit_scenario(TOUTATIS, starts=0),
            "starts: got 0; expected a whole number from 1"),
        (lambda: polhode.fit.fit_spin(TRUTH, 3), "got 3; expected Snapshots"),
        (lambda: polhode.fit.fit_spin(TRUTH, polhode.fit.Snapshots()), "as many|at least"),
        (lambda: polhode.fit.fit_spin(TRUTH, seen_of(TRUTH), "pole"), "unknowns: got 'pole'"),
        (lambda: polhode.fit.fit_spin(TRUTH, seen_of(TRUTH), loss="cube"), "loss: got 'cube'"),
        (lambda: polhode.fit.fit_spin(TRUTH, seen_of(TRUTH), priors={"b/a": (1, 1)}), "b/a"),
        (lambda: polhode.fit.Snapshots(attitudes=([0.0], [[1, 0, 0]], 1.0)), r"expected \(4,\)"),
        (lambda: polhode.fit.Snapshots(attitudes=([0.0], [1, 0, 0, 0])), "expected .times, quat"),
        (lambda: polhode.fit.Snapshots(
            rates=([0.0], [[1, 0, 0]], [1, 2])
        ), "rates: sigma: got shape"),
        (lambda: SpinState([1, 0, 0], [0, 0, 1], [1, 1, 1]), r"q: got shape \(3,\)"),
        (lambda: polhode.fit.fit_spin(TRUTH, polhode.fit.Snapshots(
            attitudes=(TIMES, [1, 0, 0, 0], 0.0))), "positive"),
        (lambda: polhode.fit.SpinResiduals(TRUTH, seen_of(TRUTH)).residuals([1.0]), r"x"),
    ],
)  # fmt: skip
def test_what_is_no_fit_is_refused(call, said):
    rejected((ValueError, TypeError, OSError), said, call)
