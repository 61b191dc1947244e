# SPDX-License-Identifier: MIT
"""Draws from posteriors: where they are normal numbers exactly, Toutatis in 1992, bounds, and what
cannot be sampled."""

import os
import pathlib
import sys
import warnings

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest
from polhode._posterior import Unbounded
from polhode.fit import Snapshots, SpinResiduals, SpinState
from rejections import rejected

pytest.importorskip("mici")
pytest.importorskip("arviz_stats")

ROOT = pathlib.Path(__file__).resolve().parents[2]
FULL = bool(os.environ.get("POLHODE_TEST_FULL"))
STATE = SpinState([1.0, 0.0, 0.0, 0.0], [0.1, 0.2, 0.3], [1.0, 2.0, 2.5])
RATES = Snapshots(rates=([0.0, 0.0], [[0.11, 0.2, 0.31], [0.1, 0.21, 0.3]], [0.01, 0.02, 0.03]))


def quietly(function, *arguments, **keywords):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        return function(*arguments, **keywords)


def test_normal_numbers_have_the_covariance_that_they_have():
    """Two rates at the epoch: the posterior is the mean of both, its errors sigma / sqrt 2."""
    f = SpinResiduals(STATE, RATES, "rate")
    n = 1000 if FULL else 300
    draws = quietly(polhode.fit.posterior, f, draws=n, warm_up=100, chains=2, seed=1)
    sigma = np.array([0.01, 0.02, 0.03]) / np.sqrt(2.0)
    assert_allclose(draws.laplace_covariance, np.diag(sigma**2), atol=budgets.fit_line)
    # of 600 draws, errors of a mean and of a standard deviation are 4 and 3 % of sigma
    assert largest(np.abs(draws.mean - [0.105, 0.205, 0.305]) / sigma) < budgets.sampled_mean
    spread = np.sqrt(np.diag(draws.covariance))
    assert_allclose(spread / sigma, np.ones(3), atol=budgets.sampled_spread)
    assert largest(np.abs(draws.rhat - 1.0)) < budgets.sampled_rhat
    assert draws.divergences == 0 and (draws.ess > n / 4).all()
    assert draws.draws.shape == (2, n, 3) and draws["w_x"].shape == (2 * n,)
    assert draws.units["w_x"] == "rad/time"
    data = draws.to_xarray()
    assert data["w_y"].dims == ("chain", "draw") and data["lp"].shape == (2, n)
    assert "R-hat" in repr(draws) and "<table>" in draws._repr_html_()
    low, middle, high = draws.quantiles()
    assert (low < middle).all() and (middle < high).all()


def test_draws_do_not_depend_on_threads():
    f = SpinResiduals(STATE, RATES, "rate")
    found = [
        quietly(polhode.fit.posterior, f, draws=20, warm_up=20, chains=3, seed=2, threads=n)
        for n in (1, 3)
    ]
    assert found[0] == found[1]
    other = quietly(polhode.fit.posterior, f, draws=20, warm_up=20, chains=3, seed=3)
    assert not np.array_equal(other["w_x"], found[0]["w_x"])


def test_toutatis_of_1992():
    """With errors that fit the residuals the posterior is nearly normal; moments keep to the
    triangle."""
    (one,) = polhode.fit.fit_scenario(ROOT / "examples/toutatis-1992.toml").solutions
    n = 1000 if FULL else 150
    draws = quietly(one.sample, scaled=True, draws=n, warm_up=150, chains=2, seed=4, accept=0.95)
    x, y = draws["Ixx/Izz"], draws["Iyy/Izz"]
    assert (x + y > 1.0).all() and (np.abs(x - y) < 1.0).all()
    spread = np.sqrt(np.diag(draws.covariance) / np.diag(draws.laplace_covariance))
    assert_allclose(spread, np.ones(8), atol=budgets.sampled_toutatis)
    assert largest(draws.rhat) < (budgets.sampled_rhat_full if FULL else budgets.sampled_rhat_few)
    # its tail reaches the triangle, beyond which there is no body: small steps, as the advice says
    assert draws.divergences <= budgets.sampled_diverged * x.size
    assert np.isfinite(draws.log_density).all()


def test_too_few_draws_are_said():
    f = SpinResiduals(STATE, RATES, "rate")
    with pytest.warns(RuntimeWarning, match="effective sample size"):
        draws = polhode.fit.posterior(f, draws=20, warm_up=20, chains=2)
    assert not draws.converged and "more draws" in " ".join(draws.diagnosis)


