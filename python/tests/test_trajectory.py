# SPDX-License-Identifier: MIT
"""What a run leaves behind: views without copies, dense output, tables, pickles."""

import copy
import gc
import pickle
import sys

import budgets
import numpy as np
import polhode
import pytest
from polhode import (
    Body,
    Event,
    Frame,
    FreeRotation,
    GravityGradient,
    KeplerElements,
    KeplerOrbit,
    Problem,
    RotorState,
    SaveAt,
    System,
    TorqueTerm,
    Trajectory,
    VariationOfConstants,
    integrate,
)
from rejections import rejected

BODY = Body(1.0, 2.0, 2.7)
START = RotorState([0.5, 0.5, -0.5, 0.5], [0.8, 1.9, 0.3])
TIMES = np.linspace(0.0, 10.0, 41)


def system() -> System:
    orbit = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
    return System(BODY, terms=[GravityGradient(orbit, 0.3)])


def run(samples=TIMES, dense=True, **options) -> Trajectory:
    return integrate(Problem(system(), START, 0.0, 10.0, **options), samples, dense)


def test_samples_are_read_only_views_without_a_copy():
    r = run()
    assert r.t.shape == (41,) and r.q.shape == (41, 4) and r.g.shape == (41, 3)
    assert r.states.shape == (41,) and len(r) == 41
    for view, again in [(r.t, r.t), (r.q, r.states.q), (r.g, r.states.g), (r.q, r.states[3:].q)]:
        assert np.shares_memory(view, again)
        assert not view.flags.writeable
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 0.0
    assert r.t.strides == (88,)  # of the samples of C++: t, q, g, damper_rate
    assert np.array_equal(r.t, TIMES)
    assert np.abs(np.linalg.norm(r.q, axis=1) - 1).max() < 4 * np.finfo(float).eps


def test_views_keep_the_samples_alive():
    r = run()
    kept = r.t, r.q, r.g, r.states
    copies = r.t.copy(), r.q.copy(), r.g.copy()
    del r
    for _ in range(3):  # what would take the room of samples that are gone
        run()
        gc.collect()
    for view, was in zip(kept, copies):
        assert np.array_equal(view, was)
    assert np.array_equal(kept[3].q, copies[1])
    assert np.array_equal(kept[3][5].g, copies[2][5])


@pytest.mark.parametrize("shape", [(), (1,), (7,), (2, 3), (0,), (50, 2)])
def test_at_takes_any_shape(shape):
    r = run()
    t = np.random.default_rng(7).uniform(0, 10, shape)
    states = r.at(t)
    assert states.shape == shape
    for index in np.ndindex(shape):
        assert states[index] == r.at(float(t[index]))


def test_at_is_between_the_samples_what_it_is_at_them():
    r = run()
    again = r.at(r.t)
    assert np.abs(again.q - r.q).max() < budgets.adaptive_dense
    fine = integrate(Problem(system(), START, 0.0, 10.0, VariationOfConstants()), TIMES + 1e-3)
    between = r.at(TIMES[:-1] + 1e-3)
    assert np.abs(between.q - fine.q).max() < budgets.adaptive_dense
    exact = FreeRotation(BODY, START)
    free = integrate(Problem(System(BODY), START, 0.0, -10.0))
    t = np.linspace(0.0, -10.0, 1001)
    assert np.abs(free.at(t).g - exact.at(t).g).max() < budgets.adaptive_dense


@pytest.mark.parametrize(("t", "error", "words"), [
    (10.1, ValueError, "t = 10.1 must be from 0 to 10"),
    ([1.0, -0.1], ValueError, "t = -0.1 must be from 0 to 10"),
    (np.full(100, np.nan), ValueError, "t = nan must be from 0 to 10"),
    ("now", TypeError, "t: got a str; expected real numbers"),
    (None, TypeError, "t: got None; expected numbers"),
])
def test_at_says_what_it_cannot_do(t, error, words):
    with pytest.raises(error) as raised:
        run().at(t)
    assert words in str(raised.value)


def test_a_run_without_dense_output_says_so():
    r = run(dense=False)
    assert not r.has_dense and run().has_dense
    assert r.at(0.0) == START
    rejected(ValueError, "no dense output", r.at, 5.0)


class Model:
    """A cycle: the model holds its run's system, whose term holds the model."""

    def __init__(self):
        self.system = System(BODY, terms=[TorqueTerm(self.torque)])

    def torque(self, t, s):
        return 0.1, 0.0, 0.0

    def run(self):
        return integrate(Problem(self.system, START, 0.0, 10.0), TIMES)


def test_dense_output_keeps_the_terms_alive_that_it_asks():
    r = Model().run()
    gc.collect()
    assert np.abs(r.at(TIMES).g - r.g).max() < budgets.adaptive_dense
    del r
    gc.collect()
    assert not any(isinstance(thing, Model) for thing in gc.get_objects())


