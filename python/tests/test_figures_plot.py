# SPDX-License-Identifier: MIT
"""What plot chooses for each kind of result, from memory and from files."""

import pathlib

import fit_calls
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import polhode  # noqa: E402
import pytest  # noqa: E402
from polhode import figures, vary  # noqa: E402
from polhode.figures.__main__ import draw  # noqa: E402
from rejections import rejected  # noqa: E402
from scenario_texts import FREE  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = polhode.Scenario.from_text(FREE)
KEY = "body.moments[0]"
AXIS = 'key = "body.moments[0]"\nfrom = 0.5\nto = 0.6\ncount = 3\n'
EPOCH = '[units]\ntime = "s"\n[state]\nepoch = "2020-01-01T00:00:00 UTC"\n'
DATED = polhode.Scenario.from_text(FREE.replace("[state.", EPOCH + "[state.", 1)).with_columns(
    ["date", "omega"])
SPIN = 'key = "state.attitude-rate.omega_body[0]"\nfrom = 0.1\nto = 0.2\ncount = 2\n'


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def ids(axes):
    return [line.get_gid() for axis in np.ravel(axes) for line in axis.get_lines()]


@pytest.mark.parametrize("name", ["a.csv", "a.h5"])
def test_a_run_in_memory_and_in_files(name, tmp_path):
    if name.endswith("h5"):
        pytest.importorskip("h5py")
    results = SCENARIO.run(tmp_path / name)
    from_memory, from_file = results.plot(), figures.plot(tmp_path / name)
    assert from_memory.shape == from_file.shape == (3,)
    for ours, theirs in zip(from_memory[1].get_lines(), from_file[1].get_lines()):
        assert np.array_equal(ours.get_ydata(), theirs.get_ydata(), equal_nan=True)
    assert ids(results.plot("w1")) == ids(figures.plot(tmp_path / name, "w1")) == ["w1"]
    assert len(results.plot(["w1", "qw"])) == 2
    rejected(ValueError, 'no column "w4"', results.plot, "w4")


def test_a_run_without_attitudes_is_drawn_by_columns():
    axes = SCENARIO.with_columns("omega").run().plot()
    assert len(axes) == 1 and ids(axes) == ["w1", "w2", "w3"]  # components share a panel


@pytest.mark.parametrize("name", ["q.csv", "q.h5"])
def test_a_run_of_attitudes_without_rates(name, tmp_path):
    if name.endswith("h5"):
        pytest.importorskip("h5py")
    results = SCENARIO.with_columns("q").run(tmp_path / name)
    for axes in (results.plot(), figures.plot(tmp_path / name)):
        assert len(axes) == 1 and ids(axes) == ["qw", "qx", "qy", "qz"]
        assert np.array_equal(axes[0].get_lines()[0].get_ydata(), results["qw"])


def test_times_are_not_drawn_against_themselves(tmp_path):
    refusal = "got the column t; expected columns to draw against it"
    runs = SCENARIO.run(tmp_path / "a.csv")
    for names in ("t", ["w1", "t"]):
        rejected(ValueError, refusal, runs.plot, names)
        rejected(ValueError, refusal, figures.plot, tmp_path / "a.csv", names)
    assert draw(str(tmp_path / "a.csv"), columns=["t"]) == 2
    for keep in ("rows", "statistics"):
        path = tmp_path / f"{keep}.csv"
        scenario = SCENARIO.with_columns("omega")
        scenario.ensemble(path, vary={KEY: vary.uniform(0.5, 0.6)}, size=2, keep=keep)
        rejected(ValueError, refusal, figures.plot, path, "t")


@pytest.mark.parametrize("ending", ["csv", "h5"])
def test_dates_of_ensembles_are_no_numbers(ending, tmp_path):
    if ending == "h5":
        pytest.importorskip("h5py")
    drawn = {KEY: vary.uniform(0.5, 0.6)}
    medians = ["w1-median", "w2-median", "w3-median"]
    for keep, lines in (("rows", medians), ("statistics", medians), ("final", [])):
        path = tmp_path / f"{keep}.{ending}"
        found = DATED.ensemble(path, vary=drawn, size=4, keep=keep)
        for axes in (found.plot(), figures.plot(path)):
            assert ids(axes) == lines
            assert not lines or np.isfinite(axes[0].get_lines()[0].get_ydata()).all()
        if keep != "statistics":
            assert found["date"].dtype.kind == "U"
            rejected(ValueError, 'the column "date" has no numbers', found.plot, "date")
            rejected(ValueError, 'the column "date" has no numbers', figures.plot, path, "date")


def test_ensembles_by_what_they_keep(tmp_path):
    scenario = SCENARIO.with_columns(["tumbler", "omega"])
    for keep in ("statistics", "final", "rows"):
        path = tmp_path / f"{keep}.csv"
        found = scenario.ensemble(path, vary={KEY: vary.uniform(0.5, 0.6)}, size=6, keep=keep)
        assert ids(found.plot()) == ids(figures.plot(path))
    assert "w1-median" in ids(found.plot("w1"))
    t, rows = np.unique(found["t"]), found["w1"].reshape(6, -1)
    (median,) = (line for line in found.plot("w1")[0].get_lines() if line.get_gid() == "w1-median")
    assert np.array_equal(median.get_xdata(), t)
    assert np.allclose(median.get_ydata(), np.median(rows, axis=0), rtol=1e-12)


