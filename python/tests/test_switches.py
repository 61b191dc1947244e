# SPDX-License-Identifier: MIT
"""Torques of a user that jump: switching functions, time scales, and what is refused."""

import math

import budgets
import numpy as np
import polhode
import pytest
from polhode import (
    Adaptive,
    AtmosphericDrag,
    Body,
    KeplerElements,
    KeplerOrbit,
    Problem,
    RotorState,
    SolarPressure,
    Splitting,
    Surface,
    System,
    TorqueTerm,
    integrate,
)
from polhode.rates import effect
from rejections import rejected

BODY = Body(1.0, 1.5, 2.0)
SPIN = RotorState([1, 0, 0, 0], [0, 0, 1.0])


def run(term, method=None, stop=10.0, start=SPIN):
    return integrate(Problem(System(BODY, terms=term), start, 0.0, stop, method or Adaptive()))


def jet(t, s, sides):
    assert sides.shape == (1,) and abs(sides[0]) == 1.0
    return [0.0, 0.0, -0.25 if sides[0] > 0 else 0.0]


def too_fast(t, s):
    return s.g[2] - 0.125


def test_a_dead_zone_is_entered_to_rounding():
    for tolerance in (1e-6, 1e-9, 1e-12):
        end = run(TorqueTerm(jet, switches=too_fast), Adaptive(tolerance))
        assert end.outcome.ok, end.outcome.advice
        assert end.states.g[-1, 2] == pytest.approx(0.125, abs=budgets.bang_floor)
        # 3.5 of time at the mean rate, and the rest at the last one
        angle = 3.5 * 0.5 * (0.5 + 0.0625) + 6.5 * 0.0625
        w, _, _, z = end.states.q[-1]
        assert math.remainder(2 * math.atan2(z, w) - angle, 2 * math.pi) == pytest.approx(
            0.0, abs=budgets.bang_per_tolerance * tolerance + budgets.bang_floor)


def test_several_functions_and_a_kick():
    def push(t, s, sides):
        return [0.0, 0.0, 0.1 * sides[0] * sides[1]]

    term = TorqueTerm(push, kick=True, time_scale=2.5,
                      switches=lambda t, s: np.array([math.sin(t), t - 5.0]))
    assert term.supports_switches and term.time_scale == 2.5 and term.is_kick
    assert term.switches(7.0, None)[1] == 2.0
    gained = run(term).states.g[-1, 2] - 1.0
    # + + until pi, - after it, the other way from 5, and again at 2 pi and 3 pi
    signs = [(0, math.pi, -1), (math.pi, 5, 1), (5, 2 * math.pi, -1), (2 * math.pi, 3 * math.pi, 1),
             (3 * math.pi, 10, -1)]
    expected = sum(0.1 * s * (b - a) for a, b, s in signs)
    assert gained == pytest.approx(expected, abs=budgets.bang_floor)
    # functions of a state take the sides of the values
    assert effect(System(BODY, terms=term), 1.0, SPIN).u[2] == -0.1
    assert run(term, Splitting(0.01)).outcome.ok


def test_what_holds_its_own_zero_is_refused():
    brake = TorqueTerm(lambda t, s, sides: [0, 0, -0.25 * sides[0]], "brake",
                       switches=lambda t, s: s.g[2])
    outcome = run(brake).outcome
    assert outcome.status == polhode.types.Outcome.Status.failed and outcome.t == pytest.approx(4.0)
    assert 'switching function 1 of term "brake" stays at zero after t = 4' in outcome.advice


@pytest.mark.parametrize("returned, error, message", [
    ("no", TypeError, 'TorqueTerm "odd": switches'), (None, TypeError, "switches"),
    ([[1.0, 2.0]], ValueError, "(n,) numbers")])
def test_switches_that_are_no_numbers(returned, error, message):
    term = TorqueTerm(jet, "odd", switches=lambda t, s: returned)
    with pytest.raises((TypeError, ValueError)) as caught:
        run(term)
    assert message in str(caught.value)


def test_refused_when_it_is_made():
    rejected(TypeError, "switches", TorqueTerm, jet, switches=3.0)
    for time in (0.0, -1.0, math.nan):
        rejected(ValueError, "expected a positive time", TorqueTerm, jet, time_scale=time)


def test_a_pulse_that_its_term_knows():
    def pulse(t, s):
        return [0, 0, math.exp(-0.5 * (t - 4e4) ** 2)]

    def gained(**known):
        rest = RotorState([1, 0, 0, 0], [0, 0, 0])
        return run(TorqueTerm(pulse, **known), Adaptive(1e-6), 86400.0, rest).states.g[-1, 2]

    assert gained() == 0.0
    assert gained(time_scale=2.0) == pytest.approx(math.sqrt(2 * math.pi), abs=budgets.jet_gained)


def test_terms_know_the_time_scale_of_their_orbit():
    orbit = KeplerOrbit(KeplerElements(4.0, 2.0, 0.0))
    plate = Surface.of_plate([0, 1, 0], [1, 0, 0], 1.0)
    air = AtmosphericDrag(plate, orbit, 1e-3, 0.0)
    assert air.time_scale == pytest.approx(0.5 * math.pi * math.sqrt(2.0), rel=budgets.time_scale)
    assert air.supports_switches
    assert TorqueTerm(lambda t, s: [0, 0, 0]).time_scale == math.inf


@pytest.mark.parametrize("days", [1, 3])
@pytest.mark.parametrize("tolerance", [1e-8, 1e-12, 1e-14])
def test_a_shadow_does_not_stop_a_run(days, tolerance):
    wing = Surface.of_plate([0, 3, 0], [1, 0, 0], 10.0, specular=0.2, both_sides=True)
    orbit = KeplerOrbit(KeplerElements(3.986004418e14, 6.878e6, 0.0, 0.9))
    sun = KeplerOrbit(KeplerElements(1.32712440018e20, 1.496e11, 0.0, 0.409))
    light = SolarPressure(wing, orbit, 4.54e-6, 1.495978707e11, sun=sun,
                          shadow="cylinder", shadow_radius=6.378e6)
    system = System(Body(900, 400, 1000), terms=light)
    start = RotorState([0.9, 0.1, 0.2, 0.3], [0, 0, 1.0])

    def end(tolerance):
        stop = 86400.0 * days
        done = integrate(Problem(system, start, 0.0, stop, Adaptive(tolerance)),
                         [stop])
        assert done.outcome.ok, done.outcome.advice
        return done.states.g[-1]

    best = end(1e-15)
    error = np.linalg.norm(end(tolerance) - best) / np.linalg.norm(best)
    assert error < budgets.cylinder_per_tolerance * tolerance + budgets.time_scale


def turned_by_light(tolerance):
    plate = Surface.of_plate([1, 0, 0], [0, 0.3, 0], 2)
    far = KeplerOrbit(KeplerElements(gm=1e-6, pericentre=1e3, eccentricity=0.0))
    light = SolarPressure(plate, far, 1e-12, 1e6, sun=lambda t: [1e6, 0, 0])
    start = RotorState([1, 0, 0, 0], [0, 0, 1.5])
    turning = Problem(
        System(Body(1.0, 1.0, 1.5), terms=light), start, 0.0, 300.0, Adaptive(tolerance)
    )
    return integrate(turning, dense=False).states.g[-1, 2] - 1.5


def test_a_plate_that_turns_is_lit_from_the_front_alone_at_any_tolerance():
    exact = turned_by_light(1e-13)
    for tolerance in (1e-2, 1e-3, 1e-4):
        assert abs(turned_by_light(tolerance) / exact - 1) <= budgets.turning_plate