def test_a_trajectory_without_samples():
    r = run([])
    assert len(r) == 0
    assert r.t.shape == (0,) and r.q.shape == (0, 4) and r.g.shape == (0, 3)
    assert r.states.shape == (0,)
    assert r.at(10.0).shape == ()
    assert len(pickle.loads(pickle.dumps(r))) == 0
    assert r.columns("omega", system())["w1"].shape == (0,)


def test_a_pickle_holds_all_but_dense_output():
    r = run(events=[Event("g2", lambda t, s: s.g[1])])
    again = pickle.loads(pickle.dumps(r))
    assert np.array_equal(again.t, r.t) and again.states == r.states
    assert repr(again) == repr(r) and repr(again.events) == repr(r.events)
    assert [e.s for e in again.events] == [e.s for e in r.events]
    assert (again.start, again.stop, again.method) == (r.start, r.stop, r.method)
    assert repr(again.statistics) == repr(r.statistics)
    assert again.outcome.ok and again.outcome.t == 10.0
    assert again.at(0.0) == START
    rejected(ValueError, "no dense output", again.at, 5.0)
    assert pickle.loads(pickle.dumps(again)).states == r.states


def test_copies_of_what_cannot_change_are_itself():
    r = run()
    assert copy.copy(r) is r and copy.deepcopy([r])[0] is r
    with pytest.raises(AttributeError):
        r.t = np.zeros(3)


def test_what_a_trajectory_shows():
    r = run(events=[Event("g2", lambda t, s: s.g[1], stops=True)])
    (event,) = r.events
    assert repr(r) == (
        f"<Trajectory: {len(r)} samples, t = 0.0 to {r.stop}; collocation, tolerance 1e-12, "
        f"{r.statistics.steps} steps; 1 event; stopped by an event at t = {r.stop}>"
    )
    assert repr(event) == f"<EventRecord: g2 at t = {event.t}, falling>"
    assert repr(r.outcome) == f"<Outcome: stopped by an event at t = {r.stop}>"
    assert r.statistics.evaluations > r.statistics.steps > 0


def test_nobody_makes_a_trajectory_by_hand():
    with pytest.raises(TypeError):
        Trajectory()


def test_columns_are_what_the_functions_give():
    r, s = run(), system()
    table = r.columns(["andoyer", "omega", "theta", "energy", "q", "omega"], s)
    assert " ".join(table) == "t qw qx qy qz g1 g2 g3 l g h L G H w1 w2 w3 theta E dE"
    assert np.array_equal(table["t"], r.t)
    assert np.array_equal(np.stack([table[n] for n in ("qw", "qx", "qy", "qz")], 1), r.q)
    assert np.array_equal(np.stack([table[n] for n in ("g1", "g2", "g3")], 1), r.g)
    andoyer = polhode.to_andoyer(r.states)
    assert all(np.array_equal(table[n], getattr(andoyer, n)) for n in "lghLGH")
    omega = polhode.angular_velocity(BODY, r.states)
    assert np.array_equal(np.stack([table[n] for n in ("w1", "w2", "w3")], 1), omega)
    assert np.array_equal(table["theta"], polhode.to_euler(r.states).theta)
    assert table["dE"][0] == 0.0 and np.array_equal(table["dE"], table["E"] - table["E"][0])
    assert list(r.columns()) == list(table)[:8]
    assert list(r.columns("theta", s))[8:] == ["theta"]


# The file's columns of such a body are along the tensor's axes; here all is along the axes of r.g.
def test_columns_are_along_principal_axes():
    turned = Body.from_tensor([[1.36, -0.48, 0.0], [-0.48, 1.64, 0.0], [0.0, 0.0, 2.5]])
    s = System(turned)
    r = integrate(Problem(s, START, 0.0, 10.0), TIMES)
    table = r.columns("omega", s)
    omega = polhode.angular_velocity(turned, r.states)
    assert np.array_equal(np.stack([table[n] for n in ("w1", "w2", "w3")], 1), omega)


def test_columns_know_the_frame():
    s = System(BODY, Frame.precessing((0.0, 0.0, 1.0), 0.1))
    r = integrate(Problem(s, START, 0.0, 10.0), TIMES)
    table = r.columns(["omega", "omega_rel"], s)
    rates = polhode.angular_velocity(s, r.t, r.states)
    assert np.array_equal(table["w3"], rates.inertial[:, 2])
    assert np.array_equal(table["w3_rel"], rates.relative[:, 2])
    assert not np.array_equal(table["w3"], table["w3_rel"])


@pytest.mark.parametrize(("names", "with_system", "error", "words"), [
    ("andoyr", True, ValueError, 'unknown column "andoyr"'),
    (["thta"], True, ValueError, "did you mean theta"),
    ("andoyer", False, ValueError, '"andoyer" needs system='),
    ([1], True, TypeError, "got 1; expected names"),
    (3, True, TypeError, "int"),
])
def test_columns_that_are_none_say_why(names, with_system, error, words):
    with pytest.raises(error) as raised:
        run().columns(names, system() if with_system else None)
    assert words in str(raised.value)
    with pytest.raises(error):
        run().to_pandas(names, system() if with_system else None)


