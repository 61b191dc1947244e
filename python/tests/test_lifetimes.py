# SPDX-License-Identifier: MIT
"""What keeps what alive: scripts that end without a word, cycles that are collected, memory that
does not grow."""

import gc
import subprocess
import sys
import warnings
import weakref

import numpy as np
import polhode as p
import pytest

BODY = p.Body(1, 2, 2.5)
START = p.RotorState([1, 0, 0, 0], [1, 2, 3])

PREAMBLE = """
import gc, threading, time
import numpy as np
import polhode as p
body, start = p.Body(1, 2, 2.5), p.RotorState([1, 0, 0, 0], [1, 2, 3])
"""

VIEWS = """
def damper(t, s):
    return -0.1 * s.g
system = p.System(body, p.Frame.orbit_plane(lambda t: 0.1 * t, 0.2), p.TorqueTerm(damper))
event = p.Event("node", lambda t, s: s.g[0] - 0.97)
run = p.integrate(p.Problem(system, start, 0.0, 0.1, events=[event]))
for t, q in zip(run.t, run.q):
    pass
states, some, first = run.states, run.states[1:].q, run.events[0].s.q
steps, table = iter(run.states), run.columns(["andoyer"], system)
inside = run.at([0.02, 0.05]).g
frame = system.frame.at([0.0, 1.0]).q_IS
print(len(run.events))
"""

CHARTS = """
kept = p.TorqueTerm(lambda t, s: views)
many = p.RotorState(np.tile([1.0, 0.1, 0.2, 0.3], (3, 1)), np.tile([1.0, 2.0, 3.0], (3, 1)))
views, classes = [], set()
for name in dir(p):
    for arguments in (many,), (body, many), (many[0],), (body, many[0]):
        try:
            state = getattr(p, name)(*arguments) if name.startswith("to_") else many
        except TypeError:
            continue
        if not hasattr(state, "reshape"):
            continue
        classes.add(type(state))
        views += [getattr(state, field) for field in dir(state) if field[0] != "_"]
        views += [state, state.reshape((-1,))[::2]]
print(len(classes) > 6)
"""

# Threads that are still at it when the interpreter ends.
DAEMON = """
system = p.System(body, terms=p.{term})
problem = p.Problem(system, start, 0.0, 1e7)
many = p.RotorState(np.tile([1.0, 0, 0, 0], (300000, 1)), np.tile([1.0, 2, 3], (300000, 1)))
def convert():
    while True:
        p.to_andoyer(many)
def integrate():
    p.integrate(problem, [0.0], dense=False)
for work in convert, integrate, integrate:
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.1)
print("ends")
"""

# Each state of a chain used to keep the one before alive: freed at once, that overflows a stack.
CHAIN = """
many = p.RotorState(np.tile([1.0, 0, 0, 0], (60000, 1)), np.tile([1.0, 2, 3], (60000, 1)))
for _ in range(50000):
    many = many[1:]
print(len(many))
"""


@pytest.mark.parametrize(("script", "printed"), [
    pytest.param(VIEWS, "1", id="views"),
    pytest.param(CHARTS, "True", id="charts"),
    pytest.param(DAEMON.format(term="LinearDamping(1e-9)"), "ends", id="daemon"),
    pytest.param(DAEMON.format(term="TorqueTerm(lambda t, s: -1e-9 * s.g)"), "ends",
                 id="daemon in Python"),
    pytest.param(CHAIN, "10000", id="chain"),
])
def test_a_script_ends_without_complaint(script, printed):
    run = subprocess.run([sys.executable, "-c", PREAMBLE + script], capture_output=True, text=True)
    assert (run.returncode, run.stdout.strip(), run.stderr) == (0, printed, "")


class Mark:
    """Something that a weak reference can watch."""


def is_collected(make):
    """Whether what make(mark) leaves behind, which holds the mark, is found to be garbage."""
    mark = Mark()
    watch = weakref.ref(mark)
    make(mark)
    del mark
    gc.collect()
    return watch() is None


def run_of(function, dense=True):
    return p.integrate(p.Problem(p.System(BODY, terms=p.TorqueTerm(function)), START, 0.0, 0.1),
                       dense=dense)


def a_view(of):
    def make(mark):
        box = {}
        box["view"] = of(run_of(lambda t, s: (box, mark, -s.g)[-1]))
    return make


