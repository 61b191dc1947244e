# SPDX-License-Identifier: MIT
"""No function of the package takes a number from what is more than one: a quantity, a masked value,
a time, a complex number. Every parameter of every public function is tried."""

import ast
import inspect
import pathlib
import re

import astropy.table
import astropy.units as u
import fit_calls
import numpy as np
import pandas as pd
import pint
import polhode
import public_calls
import pytest
import xarray as xr
from polhode import Scenario, analysis, elliptic, satellites, spice
from public_names import PUBLIC
from scenario_texts import FREE

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
from polhode import figures  # noqa: E402

PINT = pint.UnitRegistry()
FURLONG = u.def_unit("furlong", 201.168 * u.m)
u.add_enabled_units([FURLONG])


class OwnQuantity:
    """As other libraries have them: a number that converts by itself, with a unit."""

    def __init__(self, value):
        self.value = value
        self.unit = "furlong"

    def to(self, unit):
        raise NotImplementedError

    def __float__(self):
        return float(np.asarray(self.value))

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.value, dtype)


OwnQuantity.unit = None  # the class has the attribute, as one with a property has


def nested(value, of):
    """Lists of quantities in place of a quantity of lists."""
    if np.ndim(value) == 0:
        return [of(value)]
    return [nested(item, of) if np.ndim(item) else of(item) for item in np.asarray(value)]


QUANTITIES = {
    "astropy": lambda x: np.asarray(x, float) * FURLONG,
    "pint": lambda x: np.asarray(x, float) * PINT.furlong,
    "own": OwnQuantity,
    "list of astropy": lambda x: nested(x, lambda item: item * FURLONG),
    "list of pint": lambda x: nested(x, lambda item: float(item) * PINT.furlong),
    "xarray around pint": lambda x: xr.DataArray(
        np.atleast_1d(np.asarray(x, float)) * PINT.furlong
    ),
    "column of a table": lambda x: astropy.table.Column(np.asarray(x, float), unit="furlong"),
}
def with_item(value, item):
    """The valid number with one odd item in its place, or in that of its first."""
    if np.ndim(value) == 0:
        return item
    return [with_item(value[0], item), *list(value)[1:]]


# What is made of a valid number, and the word that its refusal has, as a pattern.
OTHERS = {
    "masked": (lambda x: np.ma.masked_array(np.asarray(x, float), mask=True), "masked"),
    "masked item": (lambda x: with_item(x, np.ma.masked), "masked"),
    "timedelta64": (lambda x: np.asarray(x).astype(int).astype("timedelta64[s]"), "timedelta64"),
    "one timedelta64": (lambda x: with_item(x, np.timedelta64(3, "s")), "timedelta64"),
    "datetime64": (lambda x: with_item(x, np.datetime64("2029-04-13T21:46", "ns")), "datetime64"),
    "complex": (lambda x: np.asarray(x, complex), "complex"),
    "one complex": (lambda x: with_item(x, np.complex128(1.0 + 1.0j)), "complex"),
    "bools": (lambda x: np.asarray(x, bool), "bool"),
    "one bool": (lambda x: with_item(x, True), "bool"),
    "bytes": (lambda x: np.full(np.shape(x), b"1.0") if np.ndim(x) else b"1.0", r"bytes|\|S"),
    "bytes item": (lambda x: with_item(x, b"1.0") if np.ndim(x) else b"1.0", r"bytes|\|S"),
}

CALLS = public_calls.all_calls()
NAMES = [f"{call.name}-{k}" for k, call in enumerate(CALLS)]


def sample(call, name):
    """The number that stands in the valid call; 1 where an object may stand there, too."""
    value = call.arguments[name]
    return value if np.ndim(value) or isinstance(value, (int, float)) else 1.0


@pytest.mark.parametrize("call", CALLS, ids=NAMES)
def test_the_calls_are_valid(call):
    """So that what is refused below is refused for its one new argument. A new function whose
    numbers are of an unusual shape gets them in public_calls.OF_CALL."""
    call()


