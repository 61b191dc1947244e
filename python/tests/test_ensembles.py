# SPDX-License-Identifier: MIT
"""Ensembles from Python: the numbers of `polhode ensemble`, as arrays, tables of xarray and members
that run alone."""

import inspect
import json
import pickle
import subprocess
import sys
import threading

import budgets
import numpy as np
import polhode
import pytest
from interrupts import LATEST, seconds_from_signal
from numpy.testing import assert_array_equal
from polhode import DomainError, Scenario, ScenarioError, vary
from polhode.ensemble import EnsembleResults
from rejections import rejected
from scenario_texts import FREE, ROOT, command_line

TUMBLER = ROOT / "examples/apophis-ensemble.toml"
SPIN = "state.attitude-rate.omega_body[2]"
MOMENT = "body.moments[0]"
BOTH = {SPIN: vary.normal(0.1), MOMENT: vary.uniform(0.9, 1.1)}
FEW = Scenario.from_text(FREE).with_columns(["q", "energy"])
STOPPED = FREE + """[[event]]
column = "qw"
value = 0.9
stops = true
"""


def test_the_numbers_are_those_of_the_command_line(tmp_path):
    scenario = polhode.load(TUMBLER)
    ours, theirs = tmp_path / "ours.csv", tmp_path / "theirs.csv"
    found = scenario.ensemble(size=40, outputs=[ours, tmp_path / "ours.h5"])
    set_ = ["--set", "ensemble.size=40"]
    command_line("ensemble", TUMBLER, *set_, "--out", theirs, "--out", tmp_path / "theirs.h5")

    def rows(path):
        return [line for line in path.read_text().splitlines() if not line.startswith("# | ")]

    assert rows(ours) == rows(theirs)
    for path in tmp_path.iterdir():
        again = EnsembleResults.read(path)
        assert again == found and again.units == found.units
        assert (again.keep, again.size, again.failed) == ("statistics", 40, 0)
    read = EnsembleResults.read(tmp_path / "theirs.h5")
    assert read.columns[:2] == ("t", "members") and read.groups["q"].shape == (101, 13)
    # the scenario inside is that of the file, where nothing was changed
    whole = scenario.with_ensemble(size=40).ensemble()
    assert whole == found and whole.scenario == found.scenario


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_threads_and_files_change_nothing(keep, tmp_path):
    found = FEW.ensemble(vary=BOTH, size=50, keep=keep, threads=1)
    other = FEW.ensemble(tmp_path / "a.csv", vary=BOTH, size=50, keep=keep, threads=3)
    assert found == other == EnsembleResults.read(tmp_path / "a.csv")
    assert pickle.loads(pickle.dumps(found)) == found
    assert found != FEW.ensemble(vary=BOTH, size=50, keep=keep, seed=2)
    assert not found["t"].flags.writeable
    with pytest.raises(ValueError):
        found["t"][0] = 1.0


def test_statistics_are_those_of_the_rows():
    rows = FEW.ensemble(vary=BOTH, size=30, keep="rows")
    q = [0.0, 0.25, 1.0]
    found = FEW.ensemble(vary=BOTH, size=30, quantiles=q)
    E = rows["E"].reshape(30, -1)
    assert np.allclose(found["E_mean"], E.mean(0), rtol=budgets.ensemble_of_rows, atol=0.0)
    assert_array_equal(found["E_greatest"], E.max(0))
    quantiles = found.quantiles("E")
    assert list(quantiles) == q
    assert_array_equal(quantiles[0.0], E.min(0))
    assert_array_equal(quantiles[1.0], found["E_p100"])
    first = np.quantile(E, 0.25, axis=0)
    assert np.allclose(quantiles[0.25], first, rtol=budgets.ensemble_of_rows, atol=0.0)
    with pytest.raises(KeyError, match='no quantiles of "q"; these results have them of E, dE'):
        found.quantiles("q")


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_what_was_drawn_and_each_member_alone(keep, tmp_path):
    path = tmp_path / "e.h5"
    found = FEW.ensemble(path, vary=BOTH, size=12, keep=keep)
    rows = FEW.ensemble(vary=BOTH, size=12, keep="rows")
    final = FEW.ensemble(vary=BOTH, size=12, keep="final")
    for results in (found, EnsembleResults.read(path)):
        assert list(results.drawn) == [SPIN, MOMENT]
        for key, numbers in results.drawn.items():
            assert_array_equal(numbers, final[key])
    member = found.member(7)
    assert member.body.moments[0] == found.drawn[MOMENT][7]
    assert_array_equal(member.run()["qw"], rows["qw"][rows["member"] == 7])
    rejected(DomainError, "got member 12; expected 0 to 11", found.member, 12)


