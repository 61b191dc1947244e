# SPDX-License-Identifier: MIT
"""The stub as a type checker reads it."""

import os
import pathlib
import runpy
import subprocess
import sys

import polhode
import pytest

PROGRAM = pathlib.Path(__file__).with_name("typed_program.py")


def checked(path, cache):
    found = pathlib.Path(polhode.__file__).parents[1]
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, path],
        env={**os.environ, "PYTHONPATH": str(found)}, capture_output=True, text=True)


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("mypy")


def test_states_are_floats_or_arrays_by_what_they_were_made_from(cache):
    done = checked(PROGRAM, cache)
    assert done.returncode == 0, done.stdout
    runpy.run_path(str(PROGRAM))


@pytest.mark.parametrize("good, wrong", [
    ("assert_type(one.L, float)", "assert_type(one.L, Array)"),
    ("length(many)", "length(one)"),
    ("polhode.RotorState[float])", "polhode.RotorState[Array])"),
    ("motion.at(1.0)", "motion.at(body)"),
])
def test_what_is_wrong_is_found(cache, tmp_path, good, wrong):
    text = PROGRAM.read_text()
    assert good in text
    path = tmp_path / "wrong.py"
    path.write_text(text.replace(good, wrong))
    assert checked(path, cache).returncode == 1
