# SPDX-License-Identifier: MIT
"""Histograms of `polhode ensemble`: NumPy's of the rows, in files of their own, the same bytes for
any number of threads and after kills."""

import subprocess

import budgets
import h5py
import numpy
import pytest
from ensemble_files import TORQUE, VARY, bytes_of, dimensions, mark, rows_of, wait_for_another


def histogram(name, columns, **keys):
    all_keys = {"name": name, "columns": columns, **keys}
    lines = [f"{key} = {value!r}" for key, value in all_keys.items()]
    return "[[ensemble.histogram]]\n" + "\n".join(lines).replace("'", '"') + "\n"


def made(run, ensemble, tmp_path, keep, names=(), extension="csv", **parts):
    """What an ensemble writes from one and from three threads: its rows and those histograms."""
    path = ensemble(f'size = 200\nchunk = 30\nkeep = "{keep}"', **parts)
    marks = set()
    for threads in (1, 3):
        out = tmp_path / f"{keep}{threads}.{extension}"
        done = run.ok("ensemble", path, "--out", out, "--threads", threads)
        files = [out.with_suffix(f".{name}.{extension}") for name in names]
        marks.add(tuple(mark(file) for file in [out, *files]))
        for name, file in zip(names, files):
            assert f"histogram         {name}: {file}\n" in done.stdout
    assert len(marks) == 1
    return [rows_of(file) for file in [out, *files]] if extension == "csv" else [out, *files]


def same(table, counts, edges, columns):
    """Whether a table has these counts between these edges, and nothing beyond but what is left."""
    shape = [len(edge) + 1 for edge in edges]
    found = table["members"].reshape(shape)
    assert (found[tuple([slice(1, -1)] * len(shape))] == counts).all()
    for axis, (edge, column) in enumerate(zip(edges, columns)):
        low, high = (numpy.moveaxis(table[f"{column}_{end}"].reshape(shape), axis, -1)
                     for end in ("low", "high"))
        assert (low == numpy.concatenate([[-numpy.inf], edge])).all()
        assert (high == numpy.concatenate([edge, [numpy.inf]])).all()
    assert (table["part"] == table["members"] / table["members"].sum()).all()
    return found.sum() - counts.sum()


def test_histograms_are_those_of_the_rows(run, ensemble, tmp_path):
    vary = (histogram("w3", ["w3"], bins=7, low=[0.9], high=[1.1])
            + histogram("both", ["w1", "body.moments[1]"], bins=5, low=[-0.1, 1.5], high=[0.1, 2.3])
            + histogram("own", ["body.moments[1]", "w2"], bins=6)
            + histogram("times", ["w2"], bins=4, low=[-0.2], high=[0.2], times="all") + VARY)
    parts = {"columns": '"omega", "andoyer"', "vary": vary, "extra": TORQUE,
             "time": "stop = 20\ncount = 5"}
    rows, = made(run, ensemble, tmp_path, "rows", **parts)
    final, = made(run, ensemble, tmp_path, "final", **parts)
    names = ["w3", "both", "own", "times"]
    _, w3, both, own, times = made(run, ensemble, tmp_path, "statistics", names, **parts)
    assert not (tmp_path / "rows1.w3.csv").exists()
    edges = w3["w3_low"][1:]
    assert abs(edges - numpy.linspace(0.9, 1.1, 8)).max() < budgets.ensemble_statistics
    assert same(w3, numpy.histogram(final["w3"], edges)[0], [edges], ["w3"]) > 0
    columns = ["w1", "body.moments[1]"]
    edges = [numpy.unique(both[f"{one}_low"])[1:] for one in columns]
    counts = numpy.histogram2d(*(final[one] for one in columns), edges)[0]
    assert same(both, counts, edges, columns) > 0 and (counts > 0).sum() > 10
    columns = ["body.moments[1]", "w2"]
    edges = [numpy.unique(own[f"{one}_low"])[1:] for one in columns]
    for edge, one in zip(edges, columns):
        assert (edge[0], edge[-1]) == (final[one].min(), final[one].max())
    assert same(own, numpy.histogram2d(*(final[one] for one in columns), edges)[0], edges,
                columns) == 0
    assert sorted(set(times["t"])) == sorted(set(rows["t"])) and (own["t"] == 20).all()
    for t in set(rows["t"]):
        here = {name: column[times["t"] == t] for name, column in times.items()}
        edges = here["w2_low"][1:]
        same(here, numpy.histogram(rows["w2"][rows["t"] == t], edges)[0], [edges], ["w2"])


def test_angles_are_counted_in_the_turn_of_the_bins(run, ensemble, tmp_path):
    vary = (histogram("turn", ["g"], bins=12, low=[90], high=[450])
            + histogram("part", ["g"], bins=3, low=[170], high=[200]) + VARY)
    parts = {"columns": '"andoyer"', "vary": vary, "time": "stop = 20\ncount = 2",
             "body": 'moments = [1, 2, 2.5]\n[units]\nangle = "deg"\ntime = "s"',
             "state": "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [6, 12, 57]"}
    vary_degrees = vary.replace("sigma = 0.05", "sigma = 9")
    parts["vary"] = vary_degrees
    final, = made(run, ensemble, tmp_path, "final", **parts)
    _, turn, part = made(run, ensemble, tmp_path, "statistics", ["turn", "part"], **parts)
    g = final["g"]
    edges = turn["g_low"][1:]
    assert same(turn, numpy.histogram(numpy.where(g < 90, g + 360, g), edges)[0], [edges], "g") == 0
    assert (turn["members"][1:-1] > 0).sum() > 6
    edges = part["g_low"][1:]
    counts = numpy.histogram(numpy.remainder(g, 360), edges)[0]
    assert same(part, counts, [edges], "g") > 0 and counts.sum() > 0


