# SPDX-License-Identifier: MIT
"""Convex bodies and given meshes as functions of their unknowns, for optimisers and samplers: the
numbers and derivatives of the fits, from solutions on, of arrays and of scenarios."""

import pathlib
import warnings

import budgets
import fit_calls
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest, smallest
from polhode.light import LightResiduals

ROOT = pathlib.Path(__file__).resolve().parents[2]
NIGHT = ROOT / "examples/tumbling-night.toml"
NEARBY = {"fit.from": "start", "fit.starts": None, "fit.scan": None}
SUN, OBSERVER = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
SMALL = {"degree": 2, "rows": 3}


def quietly(function, *arguments, **keywords):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        return function(*arguments, **keywords)


def seen(body, count=70, noise=0.01, seed=6):
    random = np.random.default_rng(seed)
    t = np.linspace(0.0, 40.0, count)
    (flux,) = polhode.light.model_fluxes(
        body, polhode.light.LightCurve(t, np.ones(count), 1.0, SUN, OBSERVER)
    )
    sigma = noise * flux.mean()
    return polhode.light.LightCurve(
        t, flux + sigma * random.normal(size=count), sigma, SUN, OBSERVER
    )


def slopes(f, x, k, step):
    """Fourth-order differences by unknown k."""
    e = step * np.eye(len(x))[k]
    r = [f.residuals(x + m * e) for m in (1, -1, 2, -2)]
    return (8.0 * (r[0] - r[1]) - (r[2] - r[3])) / (12.0 * step)


@pytest.fixture(scope="module")
def convex():
    curve = seen(fit_calls.BODY)
    return polhode.light.fit_light(fit_calls.BODY.convex(**SMALL), curve), curve


@pytest.fixture(scope="module")
def mesh():
    truth = polhode.light.LightModel.homogeneous(
        [0.9, 0.1, 0.3, 0.2], [0.4, 0.5, 1.0], fit_calls.TETRAHEDRON
    )
    curve = seen(truth)
    found = polhode.light.fit_light(truth, curve)
    assert found.converged
    return found, curve


def test_a_convex_body_begins_at_what_was_found(convex):
    found, curve = convex
    assert found.converged
    f = LightResiduals(found.body, curve, about=fit_calls.BODY)
    assert f.names == found.names and len(f.names) == 8 + 8
    # after the data closure, products, roughness, and the two ratios of moments
    assert (f.data, f.size) == (70, 70 + 6 + 8 + 2)
    assert_allclose(-2.0 * f.log_likelihood(f.start), found.chi_square, rtol=budgets.fit_freedom)
    assert_allclose(f.residuals(f.start)[:84], found.residuals, atol=budgets.fit_line)
    assert_allclose(np.sqrt(np.diag(f.covariance(f.start))), found.errors,
                    rtol=budgets.python_covariance)  # fmt: skip
    slope = f.log_posterior_gradient(f.start) * found.errors
    assert largest(np.abs(slope)) < budgets.python_optimum
    same = f.state(f.start)
    assert same.kind == "convex" and (same.shape.degree, same.shape.rows) == (2, 3)
    assert np.array_equal(same.shape.coefficients, found.body.shape.coefficients)
    # at the ellipsoid of the start without a body, with the same numbers at the same body
    g = LightResiduals(fit_calls.BODY.convex(**SMALL), curve)
    assert_allclose(g.state(g.start).spin.w, fit_calls.BODY.spin.w)
    assert_allclose(g.residuals(g.start)[76:], 0.0, atol=budgets.fit_line)
    x = g.start
    x[3:] = f.start[3:]
    state = polhode.fit.SpinState(found.body.spin.q, fit_calls.BODY.spin.w,
                              fit_calls.BODY.spin.inertia)  # fmt: skip
    there = polhode.light.LightModel(state, fit_calls.BODY.shape).convex(**SMALL)
    turned = LightResiduals(there, curve)
    assert_allclose(turned.residuals(x), f.residuals(f.start), atol=budgets.fit_line)


@pytest.mark.parametrize("keys", [{"moments": "start"}, {"moments": "fit", "multiple": True}])
def test_convex_derivatives_are_those_of_the_residuals(convex, keys):
    found, curve = convex
    f = LightResiduals(found.body, curve, about=fit_calls.BODY, **keys)
    x = f.start
    J = f.jacobian(x)
    for k in range(len(x)):
        size = largest(np.abs(J[:, k]))
        off = np.abs(slopes(f, x, k, 1e-4) - J[:, k])
        assert largest(off) < budgets.python_residual_difference * size, f.names[k]
    value, gradient = f.log_posterior_and_gradient(x)
    assert_allclose(gradient, -J.T @ f.residuals(x), rtol=budgets.numpy_random)
    assert np.isfinite(value)


def test_a_fit_of_a_convex_body_goes_on(convex):
    """One iteration and then the rest are as good as all at once."""
    found, curve = convex
    first = polhode.light.fit_light(fit_calls.BODY.convex(**SMALL), curve, most_iterations=1)
    assert not first.converged
    then = polhode.light.fit_light(first.body, curve, about=fit_calls.BODY)
    assert then.converged and len(then.body.shape.coefficients) == 9
    assert_allclose(then.chi_square, found.chi_square, rtol=budgets.python_optimum)


