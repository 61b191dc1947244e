# SPDX-License-Identifier: MIT
"""Methods, events, problems and runs: right numbers, wrong arguments, and stopping a run."""

import gc
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import weakref

import budgets
import numpy as np
import polhode
import pytest
from interrupts import LATEST, seconds_from_signal
from polhode import (
    Adaptive,
    Body,
    Collocation,
    ConstantTorque,
    Event,
    FreeRotation,
    GravityGradient,
    HamiltonianTerm,
    KeplerElements,
    KeplerOrbit,
    Problem,
    RotorState,
    SaveAt,
    Splitting,
    System,
    TorqueTerm,
    VariationOfConstants,
    integrate,
)
from polhode.analysis import state_transitions
from polhode.types import Crossing, Precision, SplittingScheme
from public_names import PUBLIC
from slowdown import SLOWDOWN

BODY = Body(1.0, 2.0, 2.7)
START = RotorState([0.5, 0.5, -0.5, 0.5], [0.8, 1.9, 0.3])
METHODS = [Adaptive(), Splitting(0.1), VariationOfConstants(), Collocation()]
EVERY_METHOD = pytest.mark.parametrize("method", METHODS, ids=lambda m: type(m).__name__)


def moon() -> System:
    orbit = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
    return System(BODY, terms=[GravityGradient(orbit, 0.3)])


def distance(a: RotorState, b: RotorState) -> float:
    """The largest angle between attitudes, plus relative change of momentum."""
    sign = np.sign(np.sum(a.q * b.q, axis=-1, keepdims=True))
    angle = 2 * np.linalg.norm(a.q - sign * b.q, axis=-1)
    change = np.linalg.norm(a.g - b.g, axis=-1) / np.linalg.norm(a.g, axis=-1)
    return float(np.max(angle + change))


@EVERY_METHOD
@pytest.mark.parametrize("stop", [10.0, -10.0])
def test_free_rotation_is_the_exact_solution(method, stop):
    run = integrate(Problem(System(BODY), START, 0.0, stop, method), SaveAt.count(0.0, stop, 41))
    assert run.outcome.ok and run.stop == stop
    assert distance(run.states, FreeRotation(BODY, START).at(run.t)) < budgets.adaptive_short_run


@EVERY_METHOD
def test_there_and_back(method):
    there = integrate(Problem(moon(), START, 0.0, 20.0, method), [20.0]).states[0]
    back = integrate(Problem(moon(), there, 20.0, 0.0, method), [0.0]).states[0]
    assert distance(back, START) < budgets.rotor_ode_back_10
    assert distance(there, START) > budgets.two_bodies_differ


def test_the_methods_agree_where_there_is_a_torque():
    fine = integrate(Problem(moon(), START, 0.0, 5.0), [5.0]).states
    for method in (Splitting(0.01), VariationOfConstants(), Adaptive(1e-20, "double_double")):
        other = integrate(Problem(moon(), START, 0.0, 5.0, method), [5.0]).states
        assert distance(fine, other) < budgets.adaptive_short_run
    free = FreeRotation(BODY, START).at([5.0])
    assert distance(fine, free) > budgets.two_bodies_differ


def test_without_times_every_step_is_a_sample():
    run = integrate(Problem(moon(), START, 0.0, 10.0))
    assert len(run) == run.statistics.steps + 1
    assert run.t[0] == 0.0 and run.t[-1] == 10.0
    assert np.all(np.diff(run.t) > 0)


@pytest.mark.parametrize("samples", [
    SaveAt.times([0, 3, 10]),
    [0, 3, 10],
    (0.0, 3.0, 10.0),
    np.array([0, 3, 10], dtype=np.int32),
    np.array([0.0, 99.0, 3.0, 99.0, 10.0])[::2],
    [-1.0, 0.0, 3.0, 10.0, 11.0],  # what is outside the span is left out
])
def test_times_of_samples_in_every_form(samples):
    run = integrate(Problem(moon(), START, 0, 10), samples)
    assert run.t.tolist() == [0.0, 3.0, 10.0]
    assert run.states[0] == START


