# SPDX-License-Identifier: MIT
"""`polhode map`: the same bytes for any number of threads, and after any number of kills."""

import subprocess
import time

import budgets
import h5py
import numpy
import pytest

MAP = """
[map]
kind = "chaos"
[[map.axis]]
key = "body.moments[1]"
from = 1.2
to = 2.4
count = 13
[[map.axis]]
key = "state.attitude-rate.omega_body[2]"
from = 0
to = 1
count = 11
"""


@pytest.fixture
def map_file(scenario):
    path = scenario(time="stop = 2000\ncount = 2")
    path.write_text(path.read_text() + MAP)
    return path


def test_any_number_of_threads_gives_the_same_file(run, map_file, tmp_path):
    outputs = []
    for threads in (1, 2, 5):
        out = tmp_path / f"{threads}.csv"
        result = run("map", map_file, "--out", out, "--threads", threads)
        assert result.returncode == 0, result.stderr
        assert "cells             143" in result.stdout
        outputs.append(out.read_bytes())
    assert outputs[0] == outputs[1] == outputs[2]


def test_a_map_survives_kills(polhode, run, map_file, tmp_path):
    whole, out, table = tmp_path / "whole.csv", tmp_path / "part.csv", tmp_path / "part.h5"
    assert run("map", map_file, "--out", whole).returncode == 0
    command = [polhode, "map", map_file, "--out", out, "--out", table, "--resume"]
    cells = tmp_path / "part.csv.cells"
    lengths = []
    for pause in (0.02, 0.15, 0.05, 0.1):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(pause)
        process.kill()
        process.wait()
        lengths.append(cells.stat().st_size if cells.exists() else 0)
    assert not out.exists() or lengths[-1] == 0  # the name is that of a whole file
    result = run(*command[1:])
    assert result.returncode == 0, result.stderr
    assert out.read_bytes() == whole.read_bytes() and not cells.exists()
    rows = numpy.loadtxt(whole, delimiter=",", skiprows=0, comments=["#", "body"])
    with h5py.File(table) as file:
        numpy.testing.assert_array_equal(file["chaos"][:], rows[:, 2:])
        numpy.testing.assert_array_equal(file["body.moments[1]"][:, 0], rows[:, 0])


SECTION = """
[[perturbation]]
kind = "constant-torque"
torque = [1e-4, 0, 2e-4]
[map]
kind = "andoyer-section"
angle = "g"
[[map.axis]]
key = "state.attitude-rate.omega_body[1]"
from = 0.1
to = 0.9
count = 9
"""


def test_a_section_is_the_same_for_any_number_of_threads_and_after_kills(
        polhode, run, scenario, tmp_path):
    path = scenario(time="stop = 4000\ncount = 2")
    path.write_text(path.read_text() + SECTION)
    outputs = []
    for threads in (1, 3):
        out = tmp_path / f"{threads}.csv"
        result = run("map", path, "--out", out, "--threads", threads)
        assert result.returncode == 0, result.stderr
        assert "cells             9\npoints            " in result.stdout
        outputs.append(out.read_bytes())
    assert outputs[0] == outputs[1]
    rows = numpy.loadtxt(tmp_path / "1.csv", delimiter=",", comments=["#", "state"])
    assert len(rows) > 1000 and len(set(rows[:, 0])) == 9
    out = tmp_path / "killed.csv"
    command = [polhode, "map", path, "--out", out, "--resume"]
    for pause in (0.1, 0.2, 0.3):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(pause)
        process.kill()
        process.wait()
    assert run(*command[1:]).returncode == 0
    assert out.read_bytes() == outputs[0]


def test_the_section_of_hyperion_has_curves_and_a_sea(run, root, tmp_path):
    out = tmp_path / "hyperion.csv"
    assert run("map", root / "examples/hyperion-section.toml", "--out", out).returncode == 0
    rows = numpy.loadtxt(out, delimiter=",", comments=["#", "state"])
    n = 16.9196785  # deg/d
    across = rows[rows[:, 1] == 90]
    regular, chaotic = (across[abs(across[:, 0] / n - spin) < budgets.section_axis][:, 3:5]
                        for spin in (2.6, 1.0))
    assert len(regular) == len(chaotic) == 200

    def boxes(points):
        return len({(int(angle // 6), int(spin // 0.1)) for angle, spin in points})

    assert boxes(regular) < 60 and boxes(chaotic) > 120


def test_what_is_no_map(run, scenario, map_file, tmp_path):
    result = run("map", scenario(name="plain.toml"))
    assert result.returncode == 2 and "expected a table [map]" in result.stderr
    result = run("map", map_file, "--resume")
    assert result.returncode == 2 and "--resume" in result.stderr
    (tmp_path / "m.csv.cells").write_text("something else\n")
    result = run("map", map_file, "--out", tmp_path / "m.csv", "--resume")
    assert result.returncode == 2 and "is of another map" in result.stderr