def accepted(call, makers):
    """What no sentence named by its word, and what came of it."""
    wrong = []
    for name in call.numbers:
        for kind, (make, word) in makers.items():
            value = make(sample(call, name))
            try:
                # NumPy asks a Dual, which leaves it to the other one
                if call(**{name: value}) is not NotImplemented:
                    wrong.append((name, kind, "accepted"))
            except (TypeError, ValueError) as error:
                if not re.search(word, str(error)):
                    wrong.append((name, kind, str(error)))
    return wrong


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("call", CALLS, ids=NAMES)
def test_a_quantity_is_refused_with_its_unit(call):
    in_furlongs = {kind: (make, "furlong") for kind, make in QUANTITIES.items()}
    assert accepted(call, in_furlongs) == []


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("call", CALLS, ids=NAMES)
def test_nothing_is_dropped_on_the_way_to_a_number(call):
    takes_complex = call.name in public_calls.OF_COMPLEX_NUMBERS
    others = {kind: of for kind, of in OTHERS.items() if not (takes_complex and "complex" in kind)}
    assert accepted(call, others) == []


def test_the_walk_sees_the_functions_that_there_are():
    names = {call.name for call in CALLS}
    assert {
        "rotor_state",
        "TumblerState.__init__",
        "FreeRotation.at",
        "FreeRotation.__init__",
        "Body.from_tensor",
        "Frame.orbit_plane",
        "SaveAt.steps",
        "date_after",
    } <= names


# Functions written in Python: each with a valid call, by the names of its numbers.
TLE = ("1 00005U 58002B   00179.78495062  .00000023  00000-0  28098-4 0  4753",
       "2 00005  34.2682 348.7242 1859667 331.7664  19.3264 10.82419157413667")
TIMES = np.linspace(0.0, 30.0, 60)
MOTION = public_calls.OF_CLASS["FreeRotation"]
PLANET = figures.OblatePlanet(1.0, 0.01, (0.0, 0.0, 0.1))
PATH = PLANET.path([0.6, 0.0, 0.0], [0.0, 1.2, 0.3], 1.0)
SATELLITE = satellites.satellite_from_tle(*TLE)
EPOCH = "2000-06-28T00:00:00 UTC"


ARGUMENTS = {"at_epoch": [0.0], "rates": [2.0], "multiples": [[1.0]]}
VARY = {"body.moments[0]": polhode.vary.uniform(0.9, 1.0)}
SPINNING = polhode.RotorState([1.0, 0.0, 0.0, 0.0], [0.0, 0.1, 3.0])


