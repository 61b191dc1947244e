# SPDX-License-Identifier: MIT
"""Many bodies in one call: what FreeRotation gives of each, and the same bits in any company."""

import itertools
import re
import threading
import warnings

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from interrupts import LATEST, seconds_from_signal

RANDOM = np.random.default_rng(16)


def moments_of(*shape):
    """Of points of unit mass: always a body."""
    squares = RANDOM.uniform(0.5, 2.0, (*shape, 3))
    return np.stack([squares[..., 1] + squares[..., 2], squares[..., 2] + squares[..., 0],
                     squares[..., 0] + squares[..., 1]], axis=-1)


def states_of(*shape):
    return polhode.RotorState(RANDOM.normal(size=(*shape, 4)), RANDOM.normal(size=(*shape, 3)))


def one_by_one(moments, states, t, t0=0.0, make=polhode.FreeRotation):
    """By a loop and NumPy's own broadcasting."""
    shape = np.broadcast_shapes(np.shape(moments)[:-1], states.shape, np.shape(t), np.shape(t0))
    I = np.broadcast_to(moments, (*shape, 3))
    which = np.broadcast_to(np.arange(states.size).reshape(states.shape), shape)
    t, t0, flat = np.broadcast_to(t, shape), np.broadcast_to(t0, shape), states.reshape(-1)
    q, g = np.empty((*shape, 4)), np.empty((*shape, 3))
    for k in np.ndindex(shape):
        s = make(polhode.Body(*I[k]), flat[which[k]], t0[k]).at(t[k])
        q[k], g[k] = s.q, s.g
    return q, g


def assert_same_bits(states, expected):
    q, g = expected
    assert states.q.shape == q.shape
    assert states.q.tobytes() == q.tobytes()
    assert states.g.tobytes() == g.tobytes()


def assert_close(states, expected):
    q, g = expected
    assert states.q.shape == q.shape
    assert_allclose(states.q, q, atol=budgets.free_many)
    size = np.linalg.norm(g, axis=-1, keepdims=True)
    size[size == 0.0] = 1.0
    assert_allclose(states.g / size, g / size, atol=budgets.free_many)


SHAPES = [(), (1,), (3,), (2, 1), (2, 3)]


@pytest.mark.parametrize(("of_bodies", "of_states"), list(itertools.product(SHAPES, SHAPES)))
def test_states_are_those_of_free_rotation(of_bodies, of_states):
    moments, states = moments_of(*of_bodies), states_of(*of_states)
    for of_times in ((), (3,), (4, 1, 1), (2, 3), (4, 2, 3), (0, 1, 1)):
        t = RANDOM.uniform(-50.0, 50.0, of_times)
        found = polhode.propagate(moments, states, t)
        assert_close(found, one_by_one(moments, states, t))


def test_epochs_and_short_arcs():
    moments, states, t0 = moments_of(3), states_of(3), np.array([0.5, -2.0, 7.0])
    t = np.linspace(0.0, 9.0, 5)[:, np.newaxis]
    assert_close(polhode.propagate(moments, states, t, t0), one_by_one(moments, states, t, t0))
    assert_same_bits(polhode.propagate(moments, states, t, t0, short_arc=True),
                     one_by_one(moments, states, t, t0, polhode.FreeRotation.short_arc))
    # the epochs alone may have axes
    assert_close(polhode.propagate(moments[0], states[0], 3.0, t0),
                 one_by_one(moments[0], states[0], 3.0, t0))


def test_bodies_are_bodies_or_their_moments():
    moments, states = moments_of(2, 3), states_of(2, 3)
    expected = polhode.propagate(moments, states, 2.0)
    nested = [[polhode.Body(*row) for row in rows] for rows in moments]
    array = np.empty((2, 3), object)
    array[:] = nested
    assert polhode.propagate(nested, states, 2.0) == expected
    assert polhode.propagate(tuple(map(tuple, nested)), states, 2.0) == expected
    assert polhode.propagate(array, states, 2.0) == expected
    assert polhode.propagate(moments.tolist(), states, 2.0) == expected
    body = polhode.Body(1.0, 1.7, 2.1)
    assert polhode.propagate(body, states, 2.0).shape == (2, 3)
    alone = polhode.propagate(body, states[0, 0], 2.0)
    whole = polhode.propagate(body, states, 2.0)
    assert alone.q.tobytes() == whole[0, 0].q.tobytes()
    assert alone.shape == ()


def test_regimes_lie_side_by_side():
    """Rest, spins, a sphere, the separatrix and both modes in one array."""
    moments = np.array([[1, 2, 2.5]] * 6 + [[2, 2, 2], [2, 2, 3]], float)
    g = np.array([[0, 0, 0], [0, 0, 1], [0, 1, 0], [0.1, 0.2, 2], [2, 0.2, 0.1],
                  [1, 0, 1.25], [0.1, 0.2, 0.3], [0.1, 0.2, 0.3]], float)
    states = polhode.RotorState([0.5, 0.5, -0.5, 0.5], g)
    t = np.array([0.0, 3.0, 1e6, np.nan, np.inf])[:, np.newaxis]
    found = polhode.propagate(moments, states, t)
    assert_close(found[:3], one_by_one(moments, states, t[:3]))
    assert np.isnan(found[3:].q).all()