def test_methods_are_values():
    assert Adaptive() == Adaptive(1e-12, Precision.compensated, 0.0, np.inf)
    assert Adaptive(1e-9) != Adaptive() != Splitting(0.1)
    assert Splitting(0.1, "order4") == Splitting(step=0.1, scheme=SplittingScheme.order4)
    assert len({Adaptive(), Adaptive(), VariationOfConstants()}) == 2
    assert repr(Adaptive(1e-20, "double_double", largest_step=2.0)) == (
        "Adaptive(tolerance=1e-20, precision=Precision.double_double, largest_step=2.0)"
    )
    for method in (*METHODS, Adaptive(1e-20, "double_double", 0.1, 2.0)):
        assert eval(repr(method), {**PUBLIC}) == method
        assert pickle.loads(pickle.dumps(method)) == method
    with pytest.raises(AttributeError):
        Adaptive().tolerance = 1e-3


@pytest.mark.parametrize(("make", "error", "words"), [
    (lambda: Adaptive(0.0), ValueError, "tolerance 0 must be from 1e-15 to 0.01"),
    (lambda: Adaptive(1e-20), ValueError, "tolerance 1e-20 must be"),
    (lambda: Adaptive(np.nan), ValueError, "tolerance nan must be"),
    (lambda: Adaptive("1e-9"), TypeError, "tolerance: got '1e-9', a str; expected a number"),
    (lambda: Adaptive(precision="single"), ValueError, "got 'single'; expected one of"),
    (lambda: Adaptive(precision=1.5), TypeError, "precision: got 1.5"),
    (lambda: Adaptive(largest_step=0.0), ValueError, "largest_step 0 must be positive"),
    (lambda: Splitting(-0.1), ValueError, "step -0.1 must be positive"),
    (lambda: Splitting(np.inf), ValueError, "step inf must be finite"),
    (lambda: Splitting(), TypeError, "Splitting: got no step; expected step (a number)"),
    (lambda: VariationOfConstants(1.0), ValueError, "tolerance 1 must be"),
    (lambda: Event("a", 3), TypeError, 'Event "a": function 3 must be callable'),
    (lambda: Event("a", len, "up"), ValueError, "crossing: got 'up'"),
    (lambda: Event("a", len, period=-1.0), ValueError, "period -1.0 must be positive"),
    (lambda: Problem(BODY, START, 0, 1), TypeError, "system: got Body; expected a System"),
    (lambda: Problem(moon(), polhode.to_andoyer(START), 0, 1), TypeError,
     "initial: got AndoyerState; expected a RotorState"),
    (lambda: Problem(moon(), START.reshape((1,)), 0, 1), ValueError, "initial: got shape (1,)"),
    (lambda: Problem(moon(), START, 0, "1"), TypeError, "stop: got '1', a str; expected a"),
    (lambda: Problem(moon(), START, 0, np.nan), ValueError, "start 0 and stop nan must be"),
    (lambda: Problem(moon(), START, -np.inf, 1), ValueError, "start -inf and stop 1 must be"),
    (lambda: Problem(moon(), START, 0, 1, "adaptive"), TypeError, "method: got str"),
    (lambda: Problem(moon(), START, 0, 1, events=[len]), TypeError, "events: got builtin"),
])
def test_what_cannot_be_made_says_why(make, error, words):
    with pytest.raises(error) as raised:
        make()
    assert words in str(raised.value)


NO_NUMBER = FreeRotation(BODY, START).at(np.nan)


@pytest.mark.parametrize(("changes", "samples", "error", "words"), [
    ({"initial": NO_NUMBER}, None, ValueError, "nan) must be finite"),
    ({}, [5.0, 3.0], ValueError, "3 comes after 5"),
    ({}, [5.0, np.nan], ValueError, "time nan must be finite"),
    ({}, [[1.0, 2.0]], ValueError, "samples: got shape (1, 2)"),
    ({}, 1.0, ValueError, "samples: got shape ()"),
    ({}, ["a"], TypeError, "samples: got list of <U1; expected real numbers"),
    ({}, [1j], TypeError, "samples: got list of complex128; expected real numbers"),
    ({"method": Splitting(0.1), "torque": True}, None, ValueError, "has no exact flow"),
])
def test_what_is_no_run_says_why(changes, samples, error, words):
    changes = dict(changes)
    system = moon()
    if changes.pop("torque", False):
        system = System(BODY, terms=[TorqueTerm(lambda t, s: (0.0, 0.0, s.g[2]), name="jet")])
    problem = Problem(system, changes.get("initial", START), 0.0, changes.get("stop", 10.0),
                      changes.get("method", Adaptive()))
    with pytest.raises(error) as raised:
        integrate(problem, samples)
    assert words in str(raised.value)