def test_what_varies_is_what_the_tables_say():
    scenario = FEW.with_ensemble(
        {
            ("state.attitude-rate.omega_body[0]", "state.attitude-rate.omega_body[1]"):
                vary.joint_normal([[0.01, 0.0], [0.0, 0.04]], means=np.array([0.0, 0.5])),
            "state.attitude-rate.quaternion": vary.attitude(),
            MOMENT: vary.grid(0.9, 1.1, 3),
            SPIN: vary.log_uniform(low=1, high=np.float64(2.0)),
        },
        size=300, draws="sobol", keep="final", seed=5,
    )
    table = scenario.to_dict()["ensemble"]
    assert [one["kind"] for one in table["vary"]] == [
        "joint-normal", "attitude", "grid", "log-uniform",
    ]  # fmt: skip
    assert table["vary"][2] == {
        "kind": "grid", "key": MOMENT, "from": 0.9, "to": 1.1, "count": 3}
    assert (table["draws"], table["seed"], table["size"]) == ("sobol", 5, 300)
    drawn = scenario.ensemble().drawn
    assert_array_equal(np.unique(drawn[MOMENT]), [0.9, 1.0, 1.1])
    q = np.stack([drawn[f"state.attitude-rate.quaternion[{k}]"] for k in range(4)])
    assert np.allclose((q**2).sum(0), 1.0)
    assert abs(drawn["state.attitude-rate.omega_body[1]"].mean() - 0.5) < budgets.ensemble_middle
    assert drawn[SPIN].min() >= 1.0 and drawn[SPIN].max() <= 2.0
    # what is not given stays, comments too
    commented = Scenario.from_text(scenario.text.replace("[body]", "# a body\n[body]"))
    again = commented.with_ensemble(size=7)
    assert again.to_dict()["ensemble"] == {**table, "size": 7}
    assert "# a body" in again.text and again.text.count("[ensemble]") == 1


def test_distributions_are_those_of_the_schema():
    kinds = {name: getattr(vary, name) for name in vary.__all__ if name != "Distribution"}
    assert str(inspect.signature(vary.normal)) == (
        "(sigma, mean=None, low=None, high=None) -> polhode.vary.Distribution"
    )
    schema = json.loads((ROOT / "docs/reference/scenario.schema.json").read_text())
    text = json.dumps(schema["properties"]["ensemble"])
    for name, make in kinds.items():
        assert f'"{name.replace("_", "-")}"' in text and make.__doc__ and make.__name__ == name
        for parameter in inspect.signature(make).parameters:
            assert f'"{parameter.rstrip("_")}"' in text and f"{parameter} : " in make.__doc__
    one = vary.grid(0, 1, 3)
    assert repr(one) == "vary.grid(from_=0, to=1, count=3)"
    assert one == vary.grid(from_=0, to=1, count=3) != vary.uniform(0, 1)
    assert pickle.loads(pickle.dumps(one)) == one
    with pytest.raises(AttributeError):
        one.kind = "normal"


