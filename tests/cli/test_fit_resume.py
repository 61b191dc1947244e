# SPDX-License-Identifier: MIT
"""Fits that are stopped or killed, and continued with --resume."""

import random
import signal
import subprocess
import time

import pytest
from fit_files import FREE, FREE_LIGHT, NIGHT, TUMBLER

SEARCH = """
[fit]
from = "search"
starts = {starts}
within_factor = 1.5
"""
PERIODS = """
[[fit.periods]]
mode = "LAM"
precession_period = 12
rotation_period = 20
"""
SCAN = """
[fit.scan]
order = 2
shortest = 5
longest = 40
pairs = 2
labels = 4
"""
ATTITUDES = """
[[observation]]
kind = "attitude"
file = "seen.csv"
times = "at-body"
sigma = "2 deg"
"""
# name: what stands in the file behind its head and its night
LIGHT = {
    "periods": SEARCH.format(starts=80) + PERIODS,
    "scan": SEARCH.format(starts=60) + SCAN,
    "convex": SEARCH.format(starts=20) + PERIODS
    + '[light]\nshape = "convex"\n[light.convex]\ndegree = 3\nrows = 3\n',
}
# The halves of the night as sessions of a convex body.
HALVES = [NIGHT + f"leave_out = {list(lines)}\n" for lines in (range(5, 46), range(46, 86))]
LIGHT["sessions"] = LIGHT["convex"].replace("[fit]\n", '[fit]\nsessions = "one-by-one"\n')
OUTPUTS = ("--solution", "found.toml", "--residuals", "left.csv")


def start(run, path, folder, *options):
    folder.mkdir(exist_ok=True)
    outputs = [word if word.startswith("--") else str(folder / word) for word in OUTPUTS]
    return subprocess.Popen([run.program, "fit", str(path), *outputs, *options],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture
def light_file(night, fit_file):
    return lambda name: fit_file(*(HALVES if name == "sessions" else [NIGHT]), FREE_LIGHT,
                                 LIGHT[name], head=TUMBLER, name="search.toml")


@pytest.fixture
def attitude_file(run, fit_file, tmp_path):
    """Several starts of a fit of attitudes."""
    path = fit_file(ATTITUDES, FREE, "[fit]\nstarts = 40\nrate_spread = \"2 deg/h\"\n")
    run.ok("simulate", path, "--into", tmp_path)
    return path


def killed_fit(run, path, folder, seconds, kills=5, seed=1):
    """Kills a fit `kills` times at random moments; then lets it end. Its output, and how many of
    its starts continued from results. A fit that ends before it is killed does not count: the
    machine was slower when `seconds` was measured."""
    draw = random.Random(seed)
    killed = continued = 0
    while True:
        begun = time.monotonic()
        process = start(run, path, folder, "--resume", "--checkpoint", "0")
        if killed < kills:
            try:
                process.wait(draw.uniform(0.3, 1.0) * seconds)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
        out, error = process.communicate()
        assert process.returncode in (0, -signal.SIGKILL), error
        has_continued = "continues after" in error
        continued += has_continued
        if process.returncode != 0:
            killed += 1
        elif killed >= kills:
            return out, continued
        elif not has_continued:
            seconds = time.monotonic() - begun


@pytest.mark.parametrize("name", LIGHT)
def test_a_killed_search_ends_in_the_same_files(run, light_file, tmp_path, name):
    path = light_file(name)
    begun = time.monotonic()
    out, error = start(run, path, tmp_path / "straight").communicate()
    assert out, error
    seconds = time.monotonic() - begun
    killed, continued = killed_fit(run, path, tmp_path / "killed", seconds)
    assert continued > 0 and killed == out
    assert contents(tmp_path / "killed") == contents(tmp_path / "straight")


def test_killed_starts_of_attitudes_end_in_the_same_files(run, attitude_file, tmp_path):
    begun = time.monotonic()
    out, error = start(run, attitude_file, tmp_path / "straight").communicate()
    assert out, error
    seconds = time.monotonic() - begun
    killed, _ = killed_fit(run, attitude_file, tmp_path / "killed", seconds)
    assert killed == out
    assert contents(tmp_path / "killed") == contents(tmp_path / "straight")


@pytest.fixture
def stopped(run, light_file, tmp_path):
    """A search that Ctrl-C has stopped: its file, folder and last line."""
    path = light_file("periods")
    process = start(run, path, tmp_path / "out", "--set", "fit.starts=100000", "--checkpoint", "0")
    while process.poll() is None and not (tmp_path / "out/found.toml.checkpoint").exists():
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    out, error = process.communicate(timeout=60)
    assert process.returncode == 128 + signal.SIGINT and out == ""
    return path, tmp_path / "out", error


def test_a_stopped_search_says_how_to_continue(stopped):
    path, folder, error = stopped
    assert "stopped in the search; continue with: " in error
    assert error.rstrip().endswith("--resume")
    assert f"fit {path} --set fit.starts=100000 --solution {folder}/found.toml" in error
    text = (folder / "found.toml.checkpoint").read_bytes().split(b"\n")[0].decode()
    assert text.startswith("search.toml after ") and text.endswith(" results")


def test_an_unfinished_fit_is_not_lost(run, stopped):
    path, folder, _ = stopped
    again = ["fit", path, "--set", "fit.starts=100000", "--solution", folder / "found.toml",
             "--residuals", folder / "left.csv"]
    said = run.rejected(*again)
    assert "an unfinished fit is there" in said
    assert "--resume continues it, --restart begins anew" in said
    other = run.rejected(*again, "--set", "fit.seed=2", "--resume")
    assert "is of another fit: scenario was" in other
    # a mistaken option loses nothing either
    assert "--at" in run.rejected(*again, "--resume", "--at", "nonsense")
    assert (folder / "found.toml.checkpoint").exists()


def test_a_fit_without_files_has_no_checkpoint(run, light_file):
    said = run.rejected("fit", light_file("periods"), "--resume")
    assert "--resume needs outputs that are files" in said


def test_a_fit_without_a_solution_leaves_no_checkpoint(run, light_file, tmp_path):
    path = light_file("periods")
    done = run("fit", path, "--set", "fit.starts=2", "--set", "fit.iterations=1",
               "--solution", tmp_path / "none.toml", "--checkpoint", "0")
    assert done.returncode == 1 and "no solution" in done.stderr
    assert not list(tmp_path.glob("none.toml*"))
