# SPDX-License-Identifier: MIT
"""A run whose files cannot lie on the disk is refused before it begins; of one that may not find
room there is a word."""

import re
import shutil
import signal
import subprocess

import pytest

NUMBERS = 11  # of a row: t, q, omega, g
TEXT = r"(\d+) bytes needed for (\d+) rows of 11 numbers, (\d+) bytes free there"


@pytest.mark.parametrize("name, number_bytes", [("a.csv", 2), ("a.h5", 8)])
def test_rows_that_no_disk_holds_are_refused(run, scenario, tmp_path, name, number_bytes):
    path = tmp_path / name
    done = run("run", scenario(time="stop = 1e16\nstep = 10"), "--out", path)
    assert done.returncode == 1 and done.stderr.count("\n") == 1
    found = re.fullmatch(rf"body.toml: got {path}: {TEXT}; expected fewer rows or columns, or "
                         r"another disk\n", done.stderr)
    assert int(found[1]) == pytest.approx(1e15 * NUMBERS * number_bytes)
    assert int(found[2]) == pytest.approx(1e15)
    assert [x.name for x in tmp_path.iterdir()] == ["body.toml"]


def test_outputs_on_one_disk_share_its_room(run, scenario, tmp_path):
    rows = int(0.7 * shutil.disk_usage(tmp_path).free / (8 * NUMBERS))
    body = scenario(time=f"stop = {rows}\nstep = 1")
    paths = [tmp_path / "a.h5", tmp_path / "b.h5"]
    done = run("run", body, "--out", paths[0], "--out", paths[1])
    assert done.returncode == 1
    assert done.stderr.startswith(f"body.toml: got {paths[0]}, {paths[1]}: ")


def test_a_run_that_an_event_may_end_is_not_refused(run, scenario, tmp_path):
    body = scenario(time="stop = 1e16\nstep = 10")
    body.write_text(body.read_text() + '[[event]]\ncolumn = "qw"\nvalue = 0.9\nstops = true\n')
    done = run.ok("run", body, "--out", tmp_path / "a.h5")
    assert re.match(rf"body.toml: the disk may not hold {tmp_path}/a.h5: {TEXT}\n", done.stderr)


def test_of_text_that_may_not_find_room_there_is_a_word(polhode, scenario, tmp_path):
    rows = shutil.disk_usage(tmp_path).free // (6 * NUMBERS)
    body = scenario(time=f"stop = {rows}\nstep = 1")
    process = subprocess.Popen([polhode, "run", body, "--out", tmp_path / "a.csv"],
                               stderr=subprocess.PIPE, text=True)
    line = process.stderr.readline()
    process.send_signal(signal.SIGINT)
    process.communicate()
    assert re.fullmatch(rf"body.toml: the disk may not hold {tmp_path}/a.csv: {TEXT}\n", line)


def test_rows_that_no_disk_takes_need_no_room(run, scenario):
    body = scenario(time="stop = 1e16\nstep = 10")
    done = run("run", body, "--out", "/dev/full")
    assert done.stderr == "/dev/full: cannot be written: No space left on device\n"