def test_a_member_that_fails_is_named_and_left_out(tmp_path):
    vary_ = {MOMENT: vary.uniform(1, 6)}  # beyond 4.5 there is no such body
    found = FEW.ensemble(tmp_path / "e.csv", vary=vary_, size=80, keep="final")
    wrong = np.flatnonzero(found.drawn[MOMENT] > 4.5)
    assert 0 < found.failed == len(wrong) < 80
    assert [member for member, _ in found.failures] == list(wrong)[:20]
    assert "moments" in found.failures[0][1]
    assert f"{found.failed} members failed" in repr(found)
    read = EnsembleResults.read(tmp_path / "e.csv")
    assert read.failed == found.failed and read.failures == found.failures
    assert FEW.ensemble(tmp_path / "e.h5", vary=vary_, size=80).failures == found.failures
    assert EnsembleResults.read(tmp_path / "e.h5").failures == found.failures
    done = FEW.ensemble(tmp_path / "e.h5", vary=vary_, size=80, resume=True)
    assert (done.failed, done.failures) == (found.failed, found.failures)
    text = (tmp_path / "e.csv").read_text()
    (tmp_path / "e.csv").write_text(text.partition("# failed: ")[0])  # of an older version
    older = EnsembleResults.read(tmp_path / "e.csv")
    assert older.failed == found.failed
    with pytest.raises(AttributeError, match="this file does not say why"):
        older.failures  # noqa: B018
    statistics = FEW.ensemble(vary=vary_, size=80)
    assert (statistics["members"] == 80 - found.failed).all()
    assert statistics.failures == found.failures


def test_an_ensemble_of_which_nobody_is_left_is_an_error(tmp_path):
    with pytest.raises(RuntimeError, match="all 7 members failed.*\n  member 0: .*moments"):
        FEW.ensemble(tmp_path / "e.csv", vary={MOMENT: vary.uniform(5, 6)}, size=7)
    assert not (tmp_path / "e.csv").exists()


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_files_have_title_and_order_of_what_is_in_memory(tmp_path, keep):
    titled = FEW.replace({"title": 'A "body"'}).with_columns(["energy", "tumbler", "q"])
    outputs = [tmp_path / "a.csv", tmp_path / "a.h5"]
    found = titled.ensemble(outputs, vary=BOTH, size=6, keep=keep)
    for path in outputs:
        read = EnsembleResults.read(path)
        assert read.columns == found.columns and 'A "body": 6 members' in repr(read)
        assert read.failures == []


def test_a_histogram_that_is_not_there_is_named():
    with_one = FEW.with_ensemble(
        BOTH, size=5, histogram=[{"name": "spins", "columns": [SPIN], "bins": 3}])
    found = with_one.ensemble()
    assert list(found.histograms) == ["spins"]
    with pytest.raises(KeyError, match="no histogram 'nope'; there are: spins"):
        found.histograms["nope"]
    final = with_one.ensemble(keep="final")
    with pytest.raises(KeyError, match='go with keep="statistics".*keep="final"'):
        final.histograms["spins"]
    # other keys vary, the rest of the table stays
    other = with_one.ensemble(vary={SPIN: vary.normal(0.2)})
    assert other.size == 5 and list(other.drawn) == [SPIN] and "spins" in other.histograms


def test_messages_about_what_varies_have_no_place():
    said = r"^scenario\.toml: ensemble\.vary\[0\]\.sigma: got -1; "
    with pytest.raises(ScenarioError, match=said):
        FEW.ensemble(vary={SPIN: vary.normal(-1.0)}, size=5)
    with pytest.raises(ScenarioError, match=r":\d+:\d+: body\.moments"):  # has a place
        FEW.replace({"body.moments": [1, 2, 30]})


def test_tables_of_xarray():
    statistics = FEW.ensemble(vary=BOTH, size=20).to_xarray()
    assert statistics["E_mean"].dims == ("t",) and statistics.sizes["t"] == 21
    assert statistics["E_p5"].attrs == {"units": "1/s2", "long_name": "quantile 0.05 of E"}
    assert statistics["q_cov_12"].attrs["units"] == "rad2" and statistics["t"].attrs["units"] == "s"
    final = FEW.ensemble(vary=BOTH, size=20, keep="final")
    table = final.to_xarray()
    assert table["qw"].dims == ("member",) and table["member"].dtype == np.int64
    assert table[MOMENT].attrs["long_name"] == f"drawn: {MOMENT}"
    assert_array_equal(table["qw"], final["qw"])
    rows = FEW.ensemble(vary=BOTH, size=20, keep="rows")
    table = rows.to_xarray()
    assert table["qw"].dims == ("member", "t")
    assert_array_equal(table["qw"].sel(member=3, t=5.0), rows["qw"][3 * 21 + 10])
    assert table.attrs["size"] == 20


