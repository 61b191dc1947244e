# SPDX-License-Identifier: MIT
"""What fits take and give back goes through pickles, for other processes and for files, and comes
out with the same numbers: every public class of fits, none left out."""

import ast
import dataclasses
import functools
import pathlib
import pickle
import warnings

import fit_calls
import numpy as np
import polhode
import pytest
from polhode import light
from polhode.fit import ResidualFunction
from polhode.light import LightResiduals
from public_names import PUBLIC

NIGHT = pathlib.Path(__file__).resolve().parents[2] / "examples/tumbling-night.toml"
BODY, CURVE, SMALL = fit_calls.BODY, fit_calls.CURVE, {"degree": 2, "rows": 3}


@functools.cache
def night():
    """With a scan and a search, as small as they can be."""
    wide = {"fit.starts": 4, "fit.scan.shortest": 9, "fit.scan.longest": 11, "fit.scan.minima": 2}
    return polhode.fit.fit_scenario(polhode.load(NIGHT).replace(wide))


@functools.cache
def near():
    start = {"fit.from": "start", "fit.starts": None, "fit.scan": None}
    return polhode.fit.fit_scenario(polhode.load(NIGHT).replace(start))


@functools.cache
def toutatis():
    return polhode.fit.fit_scenario(fit_calls.TOUTATIS)


@functools.cache
def convex():
    return light.fit_light(BODY.convex(**SMALL), CURVE)


@functools.cache
def searched():
    return light.search_light(CURVE, [("SAM", 10.0, 25.0)], starts=4)


@functools.cache
def scan():
    return light.fourier_scan(CURVE, (0.05, 0.2, 0.01), order=1)


def draws():
    pytest.importorskip("mici")
    pytest.importorskip("arviz_stats")
    f = polhode.fit.SpinResiduals(fit_calls.STATE, fit_calls.RATES, "rate")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        return polhode.fit.posterior(f, draws=4, chains=1, warm_up=3, seed=1)


MADE = {
    "SpinState": lambda: fit_calls.STATE,
    "Snapshots": lambda: fit_calls.RATES,
    "SpinSolution": lambda: polhode.fit.fit_spin(fit_calls.STATE, fit_calls.RATES, "rate"),
    "LightCurve": lambda: CURVE,
    "LightModel, ellipsoid": lambda: BODY,
    "LightModel, convex": lambda: convex().body,
    "LightModel, mesh": lambda: fit_calls.MESH,
    "ConvexShape": lambda: convex().body.shape,
    "LightSolution": lambda: light.fit_light(BODY, CURVE),
    "LightSolution, convex": convex,
    "LightSolution, mesh": lambda: light.fit_light(fit_calls.MESH, CURVE, most_iterations=2),
    "LightSearchResult": searched,
    "LightExtensionResult": lambda: light.extend_light(CURVE, BODY, within=100.0),
    "JoinedSession": lambda: light.extend_light(CURVE, BODY).joined[0],
    "FoundLight": lambda: near()[0].light,
    "FourierScan": scan,
    "FourierScan, of a file": lambda: night().scan,
    "FourierScan, by hand": lambda: light.FourierScan(
        scan().f1, scan().f2, scan().chi_square, scan().minima, 1, 20),
    "ScanMinimum": lambda: scan().minima[0],
    "ScanAdvice": lambda: light.scan_advice(CURVE),
    "PeriodLabel": lambda: light.period_labels(0.1, 0.27)[0],
    "LikelyPeriods": lambda: light.likely_periods(CURVE, 0.1, 0.27, order=1)[0],
    "FitResults": toutatis,
    "FitResults, light": near,
    "ScenarioSolution": lambda: toutatis()[0],
    "LightScenarioSolution": lambda: near()[0],
    "FitNumber": lambda: toutatis()[0].unknowns["w_x"],
    "FitResiduals": lambda: toutatis()[0].residuals,
    "FitPredictions": lambda: toutatis()[0].predicted([0.0, 10.0]),
    "SpinResiduals": lambda: polhode.fit.SpinResiduals(fit_calls.STATE, fit_calls.RATES, "rate"),
    "LightResiduals": lambda: LightResiduals(BODY, CURVE, moments="fit"),
    "LightResiduals, of a file": lambda: near()[0].residual_function(scaled=True),
    "LightResiduals, convex": lambda: light.LightResiduals(convex().body, CURVE, about=BODY),
    "LightResiduals, mesh": lambda: light.LightResiduals(fit_calls.MESH, CURVE),
    "Posterior": draws,
}  # fmt: skip