def middle(t, s):
    return s.g[1]


def test_events_are_the_crossings_of_the_exact_motion():
    exact = FreeRotation(BODY, START)

    def events_of(crossing):
        events = [Event("g2", middle, crossing)]
        return integrate(Problem(System(BODY), START, 0.0, 40.0, events=events)).events

    both = events_of("both")
    assert len(both) > 5
    for event in both:
        assert event.name == "g2"
        assert abs(exact.at(event.t).g[1]) < budgets.adaptive_dense
        assert distance(event.s, exact.at(event.t)) < budgets.adaptive_dense
        assert event.direction == np.sign(exact.at(event.t + 1e-3).g[1])
    gaps = np.diff([event.t for event in both])
    assert np.abs(gaps - exact.polhode_period / 2).max() < budgets.adaptive_dense
    rising, falling = events_of(Crossing.rising), events_of("falling")
    assert {event.direction for event in rising} == {1}
    assert sorted([e.t for e in rising + falling]) == [e.t for e in both]


@pytest.mark.parametrize("condition", [lambda t, s: s.g[1] > 0, lambda t, s: bool(s.g[1] > 0)],
                         ids=["numpy", "python"])
def test_a_condition_is_no_event(condition):
    problem = Problem(System(BODY), START, 0.0, 40.0, events=[Event("g2", condition)])
    with pytest.raises(TypeError, match='event "g2": the function returned a bool; expected a num'):
        integrate(problem)


def test_an_event_may_stop_the_run():
    problem = Problem(System(BODY), START, 0.0, 40.0, events=[Event("g2", middle, stops=True)])
    run = integrate(problem, np.arange(0.0, 40.0, 0.1))
    assert run.outcome.status == polhode.types.Outcome.Status.stopped_by_event and run.outcome.ok
    assert run.stop == run.outcome.t == run.events[0].t == run.t[-1]
    assert len(run.events) == 1
    assert "stopped by an event" in repr(run)


def test_the_jump_of_a_folded_angle_is_no_event():
    def angle(t, s):  # about axis 1, which the momentum circulates
        return np.arctan2(s.g[2], s.g[1])

    def angles_met(period):
        events = [Event("angle", angle, period=period)]
        problem = Problem(System(BODY), START, 0.0, 40.0, events=events)
        return np.array([angle(e.t, e.s) for e in integrate(problem, []).events])

    zeros = np.abs(angles_met(2 * np.pi))
    assert len(zeros) > 2 and zeros.max() < budgets.adaptive_dense
    with_jumps = np.abs(angles_met(0.0))
    assert len(with_jumps) > len(zeros) and with_jumps.max() > 3.0


def test_an_event_function_gets_a_time_and_one_state():
    seen = []

    def function(t, s):
        seen.append((type(t), type(s), s.shape, s.q.shape))
        return np.float64(1.0)

    integrate(Problem(System(BODY), START, 0.0, 1.0, events=[Event("look", function)]))
    assert set(seen) == {(float, RotorState, (), (4,))}


class Oops(Exception):
    """Nothing that the library knows."""


@EVERY_METHOD
def test_what_an_event_raises_passes_through_unchanged(method):
    raised = Oops("here")

    def function(t, s):
        if t > 1.0:
            raise raised
        return 1.0

    with pytest.raises(Oops) as caught:
        integrate(Problem(moon(), START, 0.0, 10.0, method, [Event("oops", function)]))
    assert caught.value is raised
    assert caught.traceback[-1].name == "function"


def test_what_a_torque_raises_passes_through_unchanged():
    raised = Oops("here")

    def torque(t, s):
        if t > 1.0:
            raise raised
        return 0.1, 0.0, 0.0

    system = System(BODY, terms=[TorqueTerm(torque)])
    for method in (Adaptive(), VariationOfConstants()):
        with pytest.raises(Oops) as caught:
            integrate(Problem(system, START, 0.0, 10.0, method))
        assert caught.value is raised


@pytest.mark.parametrize(
    ("value", "words"),
    [(None, 'event "x": got a NoneType'), ("1", 'event "x": got'), ([1.0], 'event "x": got shape')],
)
def test_an_event_that_gives_no_number_says_so(value, words):
    events = [Event("x", lambda t, s: value)]
    with pytest.raises((TypeError, ValueError)) as raised:
        integrate(Problem(moon(), START, 0.0, 1.0, events=events))
    assert words in str(raised.value)


