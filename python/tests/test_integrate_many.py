# SPDX-License-Identifier: MIT
"""Many problems together: the runs that each has alone, and failures that stay alone."""

import _thread
import threading
import warnings

import numpy as np
import polhode
import pytest

ORBIT = polhode.KeplerOrbit(polhode.KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
GRAVITY = polhode.GravityGradient(ORBIT, 1.0)
TIMES = [0.5, 2.0, 4.0]


def problem(k, method=None, terms=(GRAVITY,), stop=4.0, **more):
    system = polhode.System(polhode.Body(0.9, 1.0 + 0.01 * k, 1.1), terms=list(terms))
    state = polhode.RotorState([1, 0.1 * k, 0, 0.2], [4.5 - 0.2 * k, 4.0, 8.25])
    return polhode.Problem(system, state, 0.0, stop, method or polhode.Collocation(), **more)


@pytest.mark.parametrize("method", [polhode.Collocation(), polhode.Adaptive(1e-10)])
def test_runs_on_threads_are_those_of_each_alone(method):
    problems = [problem(k, method) for k in range(11)]
    for run, alone in zip(polhode.integrate_many(problems, TIMES), problems, strict=True):
        expected = polhode.integrate(alone, TIMES)
        np.testing.assert_array_equal(run.t, expected.t)
        np.testing.assert_array_equal(run.q, expected.q)
        np.testing.assert_array_equal(run.g, expected.g)
        assert run.statistics.steps == expected.statistics.steps


def test_dense_output_answers_where_it_is_asked_for():
    problems = [problem(k) for k in range(3)]
    for run, alone in zip(polhode.integrate_many(problems, dense=True), problems, strict=True):
        np.testing.assert_array_equal(run.at(1.2345).q, polhode.integrate(alone).at(1.2345).q)
    with pytest.raises(ValueError, match="dense"):
        polhode.integrate_many(problems)[0].at(1.0)


def test_a_damper_goes_too():
    body = polhode.Body(1.0, 2.0, 2.7)
    damper = polhode.KaneDamper(0.1, 0.05)
    state = polhode.RotorState([1, 0, 0, 0], [0.2, 1.0, 2.0])
    damped = polhode.Problem(polhode.System(body, damper=damper), state, 0.0, 4.0)
    runs = polhode.integrate_many([problem(0), damped, problem(1)], TIMES)
    np.testing.assert_array_equal(runs[1].damper_rate, polhode.integrate(damped, TIMES).damper_rate)


def test_a_body_fails_alone():
    def push(t, state):
        if t > 2.0:
            raise LookupError("no field here")
        return 0.0 * state.g

    problems = [problem(k) for k in range(4)]
    problems[2] = problem(2, terms=[GRAVITY, polhode.TorqueTerm(push)])
    with pytest.warns(RuntimeWarning, match=r"1 of 4 runs failed; the first was body 2 at t = 1\."):
        runs = polhode.integrate_many(problems, TIMES)
    assert isinstance(runs[2], LookupError)
    assert [isinstance(run, polhode.Trajectory) for run in runs] == [True, True, False, True]


def test_a_run_that_cannot_go_on_keeps_its_samples():
    problems = [problem(0), problem(1, polhode.Collocation(step=3.0), stop=10.0)]
    with pytest.warns(RuntimeWarning, match="body 1 at t = 0.*do not converge"):
        runs = polhode.integrate_many(problems)
    assert not runs[1].outcome.ok
    assert runs[0].outcome.ok


def test_events_of_each():
    height = polhode.Event("height", lambda t, s: s.g[2] - 8.0)
    problems = [problem(k, stop=20.0, events=(height,)) for k in range(3)]
    for run, alone in zip(polhode.integrate_many(problems, []), problems, strict=True):
        expected = polhode.integrate(alone, [])
        assert [e.t for e in run.events] == [e.t for e in expected.events]
        assert len(run.events) > 1


def test_refuses_what_is_no_problem():
    with pytest.raises(TypeError, match="problems: got int among them; expected Problem"):
        polhode.integrate_many([problem(0), 3])
    assert polhode.integrate_many([]) == []


def test_the_first_failure_is_that_of_the_first_body_whatever_the_thread():
    problems = [problem(0, stop=200.0), *(problem(k, stop=1.0) for k in range(1, 12))]
    for k in (0, 3, 7):
        problems[k] = problem(k, polhode.Collocation(step=3.0), stop=200.0)
    with pytest.warns(RuntimeWarning, match="3 of 12 runs failed; the first was body 0 at t = 0"):
        runs = polhode.integrate_many(problems)
    assert [k for k, run in enumerate(runs) if not run.outcome.ok] == [0, 3, 7]


def test_what_no_body_catches_ends_all():
    def push(t, state):
        raise SystemExit("enough")

    problems = [problem(k, terms=[polhode.TorqueTerm(push)]) for k in range(5)]
    with pytest.raises(SystemExit, match="enough"):
        polhode.integrate_many(problems)


def test_ctrl_c_ends_them():
    problems = [problem(k, stop=1e7) for k in range(9)]
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    with warnings.catch_warnings(), pytest.raises(KeyboardInterrupt):
        warnings.simplefilter("error")
        polhode.integrate_many(problems, [1e7])
    timer.join()
