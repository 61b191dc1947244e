# SPDX-License-Identifier: MIT
"""Scenarios: the same files as the command line, wrong ones, wrong paths, and what is made here."""

import concurrent.futures
import json
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import time

import h5py
import numpy as np
import polhode
import pytest
from interrupts import LATEST, grows, seconds_from_signal
from polhode import OutputError, Scenario, ScenarioError, Units, load
from rejections import rejected
from scenario_texts import (
    BODY,
    ENDLESS,
    EXAMPLES,
    FAILING,
    FREE,
    ROOT,
    STATE,
    command_line,
)
from slowdown import SLOWDOWN

EVENTS = (
    BODY + STATE + "[[event]]\nname = \"up\"\ncolumn = \"g1\"\n"
    "[time]\nstop = 20\nstep = 0.5\n[output]\ncolumns = [\"omega\", \"euler\"]\n"
)


def names(paths):
    return [path.stem for path in paths]


@pytest.mark.parametrize("path", EXAMPLES, ids=names(EXAMPLES))
def test_an_example_gives_the_files_of_the_command_line(path, tmp_path):
    there, here = tmp_path / "there", tmp_path / "here"
    there.mkdir()
    here.mkdir()
    if path.stem == "envisat":
        given, path = path, tmp_path / path.name
        path.write_text(shortened(load(given)).text)
    table = command_line("run", path, "--out", there / "a.csv", "--out", there / "a.h5")
    scenario = load(path)
    results = scenario.run([here / "a.csv", str(here / "a.h5")])
    for name in ("a.csv", "a.h5"):
        assert (here / name).read_bytes() == (there / name).read_bytes()
    assert sorted(os.listdir(here)) == ["a.csv", "a.h5"]
    lines = [x for x in (there / "a.csv").read_text().splitlines() if not x.startswith("#")]
    assert results.columns == tuple(lines[0].split(","))
    numbers = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    assert np.column_stack(list(results.values())).tobytes() == numbers.tobytes()
    assert str(results.summary) + "\n" == table.partition("to draw it")[0]


@pytest.mark.parametrize("path", EXAMPLES, ids=names(EXAMPLES))
def test_summary_and_citations_are_those_of_the_command_line(path):
    scenario = load(path)
    summary = scenario.summary  # computed anew each time
    assert str(summary) + "\n" == command_line("info", path)
    shown = json.loads(command_line("info", "--json", path))
    assert list(shown) == list(summary)
    for key, value in shown.items():
        mine = summary[key]
        if isinstance(value, str):
            assert mine == value
        else:
            assert mine == (tuple(value["value"]) if isinstance(mine, tuple) else value["value"])
            assert summary.units.get(key, "1") == value["unit"]
    cited = "".join(f"[{c.key}] {c.text}\n    For {c.reason}.\n" for c in scenario.citations)
    assert cited == command_line("cite", path)
    entries = "".join(f"% For {c.reason}.\n{c.bibtex}\n" for c in scenario.citations)
    assert entries == command_line("cite", path, "--bibtex")
    assert pickle.loads(pickle.dumps(summary)).labels == summary.labels
    assert "<table>" in scenario._repr_html_()


def shortened(scenario):
    """The first hundredth of what takes seconds."""
    data = scenario.to_dict()
    data["time"] = {"stop": scenario.time[len(scenario.time) - 1] / 100, "count": 12}
    return Scenario.from_dict(data, scenario.name)


# The local vertical of a file is no Frame.local_vertical, which build could write down.
OTHERS = ('kind = "obliquity"', 'kind = "nutation"', "[frame.local-vertical]")
ROTATIONS = [path for path in EXAMPLES if not any(other in path.read_text() for other in OTHERS)]


@pytest.mark.parametrize("path", ROTATIONS, ids=names(ROTATIONS))
def test_a_scenario_comes_back_from_its_objects(path):
    given = load(path)
    if path.stem in ("earth", "envisat"):
        given = shortened(given)
    rows = given.run()
    made = Scenario.build(given.system, given.state, given.time, given.method,
                          columns=given.columns, units=given.units, title=given.title,
                          epoch=given.epoch, axes=given.axes, orbits=given.orbits)
    assert made.run() == rows
    assert made.system == given.system and made.orbits == given.orbits
    assert made.initial_state == given.initial_state
    assert Scenario.from_dict(given.to_dict(), str(path)).run() == rows  # files are beside it