def test_a_run_that_fails_warns_and_keeps_what_it_had():
    events = [Event("root", lambda t, s: np.sqrt(5.0 - t) if t <= 5.0 else np.nan)]
    problem = Problem(moon(), START, 0.0, 10.0, events=events)
    with pytest.warns(RuntimeWarning, match='integrate: .* event "root" is NaN') as warned:
        run = integrate(problem, np.arange(0.0, 10.0, 0.5))
    assert warned[0].filename == __file__
    assert not run.outcome.ok and run.outcome.status == polhode.types.Outcome.Status.failed
    assert run.outcome.advice in repr(run)
    assert 4.0 < run.stop <= 5.0
    assert 8 < len(run) <= 11


def test_a_problem_keeps_the_very_objects():
    system, method, event = moon(), Splitting(0.2), Event("g2", middle)
    problem = Problem(system, START, 0, 1, method, iter([event]))
    assert problem.system is system and problem.initial is START and problem.method is method
    assert problem.events == (event,) and problem.events[0] is event
    assert (problem.start, problem.stop) == (0.0, 1.0)
    assert repr(problem) == "<Problem: t = 0.0 to 1.0; splitting ABA864, step 0.2; 1 event>"
    with pytest.raises(AttributeError):
        problem.stop = 2.0


def test_events_are_pickled_with_their_functions():
    again = pickle.loads(pickle.dumps(Event("g2", middle, "rising", True, 1.5)))
    assert again.function is middle
    assert (again.name, again.crossing, again.stops, again.period) == (
        "g2",
        Crossing.rising,
        True,
        1.5,
    )


def test_a_problem_is_pickled_with_its_system():
    problem = Problem(moon(), START, 0.0, 10.0, Splitting(0.1), [Event("g2", middle)])
    again = pickle.loads(pickle.dumps(problem))
    assert repr(again) == repr(problem) and again.method == problem.method
    assert integrate(again).states == integrate(problem).states


def test_a_cycle_through_a_problem_is_collected():
    def cycle():
        def function(t, s):
            return problem.stop

        problem = Problem(moon(), START, 0, 1, events=[Event("x", function)])
        return weakref.ref(function)

    alive = cycle()
    assert alive() is not None
    gc.collect()
    assert alive() is None


def test_state_transitions_of_free_rotation_are_exact():
    exact = FreeRotation(BODY, START)
    for method in METHODS:
        rows = state_transitions(Problem(System(BODY), START, 0.0, 10.0, method), [0, 4, 10])
        assert rows.transition.shape == (3, 6, 6) and len(rows) == 3
        assert distance(rows.states, exact.at(rows.t)) < budgets.adaptive_short_run
        expected = exact.state_transition(rows.t)
        error = np.abs(rows.transition - expected).max() / np.abs(expected).max()
        assert error < budgets.transition_free
    assert np.array_equal(rows.transition[0], np.eye(6))


def test_state_transitions_are_views():
    rows = state_transitions(Problem(moon(), START, 0.0, 1.0), [0.0, 0.5, 1.0])
    again = pickle.loads(pickle.dumps(rows))
    matrices, t, q = rows.transition, rows.t, rows.states.q
    assert not matrices.flags.writeable and np.shares_memory(matrices, rows.transition)
    copied = matrices.copy(), t.copy(), q.copy()
    del rows
    gc.collect()
    for view, was in zip((matrices, t, q), copied):
        assert np.array_equal(view, was)
    assert np.array_equal(again.transition, matrices) and np.array_equal(again.t, t)


def spring(t, s):
    z = polhode.charts.attitude_matrix(s.q)[2]
    return 0.2 * z[0] * z[0]


def test_state_transitions_of_an_energy_in_python_are_derivatives():
    system = System(BODY, terms=[HamiltonianTerm(spring)])

    fine = Adaptive(1e-14)

    def last(g, method=fine):
        return integrate(Problem(system, RotorState(START.q, g), 0.0, 3.0, method), [3.0]).g[0]

    problem = Problem(system, START, 0.0, 3.0, fine)
    transition = state_transitions(problem, [3.0]).transition[0]
    h = 1e-4
    for j in range(3):
        step = h * np.eye(3)[j]
        twice = [last(START.g + k * step) - last(START.g - k * step) for k in (1, 2)]
        slope = (8 * twice[0] - twice[1]) / (12 * h)  # error of order h^4
        error = np.abs(slope - transition[3:, 3 + j]).max() / np.abs(transition).max()
        assert error < budgets.transition_difference
    wide = last(START.g, Adaptive(1e-16, "double_double"))
    assert np.abs(wide - last(START.g)).max() < budgets.adaptive_short_run