def test_bits_depend_on_nothing_beside_a_body():
    moments, states, t = moments_of(37), states_of(37), RANDOM.uniform(-1e6, 1e6, 37)
    together = polhode.propagate(moments, states, t)
    order = RANDOM.permutation(37)
    assert polhode.propagate(moments[order], states[order], t[order]) == together[order]
    assert polhode.propagate(moments[::-1], states[::-1], t[::-1]) == together[::-1]
    for k in range(37):
        assert polhode.propagate(moments[k], states[k], t[k]) == together[k]
        assert polhode.propagate(polhode.Body(*moments[k]), states[k], t[k]) == together[k]


@pytest.mark.parametrize(("bodies", "states", "t", "error", "said"), [
    ([1, 2, 4], ..., 0.0, ValueError, r"break I3 <= I1 \+ I2$"),
    ([1, 2], ..., 0.0, ValueError, r"bodies: got shape \(2,\); expected \(\.\.\., 3\)"),
    (np.ones((3, 3)), polhode.RotorState([1, 0, 0, 0], np.ones((2, 3))), 0.0, ValueError,
     r"bodies of shape \(3,\) and states of shape \(2,\) do not broadcast"),
    (np.ones((3, 3)), ..., [1.0, 2.0], ValueError,
     r"bodies and states of shape \(3,\) and t of shape \(2,\) do not broadcast"),
    ([polhode.Body(1, 1, 1), None], ..., 0.0, TypeError,
     r"bodies: got a NoneType; expected a Body \(at index \(1,\)\)"),
    ([[polhode.Body(1, 1, 1)], []], ..., 0.0, TypeError, r"a ragged list; .* \(at index \(1,\)\)"),
    ([polhode.Body(1, 1, 1), [polhode.Body(1, 1, 1)]], ..., 0.0, TypeError, "a ragged list"),
    ([[polhode.Body(1, 1, 1)], polhode.Body(1, 1, 1)], ..., 0.0, TypeError, "a ragged list"),
    ((polhode.Body(1, 1, 1) for _ in range(2)), ..., 0.0, TypeError,
     "bodies: got a generator; expected a Body, a sequence of them or moments"),
    (np.ones((2, 3)), ..., "noon", TypeError, "t: got a str; expected real numbers"),
])
def test_what_cannot_be_done_says_where(bodies, states, t, error, said):
    one = polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])
    with pytest.raises(error, match=said):
        polhode.propagate(bodies, one if states is ... else states, t)


@pytest.mark.parametrize("short_arc", [False, True])
@pytest.mark.parametrize(("bodies", "g", "index", "reason"), [
    ([[1, 2, 2.5], [1, 2, 4]], [0.1, 0.2, 1.0], (1,),
     r"Body: moments \(1, 2, 4\) break I3 <= I1 \+ I2"),
    ([[[1, 2, 2.5], [1, -2, 2]]], [0.1, 0.2, 1.0], (0, 1),
     r"Body: moments \(1, -2, 2\) must be positive and finite"),
    ([1e-300, 1e-300, 1e-300], [[0, 0, 1e-300], [0, 0, 1e300]], (1,),
     r".* is a rate too large for a double"),
    ([1, 2, 2.5], [[0.1, 0.2, 1.0], [0, 0, 1e-313]], (1,), r".* is a rate too small for a double"),
])
def test_a_body_that_fails_fails_alone(bodies, g, index, reason, short_arc):
    states = polhode.RotorState([1, 0, 0, 0], g)
    at = re.escape(f"(at index {index})")
    with pytest.warns(RuntimeWarning, match=rf"1 of 2 states are NaN; the first: {reason} {at}"):
        found = polhode.propagate(bodies, states, 0.5, short_arc=short_arc)
    failed = np.zeros(found.shape, bool)
    failed[index] = True
    assert np.array_equal(np.isnan(found.q).all(axis=-1), failed)
    assert np.array_equal(np.isnan(found.g).all(axis=-1), failed)
    errors = np.full(found.shape, "before", object)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = polhode.propagate(bodies, states, 0.5, short_arc=short_arc, errors=errors)
    assert again.q.tobytes() == found.q.tobytes()
    assert re.fullmatch(reason, errors[index]) and list(errors[~failed]) == [None]


def test_errors_is_an_array_of_objects_of_the_shape():
    one = polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])
    with pytest.raises(TypeError, match="errors: got a list; expected an array of objects"):
        polhode.propagate(np.ones((2, 3)), one, 0.0, errors=[None, None])
    with pytest.raises(ValueError, match=r"errors: got shape \(3,\); expected that of the result"):
        polhode.propagate(np.ones((2, 3)), one, 0.0, errors=np.empty(3, object))


def test_ctrl_c_ends_it():
    moments, states = moments_of(400_000), states_of(400_000)

    def forever():
        while True:
            polhode.propagate(moments, states, 1.0)

    assert seconds_from_signal(forever) < LATEST


def test_other_threads_go_on():
    """They compute in turn with a thread that only looks at a clock."""
    moments, states, done = moments_of(20_000), states_of(20_000), []
    times = np.linspace(0.0, 1.0, 50)[:, np.newaxis]  # long enough to be looked at
    thread = threading.Thread(target=lambda: done.append(polhode.propagate(moments, states, times)))
    thread.start()
    ticks = 0
    while thread.is_alive():
        ticks += 1
    thread.join()
    assert ticks > 1000
    assert done[0] == polhode.propagate(moments, states, times)
