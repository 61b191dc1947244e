# SPDX-License-Identifier: MIT
"""Runs of scenarios that were stopped go on."""

import signal
import threading

import h5py
import numpy as np
import polhode
import pytest
from polhode import Scenario

TEXT = """schema = 1
[body]
moments = [1, 2, 2.5]
[state.attitude-rate]
quaternion = [1, 0, 0, 0]
omega_body = [0.1, 0.2, 1]
[[perturbation]]
kind = "damping"
coefficients = [1e-9, 1e-9, 1e-9]
[[event]]
column = "qw"
[time]
stop = STOP
step = 0.1
[output]
columns = ["q", "omega"]
"""


class Stop(Exception):
    """What a listener raises."""


def scenario(stop):
    return Scenario.from_text(TEXT.replace("STOP", str(stop)))


def stop_soon(call):
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        call()
    timer.join()


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_ctrl_c_leaves_a_run_to_continue(tmp_path, extension):
    path = tmp_path / f"a.{extension}"
    s = scenario(1e7)
    stop_soon(lambda: s.run(path, events=tmp_path / "e.csv", keep=False))
    assert (tmp_path / f"a.{extension}.checkpoint").exists()
    with pytest.raises(ValueError, match="unfinished run .* resume continues it, restart"):
        s.run(path, events=tmp_path / "e.csv")
    with pytest.raises(ValueError, match="outputs was"):
        s.run(path, resume=True)
    with pytest.raises(ValueError, match="expected one of them"):
        s.run(path, resume=True, restart=True)
    stop_soon(lambda: s.run(path, events=tmp_path / "e.csv", keep=False, resume=True))
    # the rows of both parts are those of a shorter straight run
    with pytest.raises(ValueError, match="scenario was"):
        scenario(1e6).run(path, events=tmp_path / "e.csv", resume=True)
    name = path.with_name(path.name + ".part")
    if extension == "h5":
        with h5py.File(name) as file:
            rows = np.column_stack([file["t"], file["q"], file["omega"]])
    else:
        with name.open() as file:
            lines = [line for line in file if not line.startswith("#")][1:]
        rows = np.array([[float(x) for x in line.split(",")] for line in lines])
    assert len(rows) > 1024
    # the last steps of a run are cut to its end: one that ends later has the same bits until then
    results = scenario(float(rows[-1, 0]) + 500).run()
    table = np.column_stack([results[name] for name in results])
    assert np.array_equal(rows, table[: len(rows)])


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_results_of_a_continued_run_have_all_rows(tmp_path, extension):
    path = tmp_path / f"a.{extension}"
    s = scenario(2000)
    straight = s.run()
    calls = []

    def interrupt(t):
        calls.append(t)
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        s.run(path, progress=interrupt)
    assert 0 < calls[0] < 2000
    results = s.run(path, resume=True)
    assert results == straight and results.outcome.ok
    assert results.statistics.steps == straight.statistics.steps
    assert results.energy_change == straight.energy_change
    assert [e.t for e in results.events] == [e.t for e in straight.events]
    # nothing is left to do: the same rows again
    again = s.run(path, resume=True)
    assert np.array_equal(again["qw"], straight["qw"]) and len(again.t) == len(straight.t)
    assert not list(tmp_path.glob("*.checkpoint"))


def test_what_progress_raises_passes_through(tmp_path):
    def stop(t):
        raise Stop(t)

    with pytest.raises(Stop):
        scenario(1e7).run(tmp_path / "a.csv", keep=False, progress=stop)
    with pytest.raises(TypeError, match="progress: expected a function"):
        scenario(1).run(progress=3)


def test_rows_so_far_must_be_readable():
    with pytest.raises(ValueError, match="files"):
        polhode.Scenario.from_text(TEXT.replace("STOP", "1")).run(resume=True)