def test_state_transitions_need_terms_for_derivatives():
    system = System(BODY, terms=[TorqueTerm(lambda t, s: (0.1, 0.0, 0.0), name="jet")])
    with pytest.raises(ValueError, match='"jet"'):
        state_transitions(Problem(system, START, 0.0, 1.0), [1.0])
    with pytest.raises(ValueError, match="1 comes after 5"):
        state_transitions(Problem(moon(), START, 0.0, 9.0), [5.0, 1.0])


def endless(method, events=()):
    system = System(BODY, terms=[ConstantTorque((1e-9, 0.0, 0.0))])
    return Problem(system, START, 0.0, 1e9, method, events)


@pytest.mark.parametrize(
    "method", [*METHODS, Adaptive(1e-28, "double_double")], ids=lambda m: repr(m)[:12]
)
def test_ctrl_c_stops_a_run(method):
    problem = endless(method)
    assert seconds_from_signal(lambda: integrate(problem, [], dense=False)) < LATEST


def test_ctrl_c_stops_everything_that_takes_long():
    watched = endless(Adaptive(), [Event("g2", middle)])
    assert seconds_from_signal(lambda: integrate(watched, [], dense=False)) < LATEST
    one_step = Problem(System(BODY), START, 0.0, 1e-6)  # all samples in one step
    many = SaveAt.count(0.0, 1e-6, 10_000_000)
    assert seconds_from_signal(lambda: integrate(one_step, many)) < LATEST
    short = integrate(Problem(moon(), START, 0.0, 1.0))
    assert seconds_from_signal(lambda: short.at(np.linspace(0, 1, 2_000_000))) < LATEST
    problem = endless(Adaptive())
    assert seconds_from_signal(lambda: state_transitions(problem, [1e9])) < LATEST


def test_sigint_from_outside_ends_a_script():
    script = (
        "from polhode import *\n"
        "s = RotorState([1, 0, 0, 0], [0.8, 1.9, 0.3])\n"
        "print('running', flush=True)\n"
        "integrate(Problem(System(Body(1, 2, 2.7)), s, 0, 1e9), [], dense=False)\n"
    )
    package = pathlib.Path(polhode.__file__).parents[1]
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, text=True,
                             env={**os.environ, "PYTHONPATH": str(package)})
    assert child.stdout.readline() == "running\n"
    time.sleep(0.1)
    sent = time.perf_counter()
    child.send_signal(signal.SIGINT)
    _, err = child.communicate(timeout=30 * SLOWDOWN)
    assert time.perf_counter() - sent < 2 * LATEST  # and Python's own end
    assert child.returncode != 0 and "KeyboardInterrupt" in err


def test_runs_leave_the_interpreter_to_other_threads():
    done = threading.Event()

    def run():
        try:
            integrate(Problem(moon(), START, 0.0, 5e3), [], dense=False)
        finally:
            done.set()

    thread = threading.Thread(target=run)
    thread.start()
    turns = 0
    while not done.is_set():
        turns += 1
    thread.join()
    assert turns > 1000


WING_NUT = Body(30.53, 83.87, 113.3)
SPINNING = RotorState([1, 0, 0, 0], [0.01 * 30.53, 6.28 * 83.87, 0])


@EVERY_METHOD
def test_every_method_finds_the_zeros_of_qw(method):
    exact = FreeRotation(WING_NUT, SPINNING)
    q = exact.at(np.linspace(0.0, 40.0, 40001)).q.copy()
    q[1:] *= np.cumprod(np.sign(np.sum(q[1:] * q[:-1], axis=1)))[:, None]
    there = np.count_nonzero(q[1:, 0] * q[:-1, 0] < 0)
    events = [Event("qw", lambda t, s: s.q[0])]
    run = integrate(Problem(System(WING_NUT), SPINNING, 0.0, 40.0, method, events))
    assert len(run.events) == there > 40