def test_a_mesh_begins_at_what_was_found(mesh):
    found, curve = mesh
    f = LightResiduals(found.body, curve)
    assert f.names == found.names == ("turn_x", "turn_y", "turn_z", "w_x", "w_y", "w_z")
    assert f.data == f.size == 70
    assert_allclose(-2.0 * f.log_likelihood(f.start), found.chi_square, rtol=budgets.fit_freedom)
    assert_allclose(np.sqrt(np.diag(f.covariance(f.start))), found.errors,
                    rtol=budgets.python_covariance)  # fmt: skip
    assert f.state(f.start).shape is not None
    assert np.array_equal(f.state(f.start).spin.w, found.body.spin.w)
    wide = LightResiduals(found.body, curve, multiple=True)
    assert wide.names[-1] == "multiple" and wide.bounds[0][-1] > 0.0
    J = wide.jacobian(wide.start)
    for k in range(7):  # between the bends of facets
        size = largest(np.abs(J[:, k]))
        off = np.abs(slopes(wide, wide.start, k, 1e-6) - J[:, k])
        assert largest(off) < budgets.python_residual_difference * size, wide.names[k]


@pytest.mark.parametrize("kind", ["convex", "mesh"])
def test_posteriors_are_sampled(kind, convex, mesh):
    """Of good data they are nearly normal, with the errors of the fit."""
    pytest.importorskip("mici")
    pytest.importorskip("arviz_stats")
    found, curve = convex if kind == "convex" else mesh
    f = (LightResiduals(found.body, curve, about=fit_calls.BODY) if kind == "convex"
         else LightResiduals(found.body, curve))  # fmt: skip
    draws = quietly(polhode.fit.posterior, f, draws=250, warm_up=60, chains=1, seed=2)
    assert draws.draws.shape == (1, 250, len(f.names))
    spread = np.sqrt(np.diag(draws.covariance) / np.diag(draws.laplace_covariance))
    assert_allclose(spread, np.ones(len(f.names)), atol=budgets.sampled_surface)
    off = (draws.mean - f.start) / np.sqrt(np.diag(draws.laplace_covariance))
    assert largest(np.abs(off)) < budgets.sampled_surface
    assert draws.divergences <= budgets.sampled_diverged * 250
    body = f.state(draws.draws[0, -1])
    (model,) = polhode.light.model_fluxes(body, curve)
    assert np.sum(((model - curve.flux) / curve.sigma) ** 2) < budgets.sampled_misfit * 70


@pytest.mark.parametrize("changes", [
    {"light.shape": "convex", "light.convex.degree": 2, "light.convex.rows": 3},
    {"light.shape": "convex", "light.convex.degree": 2, "light.convex.rows": 3,
     "light.convex.roughness_error": 1.0},
])  # fmt: skip
def test_solutions_of_a_scenario_are_functions(changes):
    (one,) = polhode.fit.fit_scenario(polhode.load(NIGHT).replace({**NEARBY, **changes}))
    f = one.residual_function()
    assert isinstance(f, LightResiduals) and f.names == one.names
    assert_allclose(-2.0 * f.log_likelihood(f.start), one.chi_square, rtol=budgets.fit_freedom)
    slope = f.log_posterior_gradient(f.start) * np.sqrt(np.diag(f.covariance(f.start)))
    assert largest(np.abs(slope)) < budgets.python_optimum
    scaled = one.residual_function(scaled=True)
    assert_allclose(-2.0 * scaled.log_likelihood(f.start), one.degrees_of_freedom,
                    rtol=budgets.fit_freedom)  # fmt: skip
    assert f.state(f.start).kind == "convex"
    assert smallest(f.state(f.start).shape.areas) > 0.0


def test_a_mesh_of_a_scenario_is_a_function(tmp_path):
    changes = {"light.shape": "convex", "light.convex.degree": 2, "light.convex.rows": 3}
    (one,) = polhode.fit.fit_scenario(polhode.load(NIGHT).replace({**NEARBY, **changes}))
    one.write(tmp_path / "body.toml")
    (again,) = polhode.fit.fit_scenario(tmp_path / "body.toml")
    f = again.residual_function()
    assert isinstance(f, LightResiduals) and f.names == again.names
    assert_allclose(-2.0 * f.log_likelihood(f.start), again.chi_square, rtol=budgets.fit_freedom)
    assert f.state(f.start).kind == "mesh"


@pytest.mark.parametrize(("call", "error", "message"), [
    (lambda: LightResiduals(3, fit_calls.CURVE), TypeError, "got 3; expected LightModel"),
    (lambda: LightResiduals(fit_calls.BODY.convex(), fit_calls.CURVE, about=3), TypeError,
     "about: got 3; expected LightModel"),
    (lambda: LightResiduals(fit_calls.BODY.convex(), fit_calls.CURVE, axes_error=-1.0), ValueError,
     "axes_error = -1 must be above 0"),
    (lambda: LightResiduals(fit_calls.MESH, fit_calls.CURVE, moments="shape"), ValueError,
     "moments"),
    (lambda: LightResiduals(fit_calls.MESH, fit_calls.CURVE).state([1.0]), ValueError,
     r"x: got shape \(1,\); expected \(..., 6\)"),
])  # fmt: skip
def test_what_is_no_function_is_refused(call, error, message):
    with pytest.raises(error, match=message):
        call()
