# SPDX-License-Identifier: MIT
"""Runs of scenarios that were stopped go on."""

import signal

import h5py
import numpy as np
import polhode
import pytest
from interrupts import grows, seconds_from_signal
from polhode import Scenario
from rejections import rejected
from scenario_texts import BODY, STATE

TEXT = BODY + STATE + """
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


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_ctrl_c_leaves_a_run_to_continue(tmp_path, extension):
    path = tmp_path / f"a.{extension}"
    s = scenario(1e7)
    part = tmp_path / f"a.{extension}.part"
    seconds_from_signal(lambda: s.run(path, events=tmp_path / "e.csv", keep=False), grows(part))
    assert (tmp_path / f"a.{extension}.checkpoint").exists()
    with pytest.raises(ValueError, match="unfinished run .* resume=True continues it, restart"):
        s.run(path, events=tmp_path / "e.csv")
    rejected(ValueError, "outputs was", s.run, path, resume=True)
    rejected(ValueError, "expected one of them", s.run, path, resume=True, restart=True)
    seconds_from_signal(
        lambda: s.run(path, events=tmp_path / "e.csv", keep=False, resume=True), grows(part))
    # the rows of both parts are those of a shorter straight run
    with pytest.raises(ValueError, match="scenario was"):
        scenario(1e6).run(path, events=tmp_path / "e.csv", resume=True)
    if extension == "h5":
        with h5py.File(part) as file:
            rows = np.column_stack([file["t"], file["q"], file["omega"]])
    else:
        with part.open() as file:
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
    s = scenario(20000)
    straight = s.run()
    calls = []

    def interrupt(t):
        calls.append(t)
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        s.run(path, progress=interrupt)
    assert 0 < calls[0] < 20000
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
    assert (tmp_path / "a.csv.checkpoint").exists()  # the rows so far are kept
    with pytest.raises(TypeError, match="progress: expected a function"):
        scenario(1).run(progress=3)


def test_rows_so_far_must_be_readable():
    with pytest.raises(ValueError, match="files"):
        polhode.Scenario.from_text(TEXT.replace("STOP", "1")).run(resume=True)


# Below scenarios: integrate with a sink, and resume.


class Blocks:
    """A sink, with what else a run gives out."""

    def __init__(self):
        self.t, self.q, self.g, self.events, self.checkpoints, self.kept = [], [], [], [], [], []

    def __call__(self, t, states):
        assert t.shape == states.shape and len(t) <= 1024
        self.t.append(t)
        self.q.append(np.asarray(states.q))
        self.g.append(np.asarray(states.g))

    def keep(self, checkpoint):
        self.checkpoints.append(checkpoint)
        self.kept.append((len(self.t), len(self.events)))

    def table(self):
        return np.column_stack([np.concatenate(x) for x in (self.t, self.q, self.g)])


def problem(method):
    term = polhode.LinearDamping([1e-3, 1e-3, 1e-3])
    event = polhode.Event("half", lambda t, s: float(s.g[0]) - 0.1)
    return polhode.Problem(
        polhode.System(polhode.Body(1, 2, 2.5), polhode.Frame.inertial(), [term]),
        polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1]), 0.0, 300.0, method, events=[event])


@pytest.mark.parametrize("method", [
    polhode.Adaptive(1e-9), polhode.Splitting(0.1), polhode.VariationOfConstants(1e-9)])
def test_resume_goes_on_to_the_same_bits(method):
    p, times = problem(method), np.linspace(0, 300, 6001)
    straight = Blocks()
    whole = polhode.integrate(p, times, sink=straight, events=straight.events.append,
                              keep_checkpoint=straight.keep, checkpoint_seconds=0)
    kept = polhode.integrate(p, times)
    assert len(whole.t) == 0
    assert straight.table()[:, 0].tobytes() == np.asarray(kept.t).tobytes()
    assert [e.t for e in straight.events] == [e.t for e in kept.events] != []
    assert len(straight.checkpoints) > 5
    for k in range(0, len(straight.checkpoints), 1 + len(straight.checkpoints) // 5):
        rest = Blocks()
        now = polhode.types.Checkpoint(straight.checkpoints[k].bytes)
        assert now == straight.checkpoints[k] and 0 < now.t < 300
        end = polhode.resume(p, times, now, rest, events=rest.events.append)
        blocks, events = straight.kept[k]
        before = sum(len(t) for t in straight.t[:blocks])
        assert rest.table().tobytes() == straight.table()[before:].tobytes()
        assert [e.t for e in rest.events] == [e.t for e in straight.events[events:]]
        assert end.statistics.steps == whole.statistics.steps
    with pytest.raises(ValueError, match="method differs"):
        polhode.resume(problem(polhode.Splitting(0.2)), times, now, Blocks())
    rejected(
        ValueError, "damaged|no checkpoint|too early", polhode.types.Checkpoint, now.bytes[:-1]
    )


def test_progress_of_integrate():
    reported = []
    polhode.integrate(problem(polhode.Splitting(0.001)), [300.0], dense=False,
                      progress=reported.append)
    assert reported == sorted(reported) and (not reported or 0 < reported[0] < 300)

    def stop(t):
        raise Stop(t)

    with pytest.raises(Stop):
        polhode.integrate(problem(polhode.Splitting(1e-5)), [300.0], dense=False, progress=stop)
    with pytest.raises(TypeError, match="progress: expected a function"):
        polhode.integrate(problem(polhode.Splitting(1)), [300.0], progress=3)
    with pytest.raises(TypeError, match="go with a sink"):
        polhode.integrate(problem(polhode.Splitting(1)), [300.0], keep_checkpoint=print)