def test_properties_say_what_the_file_says():
    s = load(ROOT / "examples/apophis.toml")
    assert (s.name, s.title, s.chart) == ("apophis.toml", "Apophis, torque-free", "tumbler")
    assert s.text == (ROOT / "examples/apophis.toml").read_text()
    assert s.units == Units("h", "deg") and s.axes == "ecliptic-J2000"
    assert s.epoch == "2013-01-05T00:00:00 UTC" and s.propagation == "exact free rotation"
    assert s.body.moments.tolist() == [0.61, 0.965, 1.0] and s.method is None
    assert len(s.time) == 1441 and s.columns == ("q", "omega", "euler", "andoyer", "sadov")
    assert s.state.precession_period == 30.56
    assert s.initial_state == polhode.to_rotor(s.body, s.state)
    assert s.free_rotation.initial_state == s.initial_state
    assert s.frame.is_inertial and s.system.terms == () and s.orbits == {}
    assert "apophis.toml" in repr(s) and "1441 rows of t, q, omega" in repr(s)
    w1 = load(ROOT / "examples/gravity-gradient-w1.toml")
    (term,) = w1.system.terms
    assert isinstance(term, polhode.GravityGradient) and term.orbit == w1.orbits["point-mass"]
    assert w1.method == polhode.Collocation()
    frame = load(ROOT / "examples/precessing-frame.toml").frame
    assert frame == polhode.Frame.precessing((0.2, -0.1, 1.0), 0.3)


def test_scenarios_are_values():
    a, b = Scenario.from_text(FREE), Scenario.from_text(FREE.encode())
    assert a == b and hash(a) == hash(b) and a != FREE
    assert a != Scenario.from_text(FREE, "other.toml")
    assert pickle.loads(pickle.dumps(a)) == a
    rejected(TypeError, "load", Scenario)
    with pytest.raises(AttributeError):
        a.title = "mine"


# Wrong files.


@pytest.mark.parametrize(("text", "message"), [
    (FREE.replace("[1, 2, 2.5]", "[1, 1, 3]"), "f.toml:3:11: body.moments: got"),
    (FREE.replace("step", "stpe"), "did you mean step?"),
    (FREE + "[output]\ncolumns = [\"omgea\"]\n", "did you mean \"omega\"?"),
    ("", "f.toml:1:1: file"),
    (b"\xff\xfe", "f.toml:1:1"),
    ("schema = 1\n\x00", "f.toml:2:1"),
])
def test_a_wrong_scenario_says_where(text, message):
    with pytest.raises(ScenarioError) as error:
        Scenario.from_text(text, "f.toml")
    assert message in str(error.value)
    assert isinstance(error.value, ValueError) and isinstance(error.value, polhode.DomainError)


def test_every_mistake_is_a_line():
    with pytest.raises(ScenarioError) as error:
        Scenario.from_text("schema = 1\ntitel = 3\n[body]\nmoments = [1, 2]\n" + STATE, "f.toml")
    first, second = str(error.value).splitlines()
    assert first.startswith("f.toml:2:1: titel") and second.startswith("f.toml:4:11: body.moments")


def test_a_file_that_cannot_be_read(tmp_path):
    rejected(FileNotFoundError, "nothing.toml", load, tmp_path / "nothing.toml")
    with pytest.raises(IsADirectoryError):
        load(tmp_path)
    (tmp_path / "big.toml").write_bytes(b"#" * ((16 << 20) + 5))
    rejected(ScenarioError, "at most 16 MB", load, tmp_path / "big.toml")


def test_arguments_of_another_type():
    with pytest.raises(TypeError):
        load(0)  # no file descriptor
    rejected(TypeError, "from_text: got 3", Scenario.from_text, 3)
    rejected(TypeError, "from_dict: got 'schema", Scenario.from_dict, FREE)
    with pytest.raises(TypeError, match="outputs: got 5"):
        Scenario.from_text(FREE).run(5)


# Wrong outputs.


def test_paths_that_are_no_outputs(tmp_path):
    s = Scenario.from_text(FREE)
    rejected(polhode.DomainError, "its folder does not exist", s.run, tmp_path / "no" / "a.csv")
    rejected(polhode.DomainError, "expected .csv, .h5 or .aem", s.run, tmp_path / "a.txt")
    rejected(polhode.DomainError, "is a folder", s.run, tmp_path)
    rejected(ValueError, "is named twice", s.run, [tmp_path / "a.csv", str(tmp_path / "a.csv")])
    rejected(ValueError, "got \"-\"; expected files", s.run, "-")
    rejected(ValueError, r"expected tables \[\[event\]\]", s.run, events=tmp_path / "e.csv")
    with pytest.raises(TypeError):
        s.run([3])
    assert os.listdir(tmp_path) == []


def test_a_disk_that_is_full():
    with pytest.raises(OutputError, match="No space left on device") as error:
        Scenario.from_text(FREE).run("/dev/full")
    assert isinstance(error.value, RuntimeError)


def test_without_time_there_is_nothing_to_run(tmp_path):
    s = Scenario.from_text(BODY + STATE)
    assert s.time is None and "rows" not in repr(s)
    rejected(polhode.DomainError, r"expected a table \[time\]", s.run, tmp_path / "a.csv")
    assert os.listdir(tmp_path) == []