def no_figures(tmp_path):
    """Name: function, arguments that are numbers, other arguments."""
    first_last = {"first": 0.0, "last": 3600.0, "spacing": 60.0}
    ck = {"et": TIMES, "q": np.tile([1.0, 0, 0, 0], (60, 1)), "omega": np.zeros((60, 3))}
    names = {"path": tmp_path / "a.bc", "structure": -1234567, "frame": "F", "reference": "J2000"}
    return {
        "harmonic_fit": (analysis.harmonic_fit,
                         {"t": TIMES, "y": np.sin(TIMES), "periods": [3.0], "degree": 1}, {}),
        "argument_fit": (analysis.argument_fit,
                         {"t": TIMES, "y": np.sin(TIMES), "degree": 1, **ARGUMENTS}, {}),
        "ArgumentFit.at": (analysis.argument_fit(TIMES, TIMES, **ARGUMENTS).at, {"t": TIMES}, {}),
        "HarmonicFit.at": (analysis.harmonic_fit(TIMES, TIMES, [3.0]).at, {"t": TIMES}, {}),
        "without_free_wobble": (analysis.without_free_wobble,
                                {"start": 0.0, "periods": 6, "damper_rate": [0.0, 0.0, 0.0]},
                                {"system": polhode.System(public_calls.BODY), "initial": SPINNING}),
        "to_scipy": (polhode.charts.to_scipy, {"attitude": [1.0, 0.0, 0.0, 0.0]}, {}),
        "Satellite.states": (SATELLITE.states, {"times": [0.0, 60.0]}, {"epoch": EPOCH}),
        "Satellite.orbit": (SATELLITE.orbit, first_last, {"epoch": EPOCH}),
        "Satellite.write": (SATELLITE.write, first_last,
                            {"path": tmp_path / "a.csv", "epoch": EPOCH}),
        "Scenario.build": (Scenario.build, {"time": TIMES, "damper_rate": [0.0, 0.0, 0.0]},
                           {"system": public_calls.BODY, "state": public_calls.STATE}),
        "Scenario.ensemble": (Scenario.from_text(FREE).ensemble,
                              {"size": 3, "seed": 1, "quantiles": [0.5]}, {"vary": VARY}),
        "vary.normal": (polhode.vary.normal, {"sigma": 1.0, "mean": 0.0, "low": 0.0}, {}),
        "vary.joint_normal": (polhode.vary.joint_normal,
                              {"covariance": [[1.0, 0.0], [0.0, 1.0]], "means": [0.0, 0.0]}, {}),
        "ephemeris_time": (spice.ephemeris_time, {"seconds": TIMES},
                           {"epoch": "2000-06-28T00:00:00 TDB"}),
        "write_ck_rows": (spice.write_ck_rows, ck, names),
    }


def of_elliptic():
    """The same of polhode.elliptic, where every parameter is a number."""
    values = {"m": 0.25, "m1": 0.75}
    functions = {name: getattr(elliptic, name) for name in elliptic.__all__}
    return {
        name: (function, {p: values.get(p, 0.5) for p in inspect.signature(function).parameters},
               {})
        for name, function in functions.items()
        if inspect.isfunction(function)
    }


def of_figures(tmp_path):
    """The same of figures."""
    map_ = {"a": [0.0, 0.0, 1.0, 1.0], "b": [0.0, 1.0, 0.0, 1.0],
            "mean_megno": [2.0, 2.0, 3.0, 4.0]}
    chaos = analysis.chaos_indicator(public_calls.PROBLEM, [0.0, 0.1])
    run = polhode.integrate(public_calls.PROBLEM)
    film = {"motion": MOTION, "path": tmp_path / "film.gif"}
    return {
        "animation": (figures.animation, {"times": [0.0, 1.0], "duration": 0.2, "fps": 10}, film),
        "chaos_map": (figures.chaos_map, {"limits": [2.0, 4.0]}, {"source": map_}),
        "chaos_growth": (figures.chaos_growth, {"scale": 1.0}, {"runs": chaos}),
        "orbit_ellipses": (figures.orbit_ellipses, {"times": [0.2]}, {"path": PATH}),
        "momentum_sphere": (figures.momentum_sphere, {"G": 1.0, "trace": [[0.1, 0.2, 0.9]]},
                            {"body": public_calls.BODY}),
        "OblatePlanet.path": (PLANET.path, {"r": [0.6, 0, 0], "p": [0, 1.2, 0.3], "stop": 1.0}, {}),
        "OblatePlanet": (figures.OblatePlanet, {"gm": 1.0, "J2_R2": 0.01, "mu": [0.0, 0.0, 0.1]},
                         {}),
        "outcomes": (
            figures.outcomes,
            {"limits": [0.0, 1.0], "size": 2.0},
            {"source": {"a": [0.0, 1.0], "b": [1.0, 2.0]}, "value": "a", "x": "a", "y": "b"},
        ),
        "pole_cloud": (
            figures.pole_cloud,
            {"limits": [0.0, 1.0], "size": 2.0},
            {"source": {"pole_ra": [0.0, 1.0], "pole_dec": [0.5, 0.6]}, "value": "pole_dec"},
        ),
        "overview": (figures.overview, {"span": 0.1}, {"results": run, "body": public_calls.BODY}),
        "phase_plane": (figures.phase_plane, {"G": 1.0, "trace": [[0.1, 0.2, 0.9]]},
                        {"body": public_calls.BODY}),
        "herpolhode": (figures.herpolhode, {"periods": 1.0}, {"motion": MOTION}),
        "polhode_and_herpolhode": (figures.polhode_and_herpolhode, {"periods": 1.0},
                                   {"motion": MOTION}),
        "poincare_section": (figures.poincare_section, {"size": 1.0},
                             {"runs": {"x": [1.0], "y": [2.0]}, "x": "x", "y": "y"}),
        "View.__init__": (figures.View, {"elevation": 20.0, "azimuth": 30.0}, {}),
        "View.paper": (figures.View().paper, {"points": [1.0, 2.0, 3.0]}, {}),
    }