def test_energy_of_a_system_without_one_is_refused():
    s = System(BODY, terms=[TorqueTerm(lambda t, s: (0.1, 0.0, 0.0), name="jet")])
    r = integrate(Problem(s, START, 0.0, 1.0), [0.0, 1.0])
    rejected(ValueError, "jet", r.columns, "energy", s)


def test_a_pandas_table():
    pytest.importorskip("pandas")
    r = run()
    frame = r.to_pandas(["andoyer", "omega"], system())
    assert list(frame.columns) == list(r.columns(["andoyer", "omega"], system()))[1:]
    assert frame.shape == (41, 16)
    assert frame.index.name == "t" and np.array_equal(frame.index, r.t)
    assert np.array_equal(frame["G"], polhode.to_andoyer(r.states).G)
    assert frame.attrs == {"method": r.method, "outcome": "completed"}
    frame.loc[r.t[0], "g1"] = 7.0  # a table is the user's own
    assert r.g[0, 0] == 0.8
    assert list(r.to_pandas().columns) == ["qw", "qx", "qy", "qz", "g1", "g2", "g3"]


def test_an_xarray_dataset():
    pytest.importorskip("xarray")
    r = run()
    data = r.to_xarray("andoyer", system())
    assert data.sizes == {"t": 41} and list(data.coords) == ["t"]
    assert list(data.data_vars) == list(r.columns("andoyer", system()))[1:]
    assert float(data["g2"].sel(t=5.0)) == r.g[20, 1]
    assert data.attrs == {"method": r.method, "outcome": "completed"}


@pytest.mark.parametrize("package", ["pandas", "xarray"])
def test_a_package_that_is_not_there_is_named(package, monkeypatch):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError) as raised:
        getattr(run(), f"to_{package}")()
    assert str(raised.value) == f"to_{package} needs {package}: pip install {package}"


def test_times_to_save_at():
    steps = SaveAt.steps(1.0, 2.0, 0.1)
    assert len(steps) == 11 and steps[0] == 1.0 and steps[3] == 1.3 and steps[-1] == 2.0
    assert np.array_equal(np.array(steps), list(steps))
    assert list(SaveAt.count(0.0, -1.0, 3)) == [0.0, -0.5, -1.0]
    assert list(SaveAt.times([3, 1, 2])) == [3.0, 1.0, 2.0]
    assert repr(steps) == "<SaveAt: 11 times from 1.0 to 2.0>"
    assert list(copy.deepcopy(steps)) == list(steps)
    with pytest.raises(IndexError):
        steps[11]


@pytest.mark.parametrize(("make", "error", "words"), [
    (lambda: SaveAt.steps(0.0, 1.0, -0.1), ValueError, "a step of -0.1 does not lead"),
    (lambda: SaveAt.steps(0.0, np.nan, 0.1), ValueError, "stop nan must be finite"),
    (lambda: SaveAt.count(0.0, 1.0, 0), ValueError, "a count of 0"),
    (lambda: SaveAt.count(0.0, 1.0, 2.5), TypeError, "rows: got 2.5, a float; expected an int"),
    (lambda: SaveAt.times([np.inf]), ValueError, "time inf must be finite"),
    (lambda: SaveAt.times([[1.0]]), ValueError, "times: got shape (1, 1)"),
    (lambda: SaveAt.times("1"), TypeError, "times: got a str"),
    (lambda: SaveAt(), TypeError, "SaveAt"),
])
def test_times_that_cannot_be_say_why(make, error, words):
    with pytest.raises(error) as raised:
        make()
    assert words in str(raised.value)


@pytest.mark.parametrize("times", [
    polhode.SaveAt.steps(0, 10, 0.3), polhode.SaveAt.count(0, 5, 7),
    polhode.SaveAt.times([0, 1, 3.5]), polhode.SaveAt.times([])], ids=repr)
def test_times_of_samples_are_values(times):
    again = pickle.loads(pickle.dumps(times))
    assert again == times
    assert hash(again) == hash(times)
    assert list(again) == list(times)
    assert times != polhode.SaveAt.count(0, 5, 8)


def test_columns_of_the_hub_need_no_system():
    start = polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])
    run = polhode.integrate(polhode.Problem(polhode.System(polhode.Body(1, 2, 2.5)), start, 0, 5))
    for names in (["g3"], ["g"], ["q", "g1"]):
        assert list(run.columns(names)) == ["t", "qw", "qx", "qy", "qz", "g1", "g2", "g3"]
    rejected(ValueError, '"andoyer" needs system=', run.columns, ["g3", "andoyer"])
