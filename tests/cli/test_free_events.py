# SPDX-License-Identifier: MIT
"""Events of a free body: found on the closed form, after any number of turns; rows stay what they
are without events."""

import math

import budgets
import pytest

WING_NUT = "moments = [30.53, 83.87, 113.3]"
SPINNING = "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0.01, 6.28, 0]"
FLIP = '[[event]]\nname = "flip"\ncolumn = "w2"\n'
FRAMES = {"inertial": "", "precessing": "[frame.precessing]\naxis = [0, 0.6, 0.8]\nrate = 1.3\n"}


@pytest.fixture
def body(scenario):
    """A scenario of a wing nut that flips, with more tables."""

    def write(more="", time="stop = 40\nstep = 0.5", columns='"q", "omega", "serret", "sadov"'):
        path = scenario(body=WING_NUT, state=SPINNING, time=time, columns=columns)
        path.write_text(path.read_text(encoding="utf-8").replace("[output]", more + "[output]"),
                        encoding="utf-8")
        return path

    return write


def lines(text):
    return [line for line in text.splitlines() if not line.startswith("#")]


def found(path):
    names, *rows = lines(path.read_text(encoding="utf-8"))
    return [dict(zip(names.split(","), row.split(","), strict=True)) for row in rows]


@pytest.mark.parametrize("frame", FRAMES)
def test_rows_are_those_of_a_run_without_events(run, body, frame, tmp_path):
    columns = '"q", "omega", "serret", "sadov"' if frame == "inertial" else '"q", "omega", "g"'
    without = run("run", body(FRAMES[frame], columns=columns))
    events = tmp_path / "e.csv"
    out = tmp_path / "a.csv"
    done = run.ok("run", body(FRAMES[frame] + FLIP, columns=columns), "--out", out, "--events",
                  events)
    assert "exact free rotation" in done.stdout and "steps" not in done.stdout
    assert lines(out.read_text(encoding="utf-8")) == lines(without.stdout)
    assert len(found(events)) == 11


def test_flips_after_a_billion_turns(run, body, tmp_path):
    """Half a period of the polhode apart, each to the rounding of the time."""
    events = tmp_path / "e.csv"
    path = body(FLIP, time="start = 1e9\nstop = 1000000370\nstep = 10", columns='"omega"')
    run.ok("run", path, "--out", tmp_path / "a.csv", "--events", events)
    times = [float(event["t"]) for event in found(events)]
    assert len(times) == 100
    half = (times[-1] - times[0]) / 99
    path = body(FLIP, columns='"omega"')
    run.ok("run", path, "--out", tmp_path / "b.csv", "--events", events)
    first = [float(event["t"]) for event in found(events)]
    exact = (first[-1] - first[0]) / (len(first) - 1)
    ulp = math.ulp(1e9)
    allowed = budgets.cli_half_period_ulps * ulp / 99 + budgets.cli_half_period
    assert abs(half - exact) < allowed
    for k, t in enumerate(times):
        assert abs(t - (times[0] + k * exact)) < budgets.cli_flip_ulps * ulp
    for event in found(events):
        assert abs(float(event["w2"])) < budgets.event_residual
        assert int(event["direction"]) in (1, -1)


def test_an_event_may_stop_it(run, body, table, tmp_path):
    path = body(FLIP + "stops = true\n", columns='"omega"')
    result = run.ok("run", path)
    names, rows = table(result.stdout)
    assert [row[0] for row in rows[:-1]] == [0.5 * k for k in range(len(rows) - 1)]
    last = dict(zip(names, rows[-1], strict=True))
    assert 1.5 < last["t"] < 2.0 and abs(last["w2"]) < budgets.event_residual
    report = run("run", path, "--out", tmp_path / "a.csv").stdout
    assert "stopped by an event" in report and "flip, falling, at t" in report


def test_a_zero_at_the_start_and_at_the_stop(run, body, tmp_path):
    """w3 is 0 at t = 0; the run that begins there reports it."""
    events = tmp_path / "e.csv"
    path = body('[[event]]\ncolumn = "w3"\n', time="stop = 1\nstep = 0.5", columns='"omega"')
    run.ok("run", path, "--out", tmp_path / "a.csv", "--events", events)
    assert [float(event["t"]) for event in found(events)] == [0.0]


def test_times_out_of_order_and_bad_intervals_are_refused(run, body):
    result = run("run", body(FLIP, time="at = [0, 5, 3]"))
    assert result.returncode == 2 and result.stderr.count("\n") == 1
    assert "expected times in order, rising or falling, since events are" in result.stderr
    result = run("run", body(FLIP + "interval = 0\n"))
    assert result.returncode == 2 and "event[0].interval: got 0" in result.stderr
    assert "expected a positive time" in result.stderr
