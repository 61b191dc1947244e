# SPDX-License-Identifier: MIT
"""Mistakes that users make, over the most used functions: each gives one sentence that names the
argument, its value and what was expected."""

import datetime
import re

import numpy as np
import polhode
import pytest
from public_names import PUBLIC
from rejections import rejected

BODY = polhode.Body(1.0, 2.0, 2.5)
STATE = polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])
MOTION = polhode.FreeRotation(BODY, STATE)
SYSTEM = polhode.System(BODY)
PROBLEM = polhode.Problem(SYSTEM, STATE, 0.0, 1.0)
ELEMENTS = polhode.KeplerElements(1.0, 2.0, 0.1)
TWO = polhode.RotorState([1, 0, 0, 0], np.ones((2, 3)))
Q, OMEGA = [1.0, 0.0, 0.0, 0.0], [0.1, 0.2, 1.0]

# Calls in the order of arguments that functions had before, and what TypeError says.
ANDOYER, TIME = polhode.to_andoyer(STATE), 0.1
OLD_ORDER = [
    (polhode.rates.canonical_rates, ("andoyer", SYSTEM, TIME, STATE), "system, t, state, chart"),
    (polhode.rates.perturbation_rates, ("andoyer", SYSTEM, TIME, STATE), "system, t, state, chart"),
    (polhode.rates.convective_term, ("euler", SYSTEM, TIME, STATE), "system, t, state, chart"),
    (polhode.rates.equations_of_motion, (abs, SYSTEM, TIME, [1.0] * 6), "system, t, z, f"),
    (polhode.rates.modified_andoyer_rates, (SYSTEM, 0.0, TIME, STATE), "system, t, state, t0"),
    (polhode.charts.modified_andoyer, (BODY, 0.0, TIME, STATE), "body, t, state, t0"),
    (polhode.charts.from_modified_andoyer, (BODY, 0.0, TIME, ANDOYER), "body, t, state, t0"),
    (polhode.charts.elements_of_state, ("serret", SYSTEM, TIME, STATE, "osculating"),
     "system, t, state, chart, gauge"),
    (polhode.charts.chart_jacobian, ("euler", STATE), "state, chart"),
]
CHARTS_FIRST = [
    (polhode.charts.inverse_chart_jacobian, ("euler", STATE)),
    (polhode.charts.inverse_chart_jacobian, (np.eye(6), STATE.g)),
    (polhode.charts.canonical_transformation, ("euler", "andoyer", STATE)),
    (polhode.charts.canonical_transformation, (np.eye(6), np.eye(6), STATE.g)),
]


def test_a_call_in_the_old_order_is_told_the_new_one():
    for function, arguments, order in OLD_ORDER:
        rejected(TypeError, rf"the order is {order}\)$", function, *arguments)
    for function, arguments in CHARTS_FIRST:
        rejected(TypeError, "state: got a chart; expected a RotorState", function, *arguments)