# Whole numbers, which count or name something, and things that only the package makes.
COUNTS = {
    "axes",
    "failures",
    "threads",
    "progress",
    "structure",
    "short_axis",
    "long_axis",
    "direction",
    "index",
    "dpi",
    "energy_change",
}


def numbers_in_sources():
    """(function, parameter) of all public ones with numbers, as the sources annotate them."""
    root = pathlib.Path(polhode.__file__).parent
    for path in sorted(root.rglob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            inside = [node] if isinstance(node, ast.FunctionDef) else getattr(node, "body", [])
            owner = node.name + "." if isinstance(node, ast.ClassDef) else ""
            if not hasattr(node, "name") or node.name.startswith("_"):
                continue
            if path.name.startswith("_") and node.name not in PUBLIC:
                continue
            if path.parent.name == "figures" and node.name not in figures.__all__:
                continue
            for function in (f for f in inside if isinstance(f, ast.FunctionDef)):
                if function.name.startswith("_") and function.name != "__init__":
                    continue
                for a in function.args.args + function.args.kwonlyargs:
                    said = ast.unparse(a.annotation) if a.annotation else ""
                    if public_calls.NUMBERS.search(said):
                        yield owner + function.name, a.arg


def test_functions_written_in_python_refuse_quantities(tmp_path):
    known = no_figures(tmp_path) | of_figures(tmp_path) | of_elliptic() | fit_calls.of_fits()
    for name, parameter in numbers_in_sources():
        if parameter not in COUNTS:
            assert parameter in known[name][1], f"no {parameter} of {name} above"
    for name, (function, arguments, others) in known.items():
        if name != "animation":  # a film takes a second
            function(**arguments, **others)
        for parameter, value in arguments.items():
            for kind in ("astropy", "pint", "list of pint", "masked", "timedelta64", "complex"):
                made = QUANTITIES[kind](value) if kind in QUANTITIES else OTHERS[kind][0](value)
                with pytest.raises((TypeError, ValueError)) as refusal:
                    function(**{**arguments, parameter: made}, **others)
                matplotlib.pyplot.close("all")
                if kind in QUANTITIES and parameter not in ("degree", "fps"):
                    assert "furlong" in str(refusal.value), (name, parameter, kind)
    assert not (tmp_path / "film.gif").exists()
    matplotlib.pyplot.close("all")


def test_what_looks_like_a_quantity_and_is_none_is_taken():
    t = [0.5, 0.7]
    expected = MOTION.at(t)
    for same in (np.array(t, np.float64)[::1], np.array([0.5, 9.0, 0.7])[::2], tuple(t),
                 [np.float64(0.5), 0.7], pd.Series(t, index=["unit", "to_value"]),
                 pd.Series(t, name="units"), xr.DataArray(t, attrs={"units": "s", "unit": "h"}),
                 astropy.table.Column(t), np.ma.masked_array(t, mask=False),
                 [np.array(0.5), np.array(0.7)]):
        assert MOTION.at(same) == expected
    frame = pd.DataFrame({"unit": [0.1], "units": [0.2], "magnitude": [1.0]})
    state = polhode.rotor_state(public_calls.BODY, [1, 0, 0, 0], frame)
    assert state.g.tolist() == [public_calls.STATE.g.tolist()]
    assert MOTION.at(np.int8(3)) == MOTION.at(3) == MOTION.at(np.array(3)) == MOTION.at(3.0)
    assert polhode.Body(np.float32(1.0), np.int64(2), 2) == polhode.Body(1, 2, 2)


def test_one_converts_a_quantity_and_passes_it():
    """What the sentence says to do is what works."""
    with pytest.raises(TypeError) as refusal:
        MOTION.at(2.0 * u.min)
    assert re.fullmatch(
        r"t: got 2\.0 min, a Quantity in min; expected plain numbers, all in one set of units: "
        r"t\.to_value\(unit\) gives them",
        str(refusal.value),
    )
    assert MOTION.at((2.0 * u.min).to_value("s")) == MOTION.at(120.0)
    with pytest.raises(TypeError, match=r"got 3 minute, a Quantity in minute; .* m_as\(unit\)"):
        polhode.FreeRotation(public_calls.BODY, public_calls.STATE, 3 * PINT.min)


def test_what_a_function_of_the_user_returns_has_no_unit_either():
    term = polhode.TorqueTerm(lambda t, s: [0.0, 0.0, 1.0] * u.N * u.m)
    with pytest.raises((TypeError, ValueError), match="the function returned .* N m"):
        polhode.rates.effect(polhode.System(public_calls.BODY, terms=term), 0.0, public_calls.STATE)
    hub, body = public_calls.STATE, public_calls.BODY
    for kg in (u.kg, PINT.kg):
        for term in (
            polhode.TorqueTerm(lambda t, s, kg=kg: [1.0 * kg, 0.0, 0.0]),
            polhode.HamiltonianTerm(lambda t, s, kg=kg: 1.0 * kg),
            polhode.GravityGradient(lambda t, kg=kg: np.array([1.0, 0.0, 0.0]) * kg, 1.0),
            polhode.ResidualDipole([0, 0, 1], field=lambda t, kg=kg: [1.0 * kg, 0.0, 0.0]),
        ):
            with pytest.raises((TypeError, ValueError), match="the function returned .* ?'?k"):
                polhode.rates.effect(polhode.System(body, terms=term), 0.0, hub)
        for frame in (
            polhode.Frame.orbit_plane(lambda t, kg=kg: 0.1 * kg, 0.2),
            polhode.Frame.from_attitude(lambda t, kg=kg: np.array([1.0, 0.0, 0.0, 0.0]) * kg),
        ):
            with pytest.raises((TypeError, ValueError), match="the function returned .* ?'?k"):
                frame.at(0.0)
    event = polhode.Event("e", lambda t, s: s.g[0] * u.kg)
    with pytest.raises(TypeError, match='event "e": got .* in kg'):
        polhode.integrate(
            polhode.Problem(public_calls.SYSTEM, public_calls.STATE, 0.0, 1.0, events=[event])
        )


@pytest.mark.parametrize("period", [
    30.56 * u.h,
    30.56 * PINT.h,
    np.array(30.56) * u.h,
    np.timedelta64(30, "h"),
    np.datetime64("2029-04-13", "ns"),
    np.ma.masked_array([30.56], mask=[True])[0],
    [30.56 * u.h],
])
def test_a_scenario_takes_texts_with_units_and_no_quantities(period):
    data = {
        "schema": 1,
        "body": {"moments": [1, 2, 2.5]},
        "state": {
            "tumbler": {"precession_period": "27.38 h", "rotation_period": period,
                        "pole": {"longitude": "1 deg", "latitude": 0}, "mode": "SAM", "phi0": 0,
                        "psi0": 0}
        },
    }
    with pytest.raises((TypeError, ValueError), match="state.tumbler.rotation_period: got"):
        Scenario.from_dict(data)
