# SPDX-License-Identifier: MIT
"""tools/bench_compare finds what became slower, and says when it cannot know."""

import json
import subprocess
import sys

import pytest


@pytest.fixture
def compare(root):
    def run(old, new, *more):
        return subprocess.run([sys.executable, root / "tools/bench_compare", old, new, *more],
                              text=True, capture_output=True, check=False)
    return run


def results(folder, name, times, instructions=None, host="here"):
    entries = [{"name": "at/0", "run_type": "iteration", "cpu_time": t, "time_unit": "ns"}
               for t in times]
    for entry in entries:
        if instructions is not None:
            entry["INSTRUCTIONS"] = instructions
    path = folder / name
    path.write_text(json.dumps({"context": {"host_name": host, "num_cpus": 2},
                                "benchmarks": entries}))
    return path


def test_a_slower_time_is_named(compare, tmp_path):
    old = results(tmp_path, "bench_a.json", [100.0, 100.0, 300.0])
    (tmp_path / "new").mkdir()
    new = results(tmp_path / "new", "bench_a.json", [111.0, 112.0, 111.0])
    done = compare(old, new)
    assert done.returncode == 1
    assert "+11.0 % time: bench_a: at/0" in done.stdout
    assert "1 times compared, 1 regressions" in done.stdout
    assert "no counts of instructions" in done.stdout
    assert compare(old, new, "--limit", "12").returncode == 0
    assert compare(new, old).returncode == 0  # faster is no regression


def test_units_are_read(compare, tmp_path):
    old = results(tmp_path, "bench_a.json", [100.0])
    (tmp_path / "new").mkdir()
    new = results(tmp_path / "new", "bench_a.json", [0.1])
    content = json.loads(new.read_text())
    content["benchmarks"][0]["time_unit"] = "us"
    new.write_text(json.dumps(content))
    assert compare(old, new).returncode == 0


def test_more_instructions_are_named_where_the_time_is_the_same(compare, tmp_path):
    (tmp_path / "new").mkdir()
    old = results(tmp_path, "bench_a.json", [100.0], 1000.0)
    new = results(tmp_path / "new", "bench_a.json", [100.0], 1200.0)
    done = compare(old, new)
    assert done.returncode == 1
    assert "+20.0 % instructions: bench_a: at/0" in done.stdout


def test_a_time_that_is_no_number_is_no_pass(compare, tmp_path):
    (tmp_path / "new").mkdir()
    old = results(tmp_path, "bench_a.json", [100.0])
    new = results(tmp_path / "new", "bench_a.json", [float("nan")])
    assert compare(old, new).returncode == 1


@pytest.mark.parametrize("spoil", ["host", "text", "names"])
def test_what_cannot_be_compared_is_said(compare, tmp_path, spoil):
    (tmp_path / "new").mkdir()
    old = results(tmp_path, "bench_a.json", [100.0])
    new = results(tmp_path / "new", "bench_b.json" if spoil == "names" else "bench_a.json",
                  [100.0], host="there" if spoil == "host" else "here")
    if spoil == "text":
        new.write_text("{")
    done = compare(old, new)
    assert done.returncode == 2
    assert done.stderr.startswith("bench_compare: ")