def test_rows_of_members_that_events_stop_lie_side_by_side():
    apart = {SPIN: vary.uniform(0.5, 2.0)}
    rows = Scenario.from_text(STOPPED).ensemble(vary=apart, size=10, keep="rows")
    table = rows.to_xarray()
    assert table["qw"].dims == ("member", "row") == table["t"].dims
    for k in range(10):
        own = rows["member"] == k
        there = own.sum()
        assert_array_equal(table["qw"][k, :there], rows["qw"][own])
        assert_array_equal(table["t"][k, :there], rows["t"][own])
        assert np.isnan(table["qw"][k, there:]).all()
    assert len({int(n) for n in np.isfinite(table["qw"]).sum("row")}) > 1


def test_dates_are_texts(tmp_path):
    scenario = polhode.load(TUMBLER).with_columns(["date", "q"])
    found = scenario.with_ensemble(size=3, keep="final").ensemble(tmp_path / "e.csv")
    assert found["date"].dtype.kind == "U" and found["date"][0].startswith("2013-03-29T08:00:00")
    assert EnsembleResults.read(tmp_path / "e.csv") == found
    assert found.to_xarray()["date"].dtype.kind == "U"


COUNTED = """[[ensemble.histogram]]
name = "one"
columns = ["w2"]
bins = 4
times = "all"
[[ensemble.histogram]]
name = "two"
columns = ["w3", "body.moments[0]"]
bins = 3
low = [0, 0.9]
high = [2, 1.1]
[[ensemble.fraction]]
name = "up"
column = "w2"
low = 0
"""


def counted():
    goes_on = STOPPED.replace("stops = true\n", "")
    scenario = Scenario.from_text(goes_on).with_columns(["q", "omega"])
    text = scenario.with_ensemble(BOTH, size=40, chunk=16).text
    return Scenario.from_text(text.replace("[[ensemble.vary]]", COUNTED + "[[ensemble.vary]]", 1))


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_histograms_and_first_times_are_those_of_the_command_line(extension, tmp_path):
    scenario, toml = counted(), tmp_path / "s.toml"
    scenario.save(toml)
    out = tmp_path / f"theirs.{extension}"
    said = command_line("ensemble", toml, "--out", out)
    found, theirs = scenario.ensemble(), EnsembleResults.read(out)
    assert found == theirs and list(found.histograms) == ["one", "two"]
    assert found.histograms == theirs.histograms == pickle.loads(pickle.dumps(found)).histograms
    one, two = found.histograms.values()
    assert (one.columns, two.columns) == (("w2",), ("w3", MOMENT))
    assert one.members.shape == (21, 6) and two.members.shape == (1, 5, 5)
    assert_array_equal(one.members.sum(1), found["members"])
    assert_array_equal(two.edges[MOMENT][0, [0, 1, -2, -1]], [-np.inf, 0.9, 1.1, np.inf])
    table = two.to_xarray()
    assert table["members"].dims == ("t", "w3", MOMENT)
    assert table["w3_low"].attrs["units"] == two.units["w3"] == "rad/s"
    assert_array_equal(table["w3_high"], two.edges["w3"][:, 1:])
    rows = scenario.with_ensemble(keep="rows").ensemble()
    own = rows["w2"][rows["t"] == one.t[3]]
    assert_array_equal(one.members[3, 1:-1], np.histogram(own, one.edges["w2"][3, 1:-1])[0])
    event, = found.first_times
    first = found.first_times[event]
    assert first.part == found[f"{event}_part"][-1] and first.unit == "s"
    shown = [f", {q:.10g} by {t:.10g} s" for q, t in first.times.items() if not np.isnan(t)]
    assert shown and f"{event}: part {first.part:.4g} of the members" + "".join(shown) in said
    along = found.to_xarray()[f"{event}_first"]
    assert along.dims == ("quantile",) and along.attrs["units"] == "s"
    assert_array_equal(along, list(first.times.values()))
    assert found.to_xarray()["up_part"].dims == ("t",)
    with pytest.raises(AttributeError, match="first_times: a file does not hold them"):
        theirs.first_times  # noqa: B018
    done = scenario.ensemble(out, resume=True)  # nothing to do
    assert done == found and done.histograms == found.histograms
    gone = tmp_path / f"theirs.two.{extension}"
    gone.unlink()
    with pytest.raises(ValueError, match=r"theirs.two.* is not there.*restart=True runs this one"):
        scenario.ensemble(out, resume=True)
    with pytest.raises(OSError, match="theirs.two"):
        theirs.histograms  # noqa: B018


