# SPDX-License-Identifier: MIT
"""`polhode map`: the same bytes for any number of threads, and after any number of kills."""

import subprocess
import time

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


def test_what_is_no_map(run, scenario, map_file, tmp_path):
    result = run("map", scenario(name="plain.toml"))
    assert result.returncode == 2 and "expected a table [map]" in result.stderr
    result = run("map", map_file, "--resume")
    assert result.returncode == 2 and "--resume" in result.stderr
    (tmp_path / "m.csv.cells").write_text("something else\n")
    result = run("map", map_file, "--out", tmp_path / "m.csv", "--resume")
    assert result.returncode == 2 and "is of another map" in result.stderr