def alike(a, b):
    """To the last bit."""
    if type(a) is not type(b):
        return False
    if isinstance(a, ResidualFunction):
        x = a.start
        return a.names == b.names and all(
            map(np.array_equal, a.residuals_and_jacobian(x), b.residuals_and_jacobian(x))
        )
    if isinstance(a, (polhode.fit.FitResults, polhode.fit.ScenarioSolution)):
        return a.report == b.report
    if isinstance(a, (np.ndarray, float)):
        return np.array_equal(a, b, equal_nan=True)
    if dataclasses.is_dataclass(a):
        fields = [f.name for f in dataclasses.fields(a) if not f.name.startswith("_")]
        return all(alike(getattr(a, name), getattr(b, name)) for name in fields)
    if isinstance(a, polhode.shape.FacetShape):
        return alike(np.asarray(a.vertices), np.asarray(b.vertices)) and alike(
            np.asarray(a.triangles), np.asarray(b.triangles)
        )
    if isinstance(a, (tuple, list)):
        return len(a) == len(b) and all(map(alike, a, b))
    for parts in ("_parts", "_tables"):
        if hasattr(a, parts):
            return alike(getattr(a, parts)(), getattr(b, parts)())
    return a == b


@pytest.mark.parametrize("name", MADE)
def test_it_comes_out_of_a_pickle_as_it_went_in(name):
    made = MADE[name]()
    assert type(made).__name__ == name.split(",")[0]
    for protocol in (2, pickle.HIGHEST_PROTOCOL):
        again = pickle.loads(pickle.dumps(made, protocol))
        assert alike(made, again)
        assert isinstance(made, ResidualFunction) or repr(made) == repr(again)


def test_what_differs_is_not_alike():
    """The comparison above can fail."""
    other = light.fourier_scan(CURVE, (0.05, 0.2, 0.02), order=1)
    assert not alike(scan(), other) and not alike(BODY, convex().body)
    assert not alike(LightResiduals(BODY, CURVE), LightResiduals(BODY, CURVE, moments="fit"))
    longer = light.LightCurve(CURVE.t, 2.0 * CURVE.flux, CURVE.sigma)
    assert not alike(CURVE, longer) and not alike(toutatis(), near())


def test_no_class_is_left_out():
    root = pathlib.Path(polhode.__file__).parent
    of_fits = ("_scenario_fits", "_fit_tables", "_light_fits", "_light_bodies",
               "_spin_fits", "_scans", "_residual_functions", "_posterior")  # fmt: skip
    classes = {
        node.name
        for name in of_fits
        for node in ast.parse((root / f"{name}.py").read_text(encoding="utf-8")).body
        if isinstance(node, ast.ClassDef) and node.name in PUBLIC
    }
    bases = {"FitSolution", "ResidualFunction"}  # of others, never made
    assert classes - bases == {name.split(",")[0] for name in MADE}


def test_a_scan_says_the_same_of_periods_and_is_held_once():
    again = pickle.loads(pickle.dumps(night().scan))
    assert again.periods(pairs=2) == night().scan.periods(pairs=2) != []
    size = len(pickle.dumps(night().scan))
    assert size < 1.5 * night().scan.chi_square.nbytes + 20_000