def test_a_run_that_fails_keeps_its_rows(tmp_path):
    s = Scenario.from_text(FAILING, "run.toml")
    with pytest.warns(RuntimeWarning, match=r"run.toml: the run failed at t = 0.99999.* try"):
        results = s.run(tmp_path / "a.csv")
    assert not results.outcome.ok and len(results.t) == 1000 and results.t[-1] == 0.999
    assert os.listdir(tmp_path) == ["a.csv.part"]
    assert sum(x[0] != "#" for x in (tmp_path / "a.csv.part").open()) == 1001
    assert "failed at t = 0.99999" in repr(results)


@pytest.mark.parametrize("text", [
    ENDLESS,
    BODY + STATE + "[time]\nstop = 5e7\nstep = 1\n[output]\ncolumns = [\"sadov\"]\n",
], ids=["integrated", "free"])
def test_ctrl_c_stops_a_run_and_leaves_what_it_wrote(text, tmp_path):
    s = Scenario.from_text(text)
    paths = [tmp_path / "a.csv", tmp_path / "a.h5"]
    begun = grows(tmp_path / "a.csv.part")
    assert seconds_from_signal(lambda: s.run(paths, keep=False), begun) < LATEST
    assert set(os.listdir(tmp_path)) - {"a.h5.part-undo"} == {
        "a.csv.checkpoint", "a.csv.part", "a.h5.checkpoint", "a.h5.part"}
    rows = sum(line[0] not in "#t" for line in (tmp_path / "a.csv.part").open())
    with h5py.File(tmp_path / "a.h5.part") as file:
        assert len(file["t"]) == rows > 0


def test_runs_in_threads_give_the_same_files(tmp_path):
    s = load(ROOT / "examples/wing-nut.toml")

    def run(k):
        s.run([tmp_path / f"{k}.h5", tmp_path / f"{k}.csv"])
        return (tmp_path / f"{k}.h5").read_bytes() + (tmp_path / f"{k}.csv").read_bytes()

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert len(set(pool.map(run, range(8)))) == 1


def test_events_are_those_of_the_command_line(tmp_path):
    path = tmp_path / "run.toml"
    path.write_text(EVENTS)
    command_line("run", path, "--events", tmp_path / "there.csv")
    results = load(path).run(events=tmp_path / "here.csv")
    assert (tmp_path / "here.csv").read_bytes() == (tmp_path / "there.csv").read_bytes()
    assert len(results.events) > 2 and {e.name for e in results.events} == {"up"}
    assert "up, rising, at t" in str(results.summary)
    rising = [e.t for e in results.events if e.direction == 1]
    assert all(0.0 < t <= 20.0 for t in rising)


# Changed scenarios.


def test_other_columns_leave_the_rest_of_the_text():
    s = load(ROOT / "examples/apophis.toml")
    other = s.with_columns(["omega", "g"])
    assert other.columns == ("omega", "g") and s.columns[0] == "q"
    before, after = s.text.splitlines(), other.text.splitlines()
    assert len(before) == len(after)
    changed = [(a, b) for a, b in zip(before, after) if a != b]
    assert changed == [
        ("columns = [\"q\", \"omega\", \"euler\", \"andoyer\", \"sadov\"]",
         "columns = [\"omega\", \"g\"]")
    ]
    assert other.run()["w1"].tobytes() == s.run()["w1"].tobytes()
    assert s.with_columns("euler").columns == ("euler",)
    rejected(ScenarioError, "did you mean \"omega\"", s.with_columns, ["omgea"])


@pytest.mark.parametrize("output", [
    "", "[output]\n", "[output]\n# why\ncolumns = [ # q ]\n  \"q\",\n]\n",
    "[[perturbation]]\nkind = \"damping\"\ncoefficients = [1, 1, 1]\n",
])
def test_other_columns_wherever_they_stand(output):
    s = Scenario.from_text(FREE + output)
    assert s.with_columns(["g", "q"]).columns == ("g", "q")
    for first in ("output.columns = [\"q\"]\n", "output = { columns = [\"q\"] }\n"):
        assert Scenario.from_text(first + FREE).with_columns("g").columns == ("g",)


def test_a_scenario_is_saved_whole_and_only_where_nothing_is(tmp_path):
    s = load(ROOT / "examples/toutatis.toml")
    path = tmp_path / "mine.toml"
    s.save(path)
    assert path.read_bytes() == (ROOT / "examples/toutatis.toml").read_bytes()
    with pytest.raises(FileExistsError, match="overwrite=True"):
        s.with_columns("g").save(path)
    assert load(path).columns == s.columns
    s.with_columns("g").save(str(path), overwrite=True)
    assert load(path).columns == ("g",)
    with pytest.raises(FileNotFoundError):
        s.save(tmp_path / "no" / "mine.toml")
    assert os.listdir(tmp_path) == ["mine.toml"]


