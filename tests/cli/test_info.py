# SPDX-License-Identifier: MIT
"""What `polhode info` says without a scenario, and of what a scenario leaves to defaults."""

import pytest


def test_it_says_what_it_uses_of_the_processor(run):
    lines = run("info", "--cpu").stdout.splitlines()
    sets = lines[0].removeprefix("instruction sets: ").split()
    assert sets[0] == "baseline" and set(sets) <= {"baseline", "AVX2", "AVX-512"}
    assert lines[1] == f"used for many states at a time: {sets[-1]}"
    assert lines[2] in ("processes: those that mpirun starts, by MPI",
                        "processes: this one alone; built without POLHODE_MPI")
    assert len(lines) == 3


def test_the_processor_is_not_asked_together_with_a_scenario(run):
    result = run("info", "--cpu", "examples/apophis.toml", check=False)
    assert result.returncode != 0 and "--cpu" in result.stderr


def test_a_scenario_is_missed_where_nothing_else_is_asked_for(run):
    result = run("info", check=False)
    assert result.returncode != 0
    assert "FILE" in result.stderr


@pytest.mark.parametrize(("example", "table", "defaults"), [
    ("tumbling-night", "observation[0]",
     'brightness = "flux", calibrated = false, format = "columns", '),
    ("tumbling-night", "fit", "iterations = 200, "),
    ("mars-obliquity", "planet", "J = 0, tidal_drift = 0"),
    ("earth-nutation", "nutation", 'least = "1 uas"'),
])
def test_it_shows_the_defaults_of_every_kind(run, root, example, table, defaults):
    lines = run("info", root / "examples" / f"{example}.toml").stdout.splitlines()
    [line] = [line for line in lines if line.startswith(f"{table}, not in the file ")]
    assert line.split(" file ", 1)[1].strip().startswith(defaults)