# What is typed, and the whole sentence.
MISTAKES = {
    "a list of moments": (
        lambda: polhode.Body([1, 2, 2.5]),
        "Body: I1: got [1, 2, 2.5], a list; expected a number"),
    "texts": (
        lambda: polhode.Body("1", "2", "2.5"),
        "Body: I1: got '1', a str; expected a number"),
    "two moments": (
        lambda: polhode.Body(1, 2),
        "Body: got no I3; expected I3 (a number)"),
    "a negative moment": (
        lambda: polhode.Body(1, -2, 2.5),
        "Body: moments (1, -2, 2.5) must be positive and finite"),
    "a moment that is NaN": (
        lambda: polhode.Body(1, np.nan, 2.5),
        "Body: moments (1, nan, 2.5) must be positive and finite"),
    "no rigid body": (
        lambda: polhode.Body(1, 2, 4),
        "Body: moments (1, 2, 4) break I3 <= I1 + I2"),
    "moments for a tensor": (
        lambda: polhode.Body.from_tensor([1, 2, 2.5]),
        "tensor: got shape (3,); expected (..., 3, 3)"),
    "a quaternion of three": (
        lambda: polhode.RotorState(OMEGA, OMEGA),
        "q: got shape (3,); expected (..., 4)"),
    "a zero quaternion": (
        lambda: polhode.RotorState([0, 0, 0, 0], OMEGA),
        "RotorState: q: got (0, 0, 0, 0); expected an attitude, which is not zero"),
    "a ragged list": (
        lambda: polhode.RotorState(Q, [[0.1, 0.2, 1], [0.1, 0.2]]),
        "g: got a ragged or mixed list; expected real numbers"),
    "None for numbers": (
        lambda: polhode.RotorState(Q, None),
        "RotorState: g: got None; expected numbers"),
    "NaN in one of two": (
        lambda: polhode.RotorState(Q, [OMEGA, [0.1, np.nan, 1]]),
        "RotorState: g: got nan; expected finite numbers (at index (1,))"),
    "no body": (
        lambda: polhode.rotor_state(Q, OMEGA),
        "rotor_state: body: got [1.0, 0.0, 0.0, 0.0], a list; expected a Body"),
    "attitude and rate swapped": (
        lambda: polhode.rotor_state(BODY, OMEGA, Q),
        "q: got shape (3,); expected (..., 4)"),
    "body and state swapped": (
        lambda: polhode.FreeRotation(STATE, BODY),
        "FreeRotation: body: got RotorState(q=[1.0, 0.0, 0.0, 0.0], g=[0.1, 0.2, 1.0]); "
        "expected a Body (s0 is a RotorState)"),
    "many states for one": (
        lambda: polhode.FreeRotation(BODY, TWO),
        "FreeRotation: got states of shape (2,); expected one state"),
    "a time of day": (
        lambda: polhode.FreeRotation(BODY, STATE, "noon"),
        "FreeRotation: t0: got 'noon', a str; expected a number"),
    "a generator of times": (
        lambda: MOTION.at(t for t in (0.0, 1.0)),
        "t: got a generator; expected real numbers"),
    "a timedelta": (
        lambda: MOTION.at(datetime.timedelta(hours=1)),
        "t: got a timedelta; expected real numbers"),
    "no time": (
        lambda: MOTION.at(),
        "FreeRotation.at: got no t; expected t (numbers)"),
    "a body for a state": (
        lambda: polhode.to_andoyer(BODY),
        "to_andoyer: state: got Body(1.0, 2.0, 2.5); expected a RotorState"),
    "a chart without its body": (
        lambda: polhode.to_rotor(polhode.charts.EulerRates(0, 1, 0, 0, 0, 1)),
        "to_rotor: state or body: got EulerRates(phi=0.0, theta=1.0, psi=0.0, phi_dot=0.0, "
        "thet...; expected an EulerState, an AndoyerState, a PoincareState or a Body"),
    "L beyond G": (
        lambda: polhode.AndoyerState(0, 0, 0, L=2, G=1, H=0.5),
        "andoyer_state: L = 2 must be within +-G, G = 1"),
    "shapes that do not fit": (
        lambda: polhode.AndoyerState([0, 1], [0, 1, 2], 0, 0, 1, 0),
        "l of shape (2,) and g of shape (3,) do not broadcast"),
    "an unknown word": (
        lambda: polhode.TumblerState(27.4, 30.6, [0, 0, 1], "fast", 0, 0),
        "mode: got 'fast'; expected one of rest steady short_axis long_axis separatrix"),
    "a pole in longitude and latitude": (
        lambda: polhode.TumblerState(27.4, 30.6, [250, -75], "short_axis", 0, 0),
        "pole: got shape (2,); expected (..., 3)"),
    "a term without a class": (
        lambda: polhode.System(BODY, terms=3),
        "System: terms: got 3; expected a term or a sequence of them: of a function of time and "
        "state, TorqueTerm or HamiltonianTerm makes one"),
    "a word for a frame": (
        lambda: polhode.System(BODY, frame="inertial"),
        "System: frame: got str; expected a Frame"),
    "a body for a system": (
        lambda: polhode.Problem(BODY, STATE, 0.0, 1.0),
        "Problem: system: got Body; expected a System"),
    "an end that is NaN": (
        lambda: polhode.Problem(SYSTEM, STATE, 0.0, np.nan),
        "Problem: start 0 and stop nan must be finite"),
    "a word for a method": (
        lambda: polhode.Problem(SYSTEM, STATE, 0.0, 1.0, "adaptive"),
        "Problem: method: got str; "
        "expected Adaptive, Collocation, Splitting or VariationOfConstants"),
    "a number of events": (
        lambda: polhode.Problem(SYSTEM, STATE, 0.0, 1.0, events=3),
        "Problem: events: got 3; expected a sequence of Event"),
    "an array for a number": (
        lambda: polhode.Body(np.array([1.0, 2.0, 2.5]), 2, 2.5),
        "Body: I1: got array([1. , 2. , 2.5]), an ndarray; expected a number"),
    "an argument too many": (
        lambda: polhode.Body(1, 2, 2.5, 4),
        "Body: got 4 arguments without a name; expected I1, I2, I3"),
    "an unknown option": (
        lambda: polhode.Adaptive(tolerence=1e-9),
        "Adaptive: got tolerence=1e-09, a float; expected tolerance"),
    "a negative tolerance": (
        lambda: polhode.Adaptive(-1e-9),
        "Adaptive: tolerance -1e-09 must be from 1e-15 to 0.01"),
    "a step of zero": (
        lambda: polhode.Splitting(0.0),
        "Splitting: step 0 must be positive"),
    "no problem": (
        lambda: polhode.integrate(SYSTEM, STATE, 0.0, 1.0),
        "integrate: problem: got System(Body(1.0, 2.0, 2.5)); expected a Problem"),
    "unsorted times": (
        lambda: polhode.integrate(PROBLEM, [0.5, 0.2, 0.9]),
        "integrate: sample times must run from start 0 to stop 1: 0.2 comes after 0.5"),
    "times in two dimensions": (
        lambda: polhode.integrate(PROBLEM, [[0.5], [0.6]]),
        "samples: got shape (2, 1); expected a SaveAt or times of shape (N,)"),
    "degrees": (
        lambda: polhode.KeplerElements(1.0, 2.0, 0.1, 51.6),
        "KeplerElements: inclination 51.6 must be an angle in rad, at most a turn"),
    "elements for an orbit": (
        lambda: polhode.GravityGradient(ELEMENTS, 1.0),
        'GravityGradient "GravityGradient": orbit: got a KeplerElements; expected an orbit, '
        "KeplerOrbit(elements), or a function of time"),
    "a date without a scale": (
        lambda: polhode.ephemeris.planetary_position("moon", "earth", "2029-04-13"),
        'Date: got "2029-04-13"; the time scale is missing'),
    "a number for a date": (
        lambda: polhode.ephemeris.planetary_position("moon", "earth", 2451545.0),
        "planetary_position: date: got 2451545.0, a float; expected a Date"),
    "a datetime without a time zone": (
        lambda: polhode.ephemeris.j2000_from_teme(datetime.datetime(2029, 4, 13)),
        "Date: instant: got datetime.datetime(2029, 4, 13, 0, 0), which has no time zone; "
        'expected tzinfo=datetime.timezone.utc, or a scale: Date(instant, "UTC")'),
    "an int that is too large": (
        lambda: polhode.ephemeris.calendar_date("UTC", 2**40, 1, 1),
        "calendar_date: year: got 1099511627776, an int; expected an int of 32 bits"),
    "a generator of bodies": (
        lambda: polhode.propagate((BODY for _ in range(2)), TWO, 1.0),
        "bodies: got a generator; expected a Body, a sequence of them or moments (..., 3)"),
    "a bad body": (
        lambda: polhode.propagate([1, 2, 4], polhode.RotorState([1, 0, 0, 0], [0, 0, 1]), 1.0),
        "Body: moments (1, 2, 4) break I3 <= I1 + I2"),
    "REBOUND's inc": (
        lambda: polhode.KeplerElements(1.0, 1.0, 0.1, inc=0.2),
        "KeplerElements: got inc=0.2, a float; expected inclination"),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_one_sentence_says_what_is_wrong(mistake):
    make, sentence = MISTAKES[mistake]
    rejected((TypeError, ValueError), f"^{re.escape(sentence)}$", make)


def test_there_is_no_list_of_signatures():
    """Whatever class or function of the extension is called with what nobody takes."""
    nothing, count = object(), 0
    for name, thing in PUBLIC.items():
        if not callable(thing) or name.startswith(("load", "write_")):
            continue
        for args, kwargs in (((nothing,), {}), ((nothing,) * 30, {}), ((), {"no_such": nothing})):
            try:
                thing(*args, **kwargs)
            except Exception as error:
                assert "incompatible function arguments" not in str(error), name
                assert "\n" not in str(error), name
                count += 1
    assert count > 500


def test_a_subclass_is_explained_as_its_class():
    class Mine(polhode.Adaptive):
        def __init__(self):
            super().__init__("small")

    rejected(TypeError, "Adaptive: tolerance: got 'small', a str; expected a num", Mine)


def test_what_an_argument_raises_is_not_hidden():
    class Bad:
        def __array__(self, dtype=None, copy=None):
            raise RuntimeError("no array today")

    rejected(RuntimeError, "no array today", MOTION.at, Bad())


@pytest.mark.parametrize(("name", "expected"), [
    ("SaveAt", "SaveAt.steps or SaveAt.count or SaveAt.times"),
    ("Trajectory", "integrate or resume"),
    ("Spectrum", "spectrum"),
    ("AnyPerturbation", "what other functions of polhode return"),
])
def test_a_class_that_cannot_be_called_says_what_makes_it(name, expected):
    said = f"^{name}: its class cannot be called; expected {expected}$"
    with pytest.raises(TypeError, match=said):
        PUBLIC[name](1.0)


def test_steps_of_one_length_take_no_tolerance():
    said = "tolerance 1e-09 goes with steps under control; got step 0.2"
    rejected(ValueError, said, polhode.Collocation, 1e-9, step=0.2)
