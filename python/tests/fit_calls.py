# SPDX-License-Identifier: MIT
"""A valid call of every function of fits that takes numbers, for test_quantities.py."""

import pathlib
import warnings

import numpy as np
import polhode
from polhode import figures

TOUTATIS = pathlib.Path(__file__).resolve().parents[2] / "examples/toutatis-1992.toml"
TIMES = np.linspace(0.0, 30.0, 20)
SUN, OBSERVER = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
STATE = polhode.fit.SpinState([1.0, 0.0, 0.0, 0.0], [0.1, 0.2, 0.3], [1.0, 2.0, 2.5])
RATES = polhode.fit.Snapshots(rates=([0.0], [[0.1, 0.2, 0.31]], 0.01))
BODY = polhode.light.LightModel.homogeneous([1.0, 0, 0, 0], [0.4, 0.5, 1.0], [1.0, 0.8, 0.5])


def _curve():
    blank = polhode.light.LightCurve(TIMES, np.ones(20), 0.1, SUN, OBSERVER)
    (flux,) = polhode.light.model_fluxes(BODY, blank)
    return polhode.light.LightCurve(TIMES, flux, 0.01, SUN, OBSERVER)


CURVE = _curve()
TETRAHEDRON = polhode.shape.FacetShape([
    [1, 0, -0.3], [-0.6, 0.8, -0.3], [-0.6, -0.8, -0.3], [0, 0, 0.6]
],
                                 [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])  # fmt: skip
MESH = polhode.light.LightModel.homogeneous([1.0, 0, 0, 0], [0.4, 0.5, 1.0], TETRAHEDRON)


def quietly(function):
    """Few draws have not converged, which is no news."""

    def call(*arguments, **keywords):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)
            return function(*arguments, **keywords)

    return call


def of_fits():
    """Name: function, arguments that are numbers, other arguments."""
    found = polhode.fit.fit_spin(STATE, RATES, "rate")
    f = polhode.fit.SpinResiduals(STATE, RATES, "rate")
    light = polhode.light.LightResiduals(BODY, CURVE)
    errors = {"roughness_error": 3.0, "moments_error": 0.1, "closure_error": 1e-3,
              "axes_error": 1e-2}  # fmt: skip
    facets = BODY.convex(2, 3)
    scan = polhode.light.fourier_scan(CURVE, (0.05, 0.2, 0.01), order=1)
    (best,) = polhode.fit.fit_scenario(TOUTATIS).solutions
    few = {"draws": 4, "chains": 1, "warm_up": 3, "seed": 1, "accept": 0.8}
    start = {"start": STATE, "seen": RATES, "unknowns": "rate"}
    x = {"x": [0.1, 0.2, 0.3]}
    functions = ("residuals", "jacobian", "log_likelihood", "log_likelihood_gradient",
                 "log_posterior", "log_posterior_gradient", "log_posterior_and_gradient",
                 "residuals_and_jacobian", "covariance")  # fmt: skip
    search = {"starts": 2, "within": 2.0, "seed": 1, "tries": 2, "short_iterations": 2,
              "finalists": 1, "lambert": 0.0, "most_iterations": 2}  # fmt: skip
    return {
        **{f"ResidualFunction.{name}": (getattr(f, name), x, {}) for name in functions},
        "SpinResiduals.state": (f.state, x, {}),
        "LightResiduals.state": (light.state, {"x": light.start}, {}),
        "LightResiduals.__init__": (
            polhode.light.LightResiduals, errors, {"start": facets, "curves": CURVE},
        ),
        "SpinResiduals.__init__": (polhode.fit.SpinResiduals, {"error_factor": 1.0}, start),
        "fit_spin": (polhode.fit.fit_spin, {"error_factor": 1.0, "most_iterations": 20}, start),
        "SpinSolution.predicted": (found.predicted, {"times": TIMES}, {}),
        "posterior": (quietly(polhode.fit.posterior), few, {"of": f}),
        "fit_scenario": (
            polhode.fit.fit_scenario, {"starts": 1, "seed": 1, "threads": 1}, {"scenario": TOUTATIS}
        ),
        "ScenarioSolution.predicted": (best.predicted, {"times": [0.0, 10.0]}, {}),
        "ScenarioSolution.residual_function": (best.residual_function, {"epoch": 30.0}, {}),
        "ScenarioSolution.sample": (
            quietly(best.sample), {"epoch": 30.0}, {"draws": 4, "chains": 1, "warm_up": 3},
        ),
        "LightCurve.__init__": (
            polhode.light.LightCurve,
            {"t": TIMES, "flux": TIMES, "sigma": 0.1, "to_sun": SUN, "to_observer": OBSERVER},
            {},
        ),
        "LightModel.homogeneous": (
            polhode.light.LightModel.homogeneous,
            {"q": [1.0, 0, 0, 0], "w": SUN, "shape": [1.0, 0.8, 0.5], "t0": 0.0, "law": [1.0, 0.1]},
            {},
        ),
        "LightModel.convex": (BODY.convex, {"degree": 2, "rows": 3}, {}),
        "ConvexShape.of": (polhode.light.ConvexShape.of,
                           {"axes": [1.0, 0.8, 0.5], "degree": 2, "rows": 3}, {}),
        "fit_light": (polhode.light.fit_light, {**errors, "most_iterations": 2},
                      {"start": facets, "curves": CURVE}),
        "likely_periods": (
            polhode.light.likely_periods, {"f1": 0.1, "f2": 0.27, "order": 1}, {"curves": CURVE},
        ),
        "search_light": (
            polhode.light.search_light, {**search, **errors, "surface": (2, 3)},
            {"curves": CURVE, "periods": [("SAM", 10.0, 25.0)]},
        ),
        "extend_light": (polhode.light.extend_light,
                         {"first": 0, "within": 2.0, "most_counts": 9, "most_iterations": 2,
                          **errors},
                         {"curves": [CURVE], "starts": BODY}),
        "FourierScan.periods": (scan.periods, {"pairs": 1, "labels": 1}, {}),
        "scan_advice": (polhode.light.scan_advice, {"order": 2}, {"curves": CURVE}),
        "fourier_scan": (
            polhode.light.fourier_scan,
            {"f1": [0.05, 0.2, 0.01], "f2": [0.05, 0.2, 0.01], "order": 1, "minima": 2},
            {"curves": CURVE},
        ),
        "period_labels": (polhode.light.period_labels, {"f1": 0.1, "f2": 0.3}, {}),
        "scan_landscape": (figures.scan_landscape, {"minima": 2, "zoom": 1}, {"scan": scan}),
        "light_curve_fit": (
            figures.light_curve_fit, {"scale": 1.0}, {"curves": CURVE, "model": BODY},
        ),
        "body_as_seen": (
            figures.body_as_seen,
            {"times": [0.0, 1.0], "to_sun": SUN, "to_observer": OBSERVER, "scale": 1.0},
            {"body": BODY},
        ),
    }  # fmt: skip
