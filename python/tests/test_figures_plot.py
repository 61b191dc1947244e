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
from rejections import rejected  # noqa: E402
from scenario_texts import FREE  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = polhode.Scenario.from_text(FREE)
KEY = "body.moments[0]"
AXIS = 'key = "body.moments[0]"\nfrom = 0.5\nto = 0.6\ncount = 3\n'
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


def test_a_section_is_drawn_as_points(tmp_path):
    example = polhode.load(ROOT / "examples/hyperion-section.toml")
    found = example.replace({"time.stop": 100}).map(tmp_path / "s.csv")
    drawn = [figures.plot(source).get_lines() for source in (found, tmp_path / "s.csv")]
    assert [len(line.get_xdata()) for line in drawn[0]] == [
        len(line.get_xdata()) for line in drawn[1]
    ]
    assert sum(len(line.get_xdata()) for line in drawn[0]) > 50


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
