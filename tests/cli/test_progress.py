# SPDX-License-Identifier: MIT
"""What a long run says while it goes on: on standard error, and only when it takes seconds."""

import os
import pty
import re
import select
import subprocess

import pytest
from fit_files import TUMBLER
from slowdown import SLOWDOWN

SECONDS = 30 * SLOWDOWN
BAR = re.compile(r"\[[#.]{8,40}\] (.*)")
LINE = re.compile(r" *\d+ %, t = \S+ s, \S+ s per second, \S+ (s|min|h|d) left")

COUNTED = re.compile(r" *\d+ %, \d+ of 1000000 members, \S+ members per second, "
                     r"\S+ (s|min|h|d) left")


@pytest.fixture
def endless(scenario):
    """Years of a satellite whose torque makes every turn cost something."""
    text = scenario(columns='"q"').read_text().split("[time]")[0] + """
[[perturbation]]
kind = "damping"
coefficients = [1e-12, 1e-12, 1e-12]

[time]
stop = 1e9
count = 10

[output]
columns = ["q"]
"""
    path = scenario(columns='"q"').with_name("endless.toml")
    path.write_text(text)
    return path


def test_elsewhere_it_is_a_plain_line(polhode, endless, tmp_path):
    process = subprocess.Popen([polhode, "run", endless, "--out", tmp_path / "rows.csv"],
                               stderr=subprocess.PIPE, text=True)
    try:
        line = process.stderr.readline()
    finally:
        process.kill()
        process.communicate()
    assert LINE.fullmatch(line.rstrip("\n")), line


def test_many_runs_are_counted(polhode, ensemble, tmp_path):
    path = ensemble("size = 1000000\nchunk = 100", time="stop = 40\nstep = 0.1")
    process = subprocess.Popen([polhode, "ensemble", path, "--out", tmp_path / "rows.csv"],
                               stderr=subprocess.PIPE, text=True)
    try:
        line = process.stderr.readline()
    finally:
        process.kill()
        process.communicate()
    assert COUNTED.fullmatch(line.rstrip("\n")), line


def test_on_a_terminal_it_is_written_over(polhode, endless, tmp_path):
    ours, theirs = pty.openpty()
    process = subprocess.Popen([polhode, "run", endless, "--out", tmp_path / "rows.csv"],
                               stderr=theirs)
    os.close(theirs)
    try:
        shown = ""
        while shown.count("left") < 3 and select.select([ours], [], [], SECONDS)[0]:
            shown += os.read(ours, 1000).decode()
    finally:
        process.kill()
        process.wait()
        os.close(ours)
    assert "\n" not in shown
    lines = [line.removesuffix("\x1b[K") for line in shown.split("\r") if line]
    for line in lines[:2]:
        assert LINE.fullmatch(BAR.fullmatch(line).group(1)), lines


def test_a_short_run_says_nothing(run, scenario, tmp_path):
    done = run("run", scenario(columns='"q"'), "--out", tmp_path / "rows.csv")
    assert (done.returncode, done.stderr) == (0, "")


PART = re.compile(r"scan: \d+ %, \S+ (s|min|h|d) left")
WORK = re.compile(r"scan: 14630625 pairs of frequencies, about \S+ (s|min|h|d)")


def test_a_scan_says_how_long_it_takes(polhode, run, fit_file, tmp_path):
    """First its size with an estimate, then percent and the time left."""
    path = fit_file(
        '[[observation]]\nkind = "light-curve"\nfile = "night.csv"\ntimes = "at-body"\n'
        "to_sun = [1, 0.2, 0.3]\nto_observer = [0.8, 0.6, 0.1]\nsigma = 0.02\n"
        '[free]\nunknowns = ["attitude", "rate", "shape"]\n[fit]\nfrom = "search"\n'
        "[fit.scan]\norder = 4\nshortest = 0.5\nlongest = 120\n", head=TUMBLER)
    run.ok("simulate", path, "--into", tmp_path, "--set", "time.count=201")
    process = subprocess.Popen([polhode, "fit", path], stderr=subprocess.PIPE, text=True)
    try:
        work, part = process.stderr.readline(), process.stderr.readline()
    finally:
        process.kill()
        process.communicate()
    assert WORK.fullmatch(work.rstrip("\n")), work
    assert PART.fullmatch(part.rstrip("\n")), part