def test_first_times_and_what_was_drawn(run, ensemble, tmp_path):
    """Members that the event has stopped have no row at the last time, but a first time."""
    event = '[[event]]\nname = "end"\ncolumn = "w1"\nvalue = 0\nstops = true\n'
    vary = histogram("ends", ["end_first", "body.moments[1]"], bins=4) + VARY
    parts = {"columns": '"omega"', "vary": vary, "extra": event}
    final, = made(run, ensemble, tmp_path, "final", **parts)
    _, ends = made(run, ensemble, tmp_path, "statistics", ["ends"], **parts)
    ended = numpy.isfinite(final["end_first"])
    assert ends["members"].sum() == ended.sum() > 100
    assert ends["end_first_high"][-2] == numpy.inf
    assert ends["end_first_low"].max() == final["end_first"][ended].max()


def test_histograms_in_hdf5(run, ensemble, tmp_path):
    vary = histogram("w3", ["w3"], bins=7) + VARY
    _, file = made(run, ensemble, tmp_path, "statistics", ["w3"], "h5", vary=vary)
    with h5py.File(file) as table:
        assert table["w3"].attrs["columns"].tolist() == ["w3_low", "w3_high"]
        assert table["members"][:, 0].sum() == 200 and len(table["t"]) == 9
    assert {names[0] for names in dimensions(file).values()} == {"bin"}


def test_histograms_survive_kills(polhode, run, ensemble, tmp_path):
    vary = (histogram("own", ["w1"], bins=20, times="all")
            + histogram("fixed", ["w1", "w2"], bins=9, low=[-1, -1], high=[1, 1]) + VARY)
    path = ensemble("size = 600\nchunk = 10", extra=TORQUE, time="stop = 400\nstep = 4", vary=vary)
    whole, out = tmp_path / "whole.csv", tmp_path / "part.csv"
    run.ok("ensemble", path, "--out", whole)
    command = ["ensemble", path, "--out", out, "--resume", "--checkpoint", "0"]
    checkpoint = tmp_path / "part.csv.checkpoint"
    for threads in ("1", "2"):
        before = bytes_of(checkpoint)
        process = subprocess.Popen([polhode, *command, "--threads", threads],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for_another(checkpoint, before, process)
        process.kill()
        process.wait()
    done = run(*command)
    assert done.returncode == 0 and "continues after " in done.stderr
    for name in ("", ".own", ".fixed"):
        assert (tmp_path / f"part{name}.csv").read_bytes() == (
            tmp_path / f"whole{name}.csv").read_bytes()
    assert len(list(tmp_path.iterdir())) == 7
    assert "nothing to do" in run(*command).stdout
    (tmp_path / "part.own.csv").unlink()
    done = run(*command)
    assert done.returncode == 2
    assert "part.own.csv: is not there, and what it belongs to is done with it" in done.stderr


REFUSED = [
    (histogram("a", ["w4"]), 'expected columns of [output] columns, or keys that vary; w4 is none'),
    (histogram("a", ["w1", "t"]), "; t is none"),
    (histogram("a", ["w1", "w2", "w3"]), "expected one column or two different ones"),
    (histogram("a", ["w1", "w1"]), "expected one column or two different ones"),
    (histogram("a", ["w1"], bins=0), "ensemble.histogram[0].bins: got 0; expected a whole number"),
    (histogram("a", ["w1"], low=[1]), "ensemble.histogram[0].high: got nothing; expected low and"),
    (histogram("a", ["w1"], low=[1, 2], high=[3, 4]), "expected one number, for the one column"),
    (histogram("a", ["w1", "w2"], low=[1], high=[3]), "expected two numbers, one for each of"),
    (histogram("a", ["w1"], low=[1], high=[1]), ".low: got [1]; expected less than high"),
    (histogram("a", ["w1"]) * 2, 'ensemble.histogram[1].name: got "a"; expected a name of its own'),
    (histogram("a", ["w1"], times="some"), 'ensemble.histogram[0].times: got "some"; expected'),
    (histogram("a", ["w1", "w2"], bins=10000), "expected 2 GB at most"),
    (histogram("a", ["w1", "w2"], bins=2000, times="all"), "expected 2 GB at most"),
]


@pytest.mark.parametrize(("tables", "message"), REFUSED)
def test_what_is_no_histogram_is_refused(run, ensemble, tmp_path, tables, message):
    path = ensemble("size = 5", vary=tables + VARY)
    assert message in run.rejected("ensemble", path, "--out", tmp_path / "out.csv")
    assert not list(tmp_path.glob("out*"))


def test_histograms_stand_next_to_a_file(run, ensemble, tmp_path):
    path = ensemble("size = 5", vary=histogram("a", ["w1"]) + VARY)
    done = run("ensemble", path)
    assert done.returncode == 2
    assert "ensemble.histogram: got - as the first output; expected a file" in done.stderr
    out, other = tmp_path / "o.csv", tmp_path / "o.a.csv"
    assert "o.a.csv" in run.rejected("ensemble", path, "--out", out, "--out", other)
    assert not out.exists() and not other.exists()