@pytest.mark.parametrize("keep", ["final", "rows"])
@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_each_chunk_may_have_a_file_of_its_own(keep, extension, tmp_path):
    vary_ = {MOMENT: vary.uniform(1, 6)}  # beyond 4.5 there is no such body
    scenario = FEW.with_ensemble(vary_, size=40, chunk=16, keep=keep)
    whole, out = scenario.ensemble(), tmp_path / f"rows-{{chunk}}.{extension}"
    found = scenario.ensemble(out)
    index = tmp_path / f"rows-index.{extension}"
    names = [tmp_path / f"rows-{k}.{extension}" for k in range(3)]
    assert sorted(tmp_path.iterdir()) == [*names, index]
    for results in (found, EnsembleResults.read(index), scenario.ensemble(out, resume=True)):
        assert results == found and results.keep == "chunks" and results.size == 40
        assert results.chunk_files == [str(name) for name in names]
        assert results.failed == whole.failed > 0
        assert_array_equal(results["first_member"], [0, 16, 32])
        assert results.to_xarray()["rows"].dims == ("chunk",)
        assert_array_equal(results.drawn[MOMENT], whole.drawn[MOMENT])
    parts = [EnsembleResults.read(name) for name in found.chunk_files]
    for name in whole:
        assert_array_equal(np.concatenate([part[name] for part in parts]), whole[name])
    assert [part.failed for part in parts] == list(found["failed"])
    assert parts[2].to_xarray()["member"].values.tolist() == list(range(32, 40))
    names[1].unlink()
    with pytest.raises(ValueError, match="rows-1.* is not there.*restart=True runs this one anew"):
        scenario.ensemble(out, resume=True)
    with pytest.raises(ValueError, match='expected ensemble.keep = "rows" or "final"'):
        scenario.with_ensemble(keep="statistics").ensemble(out)


class Enough(Exception):
    """What a listener raises."""


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_an_ensemble_goes_on_where_it_was_stopped(keep, extension, tmp_path):
    whole = FEW.ensemble(vary=BOTH, size=200, keep=keep, chunk=16)
    path = tmp_path / f"e.{extension}"
    scenario = whole.scenario

    def stop(members, of):
        assert of == 200
        if members >= 96:
            raise Enough

    before = threading.active_count()
    with pytest.raises(Enough):
        scenario.ensemble(path, threads=2, progress=stop)
    assert threading.active_count() == before
    assert not path.exists() and path.with_name(path.name + ".checkpoint").exists()
    rejected(ValueError, "unfinished ensemble .* resume=True continues it", scenario.ensemble, path)
    with pytest.raises(ValueError, match="ensemble: got resume=True and restart=True"):
        scenario.ensemble(path, resume=True, restart=True)
    told = []
    again = scenario.ensemble(path, resume=True, progress=lambda k, of: told.append(k))
    assert again == whole and again.failures == [] and told[0] > 96 and told[-1] == 200
    assert list(again) == list(whole) and list(tmp_path.iterdir()) == [path]
    done = scenario.ensemble(path, resume=True)  # nothing to do: the file is read
    assert done == whole and done.failed == 0
    assert_array_equal(done.drawn[SPIN], whole.drawn[SPIN])