def test_paths_of_bytes_are_paths(tmp_path):
    s = Scenario.from_text(FREE)
    folder = os.fsencode(tmp_path)
    s.save(folder + b"/mine.toml")
    with pytest.raises(FileExistsError, match=r"/mine\.toml is there; overwrite=True"):
        s.save(folder + b"/mine.toml")
    s.run(folder + b"/a.csv")
    s.run([folder + b"/b.csv"]).write(folder + b"/c.csv")
    assert sorted(os.listdir(tmp_path)) == ["a.csv", "b.csv", "c.csv", "mine.toml"]
    rejected(ValueError, "b.csv is named twice", s.run, [tmp_path / "b.csv", folder + b"/b.csv"])
    with pytest.warns(RuntimeWarning, match=r"in /.*/d\.csv\.part$"):
        Scenario.from_text(FAILING).run(folder + b"/d.csv")


def test_from_dict_takes_what_toml_has():
    data = {
        "schema": 1,
        "title": "Two \"quoted\" words and a \\",
        "body": {"moments": np.array([1.0, 2.0, 2.5])},
        "state": {"attitude-rate": {"quaternion": (np.float64(1), 0, np.int64(0), 0),
                                    "omega_body": {"value": [0.1, 0.2, 1.0], "unit": "rev/s"}}},
        "event": [{"column": "w1", "stops": True}],
        "time": {"at": [0.1 + 0.2, "2 s", {"value": 3, "unit": "s"}]},
    }
    s = Scenario.from_dict(data, "here.toml")
    assert s.name == "here.toml" and [s.time[k] for k in range(3)] == [0.1 + 0.2, 2.0, 3.0]
    assert s.initial_state.g[2] == 2.5 * s.units.to_core("1 rev/s", "rate")
    again = s.to_dict()
    assert again["time"] == {"at": [0.1 + 0.2, "2 s", {"value": 3, "unit": "s"}]}
    assert Scenario.from_dict(again, "here.toml") == s


@pytest.mark.parametrize(("value", "message"), [
    (None, "body.moments: got None"),
    (polhode.free.Regime.rest, "body.moments: got "),
    ([1, object(), 2], "body.moments: got <object"),
    (1j, "body.moments: got 1j"),
])
def test_from_dict_refuses_what_toml_has_not(value, message):
    with pytest.raises(TypeError) as error:
        Scenario.from_dict({"schema": 1, "body": {"moments": value}})
    assert str(error.value).startswith(message)
    rejected(TypeError, "body: got a key 3", Scenario.from_dict, {"schema": 1, "body": {3: value}})
    with pytest.raises(ScenarioError, match="title: got .* without control characters"):
        Scenario.from_dict({"schema": 1, "title": "one\x7f\n"})
    with pytest.raises(ScenarioError, match="got nan; expected an array of 3 numbers"):
        Scenario.from_dict({"schema": 1, "body": {"moments": [1, float("nan"), 1]}})


def test_a_long_list_of_times_is_quick():
    times = np.random.default_rng(1).uniform(0, 1e3, 20_000)
    s = Scenario.build(polhode.Body(1, 2, 2.5), polhode.RotorState([1, 0, 0, 0], [1, 2, 3]), times)
    assert s.run().t.tobytes() == times.tobytes()


def test_times_of_a_free_rotation_come_in_any_order():
    state = polhode.RotorState([1, 0, 0, 0], [1, 2, 3])
    motion = polhode.FreeRotation(polhode.Body(1, 2, 2.5), state)
    for times in ([3.0, 1.0, 7.0, -2.0, 5.0], [3.0, 1.0, 3.0], [4.0, 4.0]):
        rows = Scenario.build(motion.body, state, times).run()
        assert rows.t.tolist() == times
        assert rows.groups["q"].tolist() == motion.at(times).q.tolist()


def test_a_script_is_stopped_from_outside(tmp_path):
    path = tmp_path / "run.toml"
    path.write_text(ENDLESS)
    script = (
        "import polhode, sys\ns = polhode.load(sys.argv[1])\nprint('running', flush=True)\n"
        "s.run(keep=False)\n"
    )
    package = pathlib.Path(polhode.__file__).parents[1]
    child = subprocess.Popen(
        [sys.executable, "-c", script, path], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, env={**os.environ, "PYTHONPATH": str(package)},
    )
    assert child.stdout.readline() == "running\n"
    time.sleep(0.1)
    child.send_signal(signal.SIGINT)
    _, err = child.communicate(timeout=30 * SLOWDOWN)
    assert child.returncode != 0 and "KeyboardInterrupt" in err
