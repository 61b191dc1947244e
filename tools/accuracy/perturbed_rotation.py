#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures W1 with every method and writes docs/accuracy/perturbed-rotation.md.

Runs bench_perturbed_rotation, and tools/accuracy/heyoka_w1.py where a Python with heyoka is named
(--heyoka-python)."""

import argparse
import json
import os
import pathlib
import platform
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/accuracy/perturbed-rotation.md"

HEAD = """\
# Accuracy and cost of perturbed rotation

This page is written by `tools/accuracy/perturbed_rotation.py`, which runs
`bench_perturbed_rotation`.

W1: a body of moments 0.9, 1, 1.1 tumbles under the gravity gradient of a point mass on a Kepler
orbit (gm = a = 1, e = 0.1) for a thousand orbits, 62 000 rad of rotation. It starts at pericentre
with its axes along the inertial ones and omega = (5, 4, 7.5). The error is the angle between the
final attitude and that of Taylor integrations of orders above 20 in 80-bit arithmetic (heyoka, at
two tolerances that agree to 6e-14 rad) from the same doubles: the momentum 1.1 * 7.5 is rounded,
which alone turns the end by 1e-11 rad.

Boost.Odeint and heyoka integrate eleven numbers (q, omega, position and velocity of the orbit):
their torque is written into the equations; polhode's is any term of a list, and asks the orbit for
a position at any time. CPU seconds are those of one run of one thread.
"""

FLOOR = """
## What rounding leaves

Eight fixed steps of `Adaptive`, h = {first} to {last}, where the error of the method is below
rounding: the median error is {median} rad, the largest {largest}. Three things make it so: sums
that carry what a double loses, a time of two doubles that reaches the orbit, and coefficients
settled so that the conditions of order one and two hold beyond rounding. Without the second, a
rounding of t (5e-13 at the end) in the place of the orbit ends a run of small steps at 3e-10 to
3e-8 rad; without the third, at 1e-10.
"""


def measured(bench):
    output = subprocess.run([bench, "--benchmark_format=json"], check=True, capture_output=True,
                            text=True).stdout
    rows = json.loads(output)["benchmarks"]
    return [row | {"name": row["name"].removeprefix("W1/").removesuffix("/iterations:1")}
            for row in rows if "error" in row]


def heyoka_rows(python):
    if not python:
        return []
    script = ROOT / "tools/accuracy/heyoka_w1.py"
    return json.loads(subprocess.run([python, script], check=True, capture_output=True,
                                     text=True).stdout)


def table(rows):
    lines = ["| method | tolerance or step | CPU (s) | error (rad) | steps | evaluations |",
             "|---|---|---|---|---|---|"]
    for row in rows:
        method, value = row["name"].rsplit("/", 1)
        evaluations = f"{row['evaluations']:.0f}" if row.get("evaluations") else ""
        lines.append(f"| {method} | {value} | {row['cpu_time']:.3f} | {row['error']:.1e} | "
                     f"{row['steps']:.0f} | {evaluations} |")
    return "\n".join(lines) + "\n"


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bench",
                        default=ROOT / "build/release/benchmarks/bench_perturbed_rotation")
    parser.add_argument("--heyoka-python", default=os.environ.get("HEYOKA_PYTHON"))
    parser.add_argument("--page", type=pathlib.Path, default=PAGE)
    arguments = parser.parse_args()
    rows = measured(arguments.bench) + heyoka_rows(arguments.heyoka_python)
    floor = [row for row in rows if row["name"].startswith("Adaptive fixed step/")]
    errors = [row["error"] for row in floor]
    steps = [row["name"].rsplit("/", 1)[1] for row in floor]
    text = HEAD + f"\nMeasured on one core of: {processor()}.\n\n"
    text += table([row for row in rows if row not in floor])
    text += FLOOR.format(first=steps[0], last=steps[-1], median=f"{statistics.median(errors):.1e}",
                         largest=f"{max(errors):.1e}")
    penumbras = (pathlib.Path(__file__).parent / "penumbras.md").read_text(encoding="ascii")
    arguments.page.write_text(text + "\n" + table(floor) + "\n" + penumbras, encoding="ascii")


if __name__ == "__main__":
    main()