def test_fits():
    found = polhode.fit.fit_scenario(fit_calls.TOUTATIS)
    drawn = ids(found.plot())
    assert drawn[:3] == ["turn_x", "turn_y", "turn_z"] and "line" not in drawn
    assert ids(found.plot("turn_x")) == ["turn_x"]


@pytest.mark.parametrize("name", ["m.csv", "m.h5"])
def test_maps_by_their_axes(name, tmp_path):
    if name.endswith("h5"):
        pytest.importorskip("h5py")
    head = FREE + '[map]\nkind = "column"\ncolumn = "w1"\n'
    line = polhode.Scenario.from_text(head + "[[map.axis]]\n" + AXIS)
    found = line.map(tmp_path / name)
    (ours,), (theirs,) = found.plot().get_lines(), figures.plot(tmp_path / name).get_lines()
    assert np.array_equal(ours.get_xdata(), [0.5, 0.55, 0.6])
    assert np.array_equal(ours.get_ydata(), theirs.get_ydata())
    both = head + "[[map.axis]]\n" + AXIS + "[[map.axis]]\n" + SPIN
    grid = polhode.Scenario.from_text(both).map(tmp_path / f"2{name}")
    for axis in (grid.plot(), figures.plot(tmp_path / f"2{name}")):
        (mesh,) = axis.collections
        assert mesh.get_array().size == 6
    rejected(ValueError, 'no column "w4"', found.plot, "w4")
    for source in (name, f"2{name}"):
        rejected(ValueError, "got 2 columns; expected one for a map",
                 figures.plot, tmp_path / source, ["w1_last", "w1_largest"])


def test_a_section_is_drawn_as_points(tmp_path):
    example = polhode.load(ROOT / "examples/hyperion-section.toml")
    found = example.replace({"time.stop": 100}).map(tmp_path / "s.csv")
    drawn = [figures.plot(source).get_lines() for source in (found, tmp_path / "s.csv")]
    assert [len(line.get_xdata()) for line in drawn[0]] == [
        len(line.get_xdata()) for line in drawn[1]
    ]
    assert sum(len(line.get_xdata()) for line in drawn[0]) > 50
    (first, *_), (tilt, *_) = drawn[0], found.plot(["angle", "tilt"]).get_lines()
    assert len(tilt.get_xdata()) == len(first.get_xdata())
    rejected(ValueError, "expected two columns, x and y, or none", found.plot, "tilt")
    rejected(ValueError, "expected two columns", found.plot, ["angle", "spin", "tilt"])


def test_rows_of_another_length_are_named_by_their_line(tmp_path):
    path = tmp_path / "a.csv"
    SCENARIO.run(path)
    whole = path.read_text()
    last = whole.count("\n")
    path.write_text(whole[: whole.rindex(",")])  # as a full disk leaves it
    rejected(ValueError, rf'a\.csv:{last}: got the row "10,.*"; expected 8 numbers, as in the line '
             "of names$", figures.plot, path)
    path.write_text("# a note\nt,x\n0,1\n# another\n1,2,3\n2,3\n")
    rejected(ValueError, r'a\.csv:5: got the row "1,2,3"; expected 2 numbers', figures.plot, path)


def test_hdf5_of_other_programs_is_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "a.h5"

    def attributes(thing, **named):
        thing.attrs.update(named)

    contents = {
        "nothing": lambda file: None,
        "plain arrays": lambda file: file.update({"t": np.arange(3.0), "x": 1.0}),
        "groups": lambda file: attributes(file.create_group("g"), columns=["x"], units=["1"]),
        "no units": lambda file: attributes(file.create_dataset("x", (2, 1)), columns=["x"]),
        "another shape": lambda file: attributes(
            file.create_dataset("x", (2,)), columns=["x", "y"], units=["1", "1"]),
        "other numbers": lambda file: attributes(
            file.create_dataset("x", (2, 1), dtype=complex), columns=["x"], units=["1"]),
    }
    for write in contents.values():
        with h5py.File(path, "w") as file:
            write(file)
        rejected(ValueError, r"a\.h5: no columns; expected a table that polhode wrote",
                 figures.plot, path)
    path.write_bytes(path.read_bytes()[:20])
    rejected(OSError, r"a\.h5: ", figures.plot, path)


def test_what_cannot_be_drawn_is_refused(tmp_path):
    (tmp_path / "a.csv").write_text("t,x\n0,1\n1,2\n")
    assert ids(figures.plot(tmp_path / "a.csv")) == ["x"]
    (tmp_path / "b.csv").write_text("t\n0\n")
    rejected(ValueError, "no numbers against t; there are: t", figures.plot, tmp_path / "b.csv")
    (tmp_path / "c.csv").write_text("")
    rejected(ValueError, "no columns; expected a table", figures.plot, tmp_path / "c.csv")
    chunks = SCENARIO.ensemble(
        tmp_path / "k-{chunk}.csv", vary={KEY: vary.uniform(0.5, 0.6)}, size=3, keep="final"
    )
    rejected(ValueError, "index of chunks", chunks.plot)