def test_coordinates_without_bounds_are_one_to_one():
    t = np.linspace(0.0, 60.0, 10)
    q = STATE.free_rotation.at(t).q
    f = SpinResiduals(STATE, Snapshots(attitudes=(t, q, 0.01)))
    free = Unbounded(f)
    x = f.start
    x[6:] = 0.45, 0.7
    u = free.free(x)
    assert_allclose(free.unknowns(u), x, atol=budgets.numpy_formula)
    h = 1e-5
    slopes = np.array([
        (free.unknowns(u + h * e) - free.unknowns(u - h * e)) / (2 * h) for e in np.eye(len(x))
    ]).T
    assert_allclose(slopes, free.slopes(u), atol=budgets.unbounded_difference)
    volumes = [free.log_volume(u + h * e)[0] - free.log_volume(u - h * e)[0] for e in np.eye(8)]
    assert_allclose(np.array(volumes) / (2 * h), free.log_volume(u)[1],
                    atol=budgets.unbounded_difference)  # fmt: skip
    other = u + np.linspace(-1.0, 1.0, len(u))
    ratio = np.linalg.slogdet(free.slopes(other))[1] - np.linalg.slogdet(free.slopes(u))[1]
    assert_allclose(free.log_volume(other)[0] - free.log_volume(u)[0], ratio,
                    atol=budgets.numpy_formula)  # fmt: skip
    x[6:] = 0.4, 1.4  # on the triangle
    inside = free.inside(x)
    assert inside[7] - inside[6] < 1.0 and np.isfinite(free.free(inside)).all()


def test_what_the_data_do_not_say_is_refused():
    """One attitude tells nothing of the rate and the moments."""
    seen = Snapshots(attitudes=([0.0, 0.0, 0.0], [1, 0, 0, 0], 0.1))
    f = SpinResiduals(STATE, seen)
    rejected(ValueError, "do not determine all unknowns", polhode.fit.posterior, f)
    rejected(TypeError, "got 3; expected SpinResiduals", polhode.fit.posterior, 3)
    rejected(ValueError, "accept: got 2", polhode.fit.posterior, f, accept=2.0)


@pytest.mark.parametrize("package", ["mici", "arviz_stats"])
def test_without_the_sampler_it_says_how_to_get_it(package, monkeypatch):
    for name in [one for one in sys.modules if one.split(".")[0] == package]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(sys, "meta_path", [_Without(package), *sys.meta_path])
    with pytest.raises(ImportError, match=r"pip install polhode\[sample\]"):
        polhode.fit.posterior(SpinResiduals(STATE, RATES, "rate"))


class _Without:
    def __init__(self, package):
        self.package = package

    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] == self.package:
            raise ModuleNotFoundError(f"No module named '{self.package}'", name=self.package)


DRIVEN = """schema = 1
kind = "fit"
[units]
time = "h"
angle = "deg"
[body]
moments = [1, 2.2, 2.6]
[state.attitude-rate]
euler = { phi = 20, theta = 60, psi = 110 }
omega_body = [3, 4, 12]
[[perturbation]]
kind = "constant-torque"
torque = [0, 0, -0.05]
[[free.parameter]]
key = "perturbation[0].torque[2]"
low = -1
[time]
stop = 40
step = 2
[[observation]]
kind = "attitude"
file = "seen.csv"
times = "at-body"
sigma = 2
[free]
unknowns = ["attitude", "rate"]
[fit]
tolerance = 1e-9
"""


def test_a_torque_is_sampled(tmp_path):
    """With its bound, from a solution of a file; the posterior of a short arc is nearly normal."""
    path = tmp_path / "fit.toml"
    path.write_text(DRIVEN, encoding="utf-8")
    polhode.fit.simulate(path, tmp_path)
    (one,) = polhode.fit.fit_scenario(path)
    n = 600 if FULL else 100
    draws = quietly(one.sample, draws=n, warm_up=60, chains=1, seed=2)
    assert draws.draws.shape == (1, n, 7) and (draws["perturbation[0].torque[2]"] > -1.0).all()
    spread = np.sqrt(np.diag(draws.covariance) / np.diag(draws.laplace_covariance))
    assert_allclose(spread, np.ones(7), atol=budgets.sampled_torque)
    off = (draws.mean - one.residual_function().start) / np.sqrt(np.diag(draws.laplace_covariance))
    assert largest(np.abs(off)) < budgets.sampled_torque