def test_ctrl_c_leaves_an_ensemble_to_continue(tmp_path):
    slow = "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [1e-9, 0, 0]\n"
    text = FREE.replace("stop = 10\n", "stop = 1e3\n").replace("step = 0.5", "step = 100") + slow
    path, told = tmp_path / "e.csv", []
    scenario = Scenario.from_text(text).with_columns("g").with_ensemble(BOTH, size=10**6, chunk=16)
    took = seconds_from_signal(
        lambda: scenario.ensemble(path, progress=lambda k, of: told.append(k)), lambda: bool(told)
    )
    assert took < LATEST and path.with_name("e.csv.checkpoint").exists()


def test_python_runs_while_members_do():
    counted = []
    done = threading.Event()

    def count():
        while not done.wait(0.001):
            counted.append(1)

    counter = threading.Thread(target=count)
    counter.start()
    polhode.load(TUMBLER).ensemble(size=300, threads=1)
    done.set()
    counter.join()
    assert len(counted) > 20


def test_what_is_refused(tmp_path):
    def refused(error, match, *arguments, **keywords):
        of, vary_, *outputs = [*arguments, None] if len(arguments) == 1 else arguments
        rejected(error, match, of.ensemble, *outputs, vary=vary_, **keywords)

    refused(ScenarioError, "ensemble: got nothing; expected a table", FEW)
    refused(ScenarioError, "size", FEW, BOTH)
    refused(ScenarioError, "unknown key", FEW, BOTH, size=3, sise=4)
    refused(ScenarioError, r'vary\[0\].key: got "x"', FEW, {"x": vary.uniform(0, 1)}, size=3)
    refused(ScenarioError, "low", FEW, {MOMENT: vary.uniform(2, 1)}, size=3)
    refused(ScenarioError, 'low: got "2 h"', FEW, {MOMENT: vary.uniform("2 h", 3)}, size=3)
    refused(ScenarioError, "keep", FEW, BOTH, size=3, keep="all")
    refused(TypeError, "expected a dict of distributions", FEW, [vary.uniform(0, 1)], size=3)
    refused(TypeError, "got 3; expected one of vary.normal", FEW, {MOMENT: 3}, size=3)
    refused(TypeError, "got the key 3; expected a text", FEW, {3: vary.uniform(0, 1)}, size=3)
    refused(ValueError, "uniform: got 2 keys", FEW, {("a", "b"): vary.uniform(0, 1)}, size=3)
    refused(ValueError, "threads: got 0", FEW, BOTH, size=3, threads=0)
    refused(TypeError, "outputs: got 3", FEW, BOTH, 3, size=3)
    refused(ValueError, "holds one motion", FEW, BOTH, tmp_path / "e.aem", size=3)
    refused(MemoryError, "rows of 100000000000 members", FEW, BOTH, size=10**11, keep="rows")
    rejected(TypeError, r"vary.normal\(sigma.*: missing a required argument", vary.normal)
    rejected(TypeError, "vary.uniform: low", vary.uniform, 1j, 2)
    with pytest.raises(ValueError, match="got kind 'cauchy'; expected one of normal"):
        vary.Distribution("cauchy", {})
    with pytest.raises(KeyError, match='no column "E_means"; did you mean E_mean'):
        FEW.ensemble(vary=BOTH, size=3)["E_means"]
    run = tmp_path / "run.csv"
    FEW.run(run)
    rejected(ValueError, "no file of an ensemble", EnsembleResults.read, run)
    with pytest.raises(OSError):
        EnsembleResults.read(tmp_path / "nothing.h5")


@pytest.mark.parametrize("package, call", [
    ("h5py", "polhode.ensemble.EnsembleResults.read(path)"),
    ("xarray", "results.to_xarray()"),
])
def test_a_package_that_is_missing_is_named(package, call, tmp_path):
    path = tmp_path / "e.h5"
    FEW.ensemble(path, vary=BOTH, size=3)
    code = f"""
import sys
sys.modules["{package}"] = None
import polhode
path = {str(path)!r}
results = polhode.load({str(TUMBLER)!r}).ensemble(size=2)
try:
    {call}
except ImportError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert f"needs {package}: pip install {package}" in done.stdout