VIEWS_OF_A_RUN = {
    "t": lambda run: run.t,
    "q": lambda run: run.q,
    "states": lambda run: run.states,
    "field": lambda run: run.states.g,
    "part": lambda run: run.states[1:].q,
    "item": lambda run: run.states[0],
    "iterator": lambda run: iter(run.states),
    "at": lambda run: run.at([0.05]).q,
    "column": lambda run: run.columns()["qw"],
    "the run": lambda run: run,
    "all": lambda run: (run, run.t, run.states, run.events, run.outcome),
}


@pytest.mark.parametrize("of", VIEWS_OF_A_RUN.values(), ids=VIEWS_OF_A_RUN)
def test_a_term_that_refers_to_a_view_of_its_run_is_collected(of):
    assert is_collected(a_view(of))


def test_an_object_whose_methods_are_its_torques_is_collected():
    class Craft:
        def __init__(self, mark):
            self.mark = mark
            frame = p.Frame.orbit_plane(self.node, 0.1)
            terms = [p.TorqueTerm(self.torque), p.GravityGradient(self.orbit, 1.0)]
            self.system = p.System(BODY, frame, terms)
            self.problem = p.Problem(self.system, START, 0.0, 0.1,
                                     events=[p.Event("node", lambda t, s: self.node(t))])
            self.run = p.integrate(self.problem)
            self.q, self.axes = self.run.q, frame.at([0.0, 1.0]).q_IS

        def torque(self, t, s):
            return -s.g

        def node(self, t):
            return 0.1 * t

        def orbit(self, t):
            return [1, 2, 3]

    assert is_collected(Craft)


@pytest.mark.parametrize("base", [p.RotorState, p.TorqueTerm, p.System, p.Event, p.Problem, p.Body])
def test_an_object_that_was_never_made_is_collected(base):
    class Own(base):
        def __init__(self, mark):
            self.me, self.mark = self, mark
            super().__init__(mark)

    def make(mark):
        with pytest.raises((TypeError, ValueError)):
            Own(mark)

    assert is_collected(make)


def test_a_state_that_keeps_its_own_fields_is_collected():
    class Own(p.RotorState):
        pass

    def make(mark):
        state = Own([1, 0, 0, 0], [1, 2, 3])
        state.mark, state.momentum, state.part = mark, state.g, state.reshape((1,))

    assert is_collected(make)


def test_views_outlive_everything_else():
    run = run_of(lambda t, s: -s.g)
    whole = run.q.copy()
    q, part, item = run.q, run.states[1:][::2].q, run.states[-1].q
    del run
    gc.collect()
    assert (q == whole).all()
    assert (part == whole[1::2]).all()
    assert (item == whole[-1]).all()


def test_a_run_answers_when_all_it_was_made_of_is_gone():
    run = run_of(lambda t, s: -s.g)
    before = run.at([0.02, 0.05])
    gc.collect()
    assert run.at([0.02, 0.05]) == before


def raises(system):
    with pytest.raises(ZeroDivisionError):
        p.rates.effect(system, 0.0, START)


def blocks():
    gc.collect()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # from Python 3.13 on
        sys._clear_type_cache()  # which keeps up to 4096 names of attributes alive
    return sys.getallocatedblocks()


def test_memory_does_not_grow():
    """Blocks that Python has allocated, over calls of every family, refused ones too."""
    many = p.RotorState(np.tile(START.q, (40, 1)), np.tile(START.g, (40, 1)))
    times = np.linspace(0.0, 0.1, 40)
    term = p.TorqueTerm(lambda t, s: -s.g)
    system = p.System(BODY, p.Frame.orbit_plane(lambda t: 0.1 * t, 0.2), term)
    broken = p.System(BODY, terms=p.TorqueTerm(lambda t, s: 1 / 0))
    run = p.integrate(p.Problem(system, START, 0.0, 0.1))
    free = p.FreeRotation(BODY, START)
    calls = [
        lambda: p.RotorState(many.q, many.g),
        lambda: (many[3], many[2:9], many[[1, 2]], many.reshape((4, 10)), many == many),
        lambda: p.to_rotor(p.to_andoyer(many)),
        lambda: (run.t, run.q, run.states.g, run.at(times), run.at(0.05), run.events, repr(run)),
        lambda: free.at(times),
        lambda: p.System(BODY, system.frame, [p.TorqueTerm(lambda t, s: s.g)]),
        lambda: p.rates.effect(system, times, many),
        lambda: p.integrate(p.Problem(system, START, 0.0, 0.01)),
        lambda: raises(broken),
    ]
    for call in calls:
        call()
        before = blocks()
        for _ in range(60):
            call()
        assert blocks() - before < 30