def test_free_events_are_found_after_a_billion_turns():
    exact = FreeRotation(WING_NUT, SPINNING)
    half = exact.polhode_period / 2
    flips = polhode.free.free_events(exact, [Event("flip", middle)], 1e9, 1e9 + 100 * half)
    assert len(flips) == 100
    for event in flips:
        assert event.name == "flip" and event.direction in (1, -1)
        a, b = exact.at(np.array([event.t - 1e-6, event.t + 1e-6])).g[:, 1]
        assert a * event.direction < 0 < b * event.direction


def test_free_events_from_a_frame_are_those_of_a_run():
    frame = polhode.Frame.precessing([0, 0.6, 0.8], 1.3, 0.0)
    system = System(WING_NUT, frame)
    motion = FreeRotation(WING_NUT, polhode.charts.inertial_state(system, 0.0, SPINNING))
    events = [Event("flip", middle), Event("qw", lambda t, s: s.q[0], "rising")]
    found = polhode.free.free_events(motion, events, 0.0, 20.0, frame)
    run = integrate(Problem(system, SPINNING, 0.0, 20.0, Adaptive(1e-14), events))
    assert [e.name for e in found] == [e.name for e in run.events]
    times = np.array([e.t for e in found])
    assert np.abs(times - [e.t for e in run.events]).max() < budgets.event_time


def test_free_events_that_cannot_be_say_why():
    exact = FreeRotation(WING_NUT, SPINNING)
    with pytest.raises(TypeError, match="free_events: events: got int; expected Event"):
        polhode.free.free_events(exact, [1], 0.0, 1.0)
    with pytest.raises(TypeError, match="free_events: frame: got int; expected a Frame"):
        polhode.free.free_events(exact, [], 0.0, 1.0, 3)
    with pytest.raises(ValueError, match="interval -1.0 must be positive, or 0 for none"):
        Event("a", middle, interval=-1.0)
    with pytest.warns(RuntimeWarning, match='event "a" is NaN after t = '):
        polhode.free.free_events(exact, [Event("a", lambda t, s: np.sqrt(5.0 - t))], 0.0, 9.0)
    with pytest.raises(ZeroDivisionError):
        polhode.free.free_events(exact, [Event("a", lambda t, s: 1 / 0)], 0.0, 9.0)


def test_a_run_that_continues_another_has_no_event_at_its_start():
    def clock(t, s):
        return t - 2.0

    def events_of(start, stop, continues):
        events = [Event("clock", clock)]
        problem = Problem(System(BODY), START, start, stop, events=events, continues=continues)
        assert problem.continues == continues
        return [event.t for event in integrate(problem, []).events]

    assert events_of(0.0, 2.0, False) == events_of(2.0, 4.0, False) == [2.0]
    assert events_of(2.0, 4.0, True) == []


def test_a_torque_of_arrays_is_called_once_a_sweep():
    calls = []

    def torques(t, s):
        calls.append(np.shape(t))
        return 0.1 * np.sin(t)[:, None] * s.g

    def torque(t, s):
        return 0.1 * np.sin(t) * s.g

    ends = {}
    for name, term in {
        "one": TorqueTerm(torque), "many": TorqueTerm(torques, arrays=True),
        "kick": TorqueTerm(lambda t, s: torques(t, s), arrays=True, kick=True),
    }.items():
        for method in (Adaptive(1e-10), Collocation(1e-10)):
            problem = Problem(System(BODY, terms=[term]), START, 0.0, 3.0, method)
            run = integrate(problem, [3.0], dense=False)
            ends[name, type(method)] = run.states[-1]
            if name == "many" and isinstance(method, Collocation):
                assert (8,) in calls
                assert run.statistics.evaluations == sum(n for (n,) in calls)
            calls.clear()
    for method in (Adaptive, Collocation):
        assert ends["one", method] == ends["many", method] == ends["kick", method]
    with pytest.raises(ValueError, match=r"arrays: got True; expected False"):
        TorqueTerm(torques, arrays=True, switches=lambda t, s: s.g[2])
    wrong = System(BODY, terms=[TorqueTerm(lambda t, s: s.g[:, :2], "jet", arrays=True)])
    with pytest.raises((TypeError, ValueError), match=r"jet.*\(n, 3\) numbers"):
        integrate(Problem(wrong, START, 0.0, 1.0, Collocation()))
