#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Counts the events that every method finds of those that there are, and writes
docs/accuracy/events.md. Needs the Python package of the build tree (PYTHONPATH)."""

import pathlib
import time

import numpy as np
import polhode
from polhode import (
    Adaptive,
    Collocation,
    Event,
    Problem,
    RotorState,
    Splitting,
    System,
    VariationOfConstants,
)

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/accuracy/events.md"
LOOKS = 200_000

HEAD = """\
# How many events are found

This page is written by `tools/accuracy/events.py`.

A run finds zeros of a function of time and state on the dense output of its steps, which it looks
at as often as the body turns ([what is found](../guide/which-propagator.md#events)). *There are*
as many as a count without that search finds: changes of sign between {looks:,} equal times; a zero
at the start counts. Where the body is free the states at those times are those of the closed form.
Elsewhere they are those of our own `Adaptive` at a tolerance of 1e-15: there the count is
independent of the search for events, but not of the integrator. The functions are
{functions}.

| body | span | there are |{methods} |
|---|---|---|{rule}
"""

TIMES = """
## When

The largest difference of the time of an event from that of the closed form, or of `Adaptive` at
1e-15. Next to its middle axis, or in a strong field, a body makes an error of its state larger at
every turn: these times show the error of the run.

| body |{methods} |
|---|{rule}
"""

FREE = """
## On the closed form

What `free_events` finds of the wing nut from a time on, each event to the rounding of the time; the
spacing of doubles there stands next to it. Flips are half a period of the polhode apart.

| from t = | turns | there are | found | uneven by (s) | spacing of doubles (s) | ms |
|---|---|---|---|---|---|---|
"""


def axis(s, k):
    """The z of a body axis."""
    w, x, y, z = s.q
    return (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z)[k]


FUNCTIONS = {
    "a component of q": lambda t, s: s.q[0],
    "q_x - 0.3": lambda t, s: s.q[1] - 0.3,
    "the momentum along axis 2 (a flip)": lambda t, s: s.g[1],
    "the height of axis 1": lambda t, s: axis(s, 0),
    "the product of the heights of axes 1 and 3 less 0.1":
        lambda t, s: axis(s, 0) * axis(s, 2) - 0.1,
}


def arrays(q, g):
    """The same functions of many states."""
    w, x, y, z = q.T
    one, three = 2 * (x * z - w * y), w * w - x * x - y * y + z * z
    return [w, x - 0.3, g[:, 1], one, one * three - 0.1]


def gravity(body, strength, frame=None):
    orbit = polhode.KeplerOrbit(polhode.KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
    return System(body, frame, [polhode.GravityGradient(orbit, strength)])


WING_NUT = polhode.Body(30.53, 83.87, 113.3)
TUMBLER = polhode.Body(0.61, 0.965, 1.0)
W1 = polhode.Body(0.9, 1.0, 1.1)
CASES = {
    "wing nut, free": (
        System(WING_NUT), RotorState([1, 0, 0, 0], [0.3053, 526.7036, 0]), 20.0),
    "tumbler, free": (System(TUMBLER), RotorState([0.5, 0.5, -0.5, 0.5], [0.3, 0.5, 0.9]), 200.0),
    "W1, ten orbits": (gravity(W1, 1.0), RotorState([1, 0, 0, 0], [4.5, 4.0, 8.25]), 62.8),
    "tumbler in a gravity gradient, from a turning frame": (
        gravity(TUMBLER, 0.01, polhode.Frame.precessing([0, 0, 1], 0.5, 0.0)),
        RotorState([0.5, 0.5, -0.5, 0.5], [0.2, 0.3, 0.9]), 200.0),
    "libration in the gravity gradient": (
        gravity(polhode.Body(0.8, 1.0, 1.2), 1.0, polhode.Frame.precessing([0, 0, 1], 1.0, 0.0)),
        RotorState([0.98, 0.01, 0.02, 0.2], [0.0, 0.02, 1.25]), 60.0),
}
METHODS = {
    "Collocation 1e-12": Collocation(1e-12),
    "Adaptive 1e-12": Adaptive(1e-12),
    "Adaptive 1e-6": Adaptive(1e-6),
    "Variation 1e-12": VariationOfConstants(1e-12),
    "Splitting 0.05": Splitting(0.05),
    "Splitting 0.5": Splitting(0.5),
}


def counted(system, start, stop):
    """Changes of sign of every function, q continuous, and how many of each."""
    times = np.linspace(0.0, stop, LOOKS + 1)
    if not system.terms and system.frame.is_inertial:
        states = polhode.FreeRotation(system.body, start).at(times)
    else:
        states = polhode.integrate(Problem(system, start, 0.0, stop, Adaptive(1e-15)), times,
                                   dense=False).states
    q, g = states.q.copy(), states.g.copy()
    q[0], g[0] = start.q, start.g  # without a rounding: a zero there counts
    q[1:] *= np.cumprod(np.sign(np.sum(q[1:] * q[:-1], axis=1)))[:, None]
    return [np.count_nonzero(f[1:] * f[:-1] < 0) + (f[0] == 0.0) for f in arrays(q, g)]


def events():
    return [Event(name, function) for name, function in FUNCTIONS.items()]


def reference(system, start, stop):
    if not system.terms and system.frame.is_inertial:
        return polhode.free.free_events(
            polhode.FreeRotation(system.body, start), events(), 0.0, stop
        )
    problem = Problem(system, start, 0.0, stop, Adaptive(1e-15), events())
    return polhode.integrate(problem, []).events


def shift(found, best):
    """The largest difference of times, where both have as many of each."""
    moved = []
    for name in FUNCTIONS:
        a = np.array([e.t for e in found if e.name == name])
        b = np.array([e.t for e in best if e.name == name])
        if len(a) != len(b):
            return None
        moved.append(np.abs(a - b))
    return np.concatenate(moved).max(initial=0.0)  # NaN stays


def free_rows():
    motion = polhode.FreeRotation(WING_NUT, CASES["wing nut, free"][1])
    half = motion.polhode_period / 2
    turn = 2 * np.pi / motion.precession_rate_short
    for start in (0.0, 1e3, 1e6, 1e9, 1e12):
        begun = time.process_time()
        flips = polhode.free.free_events(motion, [Event("flip", lambda t, s: s.g[1])], start,
                                    start + 100 * half)
        spent = time.process_time() - begun
        gaps = np.diff([e.t for e in flips])
        yield (f"| {start:g} | {100 * half / turn:.0f} | 100 | {len(flips)} | "
               f"{np.abs(gaps - half).max():.1e} | {np.spacing(start + 50 * half):.1e} | "
               f"{1e3 * spent:.1f} |\n")


def main():
    found_rows, time_rows = [], []
    for name, (system, start, stop) in CASES.items():
        there = counted(system, start, stop)
        best = reference(system, start, stop)
        cells, times = [], []
        for method in METHODS.values():
            run = polhode.integrate(Problem(system, start, 0.0, stop, method, events()), [])
            count = [sum(e.name == f for e in run.events) for f in FUNCTIONS]
            cells.append(str(sum(min(a, b) for a, b in zip(count, there, strict=True)))
                         + (f" (+{more})" if (more := sum(
                             max(a - b, 0) for a, b in zip(count, there, strict=True))) else ""))
            moved = shift(run.events, best)
            times.append("other events" if moved is None else f"{moved:.1e}")
        found_rows.append(f"| {name} | {stop:g} | {sum(there)} | {' | '.join(cells)} |\n")
        time_rows.append(f"| {name} | {' | '.join(times)} |\n")
    heads = {"methods": "".join(f" {name} |" for name in METHODS).removesuffix(" |"),
             "rule": "---|" * len(METHODS)}
    names = list(FUNCTIONS)
    PAGE.write_text(
        HEAD.format(looks=LOOKS, functions=", ".join(names[:-1]) + " and " + names[-1], **heads)
        + "".join(found_rows) + TIMES.format(**heads) + "".join(time_rows) + FREE
        + "".join(free_rows()), encoding="utf-8")


if __name__ == "__main__":
    main()
