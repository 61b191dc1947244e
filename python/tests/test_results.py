# SPDX-License-Identifier: MIT
"""Results: columns as views that outlive everything else, names, states, tables, files."""

import copy
import gc
import pickle
import sys

import budgets
import numpy as np
import polhode
import pytest
from polhode import Results, Scenario, load
from rejections import rejected
from scenario_texts import BODY, EXAMPLES, FREE, ROOT, STATE, TIME

APOPHIS = ROOT / "examples/apophis.toml"
DAMPED = (
    BODY + STATE + "[[perturbation]]\nkind = \"damping\"\ncoefficients = [0.1, 0.1, 0.1]\n" + TIME
)


@pytest.fixture(scope="module")
def apophis():
    return load(APOPHIS).run()


def test_a_column_is_a_read_only_view(apophis):
    theta = apophis["theta"]
    assert theta.shape == (1441,) and theta.dtype == np.float64
    assert np.shares_memory(theta, apophis["theta"])
    assert np.shares_memory(theta, apophis.groups["euler"])
    assert apophis.t.tobytes() == apophis["t"].tobytes()
    for array in (theta, apophis.t, apophis.groups["q"]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
        with pytest.raises(ValueError):
            array.flags.writeable = True


def test_views_keep_their_numbers_alive():
    view = load(APOPHIS).run()["theta"]
    before = view.tobytes()
    gc.collect()
    others = [np.full(300_000, 7.0) for _ in range(20)]  # would fall on freed memory
    assert view.tobytes() == before and len(others) == 20


def test_runs_are_independent(apophis):
    again = apophis.scenario.run()
    assert again == apophis and not np.shares_memory(again.t, apophis.t)
    other = apophis.scenario.with_columns(["q", "g"]).run()
    assert other != apophis and other["qw"].tobytes() == apophis["qw"].tobytes()
    assert apophis != 3


def test_it_is_a_mapping(apophis):
    assert isinstance(apophis, Results) and len(apophis) == 26 == len(list(apophis))
    assert list(apophis)[:5] == ["t", "qw", "qx", "qy", "qz"] == list(apophis.columns[:5])
    assert "theta" in apophis and "thet" not in apophis and 3 not in apophis
    assert apophis.get("nothing") is None
    assert "theta" in apophis._ipython_key_completions_()
    assert {k: v.shape for k, v in apophis.items()} == dict.fromkeys(apophis.columns, (1441,))
    assert apophis.units["theta"] == "deg" and apophis.units["w1"] == "deg/h"
    assert apophis.units["qw"] == "1" and apophis.units["t"] == "h"
    shapes = {name: array.shape for name, array in apophis.groups.items()}
    assert shapes == {"t": (1441,), "q": (1441, 4), "omega": (1441, 3), "euler": (1441, 6),
                      "andoyer": (1441, 6), "sadov": (1441, 6)}
    apophis.units["t"] = "s"
    apophis.groups.clear()
    apophis.events.append(3)
    assert apophis.units["t"] == "h" and apophis.groups and apophis.events == []


@pytest.mark.parametrize(("name", "message"), [
    ("thetta", "no column \"thetta\"; did you mean theta"),
    ("w1_rel", "no column \"w1_rel\": [output] columns must name it; these results have t, qw"),
    ("omega", "\"omega\" is a group of columns: results.groups[\"omega\"], or w1, w2, w3"),
    ("zzz", "no column \"zzz\"; [output] columns must name it"),
    (3, "got 3; expected the name of a column"),
    (["t"], "got ['t']; expected the name of a column"),
])
def test_a_missing_column_says_what_there_is(apophis, name, message):
    with pytest.raises(KeyError) as error:
        apophis[name]
    assert str(error.value).startswith(message)


def test_states_are_those_of_the_motion():
    s = Scenario.from_text(FREE + "[output]\ncolumns = [\"g\", \"omega\", \"q\"]\n")
    results = s.run()
    assert results.states == s.free_rotation.at(results.t)
    assert results.states.shape == (21,)
    with pytest.raises(AttributeError, match=r"with_columns\(\[\"q\", \"g\"\]\)"):
        s.with_columns("q").run().states  # noqa: B018


def test_states_are_along_principal_axes():
    tensor = "tensor = [[1.9, 0, 0.2], [0, 1, 0], [0.2, 0, 2.3]]"
    text = FREE.replace("moments = [1, 2, 2.5]", tensor)
    s = Scenario.from_text(text + "[output]\ncolumns = [\"q\", \"g\", \"energy\"]\n")
    results = s.run()
    exact = s.free_rotation.at(results.t)
    assert np.abs(results.states.g - exact.g).max() < budgets.io_state
    assert np.abs(results.states.q - exact.q).max() < budgets.io_state
    assert np.abs(results.groups["g"] - exact.g).max() > 0.1  # files: along those of the tensor
    energy = polhode.kinetic_energy(s.body, results.states)
    assert np.abs(energy - results["E"]).max() < budgets.io_state


def test_what_a_run_was(apophis):
    assert apophis.outcome.ok and apophis.outcome.t == 720.0
    assert apophis.statistics.steps == 0 and apophis.energy_change is None
    damped = Scenario.from_text(DAMPED).run()
    assert damped.statistics.steps > 0 and damped.energy_change is None
    w1 = load(ROOT / "examples/gravity-gradient-satellite.toml").run()
    assert w1.energy_change == w1["dE"][-1]
    assert w1.summary["steps"] == w1.statistics.steps
    assert w1.summary["energy_change"] == w1.energy_change


def test_the_end_of_a_run_may_lie_behind_its_last_row():
    text = DAMPED.replace(TIME, "[time]\nstop = 3.9\nstep = 1\n")
    text += "[output]\ncolumns = [\"q\", \"g\"]\n"
    results = Scenario.from_text(text).run()
    assert results.t[-1] == 3.0 and results.end.t == 3.9
    rows = Scenario.from_text(text.replace("step = 1", "step = 3.9")).run()
    assert np.abs(results.end.s.g - rows.states.g[-1]).max() < budgets.io_state
    assert np.abs(results.end.s.q - rows.states.q[-1]).max() < budgets.io_state
    assert Scenario.from_text(FREE).run().end is None


def test_a_run_that_an_event_stops():
    text = FREE + "[[event]]\ncolumn = \"g1\"\nstops = true\n"
    results = Scenario.from_text(text).run()
    (event,) = results.events
    assert results.t[-1] == event.t == results.outcome.t < 10.0
    assert f"stopped by an event at t = {event.t!r} s" in repr(results)


def test_repr_shows_title_rows_units_and_end(apophis):
    assert repr(apophis) == (
        "<Results: Apophis, torque-free\n"
        "  1441 rows, t = 0 to 720 h\n"
        "  q        qw qx qy qz\n"
        "  omega    w1 w2 w3 [deg/h]\n"
        "  euler    phi theta psi [deg], Phi Theta Psi [1/h]\n"
        "  andoyer  l g h [deg], L G H [1/h]\n"
        "  sadov    phi_l phi_g phi_h [deg], I_l I_g I_h [1/h]\n"
        "  exact free rotation; completed>"
    )
    shown = Scenario.from_text("title = \"<b>\"\n" + FREE).run()._repr_html_()
    assert "&lt;b&gt;" in shown and "w1 w2 w3 [rad/s]" in shown


@pytest.mark.parametrize("path", EXAMPLES[:3], ids=lambda p: p.stem)
def test_pickles_hold_everything(path):
    results = load(path).run()
    back = pickle.loads(pickle.dumps(results))
    assert back == results and back.scenario == results.scenario
    assert repr(back) == repr(results) and back.energy_change == results.energy_change
    assert back.statistics.steps == results.statistics.steps
    with pytest.raises(ValueError, match="read-only"):
        back.t[0] = 1.0
    assert copy.deepcopy(results) == results


def test_pickles_hold_events():
    results = Scenario.from_text(FREE + "[[event]]\ncolumn = \"g1\"\n").run()
    back = pickle.loads(pickle.dumps(results))
    assert [(e.name, e.t, e.direction) for e in back.events] == [
        (e.name, e.t, e.direction) for e in results.events
    ]
    assert [e.s for e in back.events] == [e.s for e in results.events] and back.events


def test_write_makes_the_file_of_the_run(apophis, tmp_path):
    apophis.scenario.run([tmp_path / "a.csv", tmp_path / "a.h5"])
    apophis.write(tmp_path / "b.csv")
    pickle.loads(pickle.dumps(apophis)).write(str(tmp_path / "b.h5"))
    for kind in ("csv", "h5"):
        a, b = (tmp_path / f"{name}.{kind}" for name in "ab")
        assert a.read_bytes() == b.read_bytes()
    with pytest.raises(polhode.DomainError, match="expected .csv, .h5 or .aem"):
        apophis.write(tmp_path / "a.parquet")
    rejected(polhode.OutputError, "No space left", apophis.write, "/dev/full")


def test_without_rows_in_memory(tmp_path):
    s = load(APOPHIS)
    empty = s.run(tmp_path / "a.csv", keep=False)
    assert empty.t.shape == (0,) and empty.groups["q"].shape == (0, 4) and empty.outcome.ok
    assert "rows in files alone" in repr(empty)
    with pytest.raises(ValueError, match="keep=False"):
        pickle.loads(pickle.dumps(empty)).write(tmp_path / "b.csv")
    assert (tmp_path / "a.csv").stat().st_size > 100_000
    huge = Scenario.from_text(FREE.replace("stop = 10\nstep = 0.5", "stop = 1e15\nstep = 1"))
    rejected(MemoryError, "keep=False", huge.run, tmp_path / "b.csv")
    assert not (tmp_path / "b.csv.part").exists()


def test_a_data_frame(apophis):
    frame = apophis.to_pandas()
    assert frame.index.name == "t" and list(frame.columns) == list(apophis.columns[1:])
    assert frame["theta"].to_numpy().tobytes() == apophis["theta"].tobytes()
    assert frame.index.to_numpy().tobytes() == apophis.t.tobytes()
    assert frame.attrs["units"] == apophis.units and frame.attrs["title"] == "Apophis, torque-free"
    assert frame.attrs["outcome"] == "completed"


def test_a_data_set(apophis):
    data = apophis.to_xarray()
    assert data["theta"].dims == ("t",) and data["theta"].attrs == {"units": "deg"}
    assert data["t"].attrs == {"units": "h"}
    assert data["theta"].to_numpy().tobytes() == apophis["theta"].tobytes()
    assert data.attrs["method"] == "exact free rotation" and set(data) == set(apophis.columns[1:])


@pytest.mark.parametrize("package", ["pandas", "xarray"])
def test_a_package_that_is_missing_is_named(apophis, monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=f"to_{package} needs {package}: pip install {package}"):
        getattr(apophis, f"to_{package}")()


def test_what_a_package_itself_is_missing_is_named(apophis, monkeypatch, tmp_path):
    (tmp_path / "xarray.py").write_text("import what_xarray_needs\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "xarray", raising=False)
    rejected(ModuleNotFoundError, "^No module named 'what_xarray_needs'$", apophis.to_xarray)
