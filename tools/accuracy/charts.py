#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures every chart at the full counts and writes docs/accuracy/charts.md.

Runs the tests ChartAccuracy and ChartEdges of the property binary (a few minutes, of which the
1000-digit oracle of the edges takes nearly all), and makes the tables from what they record."""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/accuracy/charts.md"

# Set of the test -> what it is called.
SETS = {
    "rate": "quaternion and angular velocity",
    "matrix": "rotation matrix",
    "euler_rates": "Euler angles and rates",
    "euler": "Euler angles and momenta",
    "andoyer": "Andoyer",
    "poincare": "Poincare-type, nearest poles",
    "serret": "Serret",
    "sadov": "Sadov",
    "tumbler": "tumbler",
}
# Region of the test -> what the distance is.
REGIONS = {
    "theta": "theta from 0 or pi",
    "J": "J from 0 or pi",
    "I": "I from 0 or pi",
    "short_spin": "g from the short axis",
    "long_spin": "g from the long axis",
    "separatrix": "abs(G^2 - 2TI2)/G^2",
}
# What ChartEdges looks at -> what it is called.
EDGES = {
    "euler_rates": "Euler angles and rates",
    "euler": "Euler angles and momenta",
    "andoyer": "Andoyer",
    "modified_andoyer": "modified Andoyer",
    "poincare": "Poincare-type, nearest poles",
    "serret": "Serret",
    "serret_values": "Serret, the numbers themselves",
    "sadov": "Sadov",
    "sadov_values": "Sadov, the numbers themselves",
    "tumbler": "tumbler, with its numbers",
    "jacobian_euler": "Jacobian of Euler's set",
    "jacobian_andoyer": "Jacobian of Andoyer's set",
    "jacobian_poincare": "Jacobian of the Poincare-type sets",
    "jacobian_sadov": "Jacobian of Sadov's set",
}
EDGE_LINE = re.compile(r"(\d+) tried, (\d+) failed .*, (\d+) refused, (\d+) left out, (\d+) held: "
                       r"median (\S+), worst \S+")
DISTANCES = ("1.0e-02", "1.0e-04", "1.0e-06", "1.0e-08", "1.0e-10", "1.0e-12")

HEAD = """\
# Accuracy of the charts

This page is written by `tools/accuracy/charts.py`, which runs `tests/property/chart_accuracy.cpp`
at its full counts; `make test` runs a seeded sample. What to do about a loss is said in
[singularities](../guide/singularities.md).

**Loss**: a state of |g| = 1 goes from the hub into a set and back; the loss is the rotation angle
between the two attitudes (rad) or |change of g|, whichever is larger. Each set is only as good as
what its six doubles can hold, so most of a loss near a singularity is the rounding of the set's own
numbers, not of the formulas.

**Defect**: the largest entry of |B Jc B^T - Pi|, each in units of eps = 2.2e-16 times the same
product of absolute values. 1 is one rounding of B. For Euler, Andoyer and the Poincare-type sets B
is taken at the hub state, for Serret and Sadov at their own numbers.

Bodies are random, triaxial (no two moments within 5 %), with axes in any order. Serret and Sadov
are taken at time 0, tumblers where |psi| is at most 0.9 psi_max.

## Generic states

| set | states | loss, median | loss, max | defect, max |
|---|---|---|---|---|
"""

LOSS_HEAD = """
## Loss near the singularities

The largest of {count} states at one to two times the distance at the head of the column.

| set | distance | 1e-2 | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12 |
|---|---|---|---|---|---|---|---|
"""

LOSS_NOTE = """
Where the loss stops growing, or falls again, the number that held J or I has reached its limit
(L = G, say): the state is then taken to lie at the pole, which is as wrong as J is large. At 1e-12
from the separatrix many pairs of tumbler periods are refused: no momentum in double precision has
them.
"""

DEFECT_HEAD = """
## Defect near the singularities

| set | distance | 1e-2 | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12 |
|---|---|---|---|---|---|---|---|
"""

EDGE_HEAD = """
## At the edges

States that `tests/property/chart_edges.cpp` draws: momenta and moments from 1e-300 to 1e300,
distances down to 1e-300 from each axis, from the poles and from the separatrix, needles, plates and
symmetric bodies. A state is held when its loss is within the bounds that the header of the set
gives there (next to a pole up to half the digits). The numbers of Serret's and Sadov's sets and the
periods of tumblers are held when they are those of an oracle of 1000 digits. A refusal counts as
right only where the header announces it: where a rate, a period or a number of the set has no
double, or where doubles do not tell its distance from the separatrix. Where a loss is beyond the
plain bound, half an ulp of each of the six numbers, carried through the oracle, is what the state
may lose, twice; where they lose the place on the polhode, the momentum in space is compared. Left
out are cases with nothing to compare, such as the period of a body at rest or a rate below 1e-308,
and those whose bound says nothing. Jacobians are compared with those of the same state in units in
which it is of order one: 0 is bit for bit.

| set | tried | failed | held | refused | left out | loss or error, median |
|---|---|---|---|---|---|---|
"""

DEFECT_NOTE = """
"-": the own numbers of the set are at the pole, where B has infinite or dependent columns. The
other sets are not canonical. Every loss and defect is tested against a budget of
`tests/budgets.hpp`.
"""


def measured(binary):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        run = subprocess.run(
            [binary, "--gtest_filter=*ChartAccuracy*:ChartEdges.*",
             f"--gtest_output=json:{report}"],
            env={**os.environ, "POLHODE_TEST_FULL": "1"}, text=True, stdout=subprocess.PIPE)
        if run.returncode != 0:
            sys.stderr.write(run.stdout)
        suites = json.loads(report.read_text())["testsuites"]
    tests = [test for suite in suites for test in suite["testsuite"]]
    return {test["name"].split("/")[-1]: test for test in tests}, run.returncode


def number(text):
    """1.8e-10 as it is, 9.9e-01 as 0.99."""
    return text if text is None or float(text) < 0.1 else f"{float(text):.2g}"


def table(results, what):
    rows = ""
    for name, title in SETS.items():
        for region, distance in REGIONS.items():
            cells = [number(results[name].get(f"{region}{d}_{what}")) for d in DISTANCES]
            if any(cells):
                rows += f"| {title} | {distance} | {' | '.join(c or '-' for c in cells)} |\n"
    return rows


def edges(results):
    recorded = {k: v for test in results.values() for k, v in test.items()
                if k.startswith("edges_")}
    assert set(recorded) == {f"edges_{name}" for name in EDGES}, sorted(recorded)
    rows = ""
    for name, title in EDGES.items():
        tried, failed, refused, left, held, median = EDGE_LINE.match(
            recorded[f"edges_{name}"]).groups()
        cells = [title, tried, failed, held, refused, left, f"{float(median):.2g}"]
        rows += f"| {' | '.join(cells)} |\n"
    return rows


def page(results):
    text = HEAD
    for name, title in SETS.items():
        r = results[name]
        defect = number(r.get("generic_defect")) or ""
        text += (f"| {title} | {r['generic_count']} | {r['generic_median']} | {r['generic_max']} "
                 f"| {defect} |\n")
    counts = {v for r in results.values() for k, v in r.items() if k.endswith("12_count")}
    assert len(counts) == 1
    text += LOSS_HEAD.format(count=counts.pop()) + table(results, "max") + LOSS_NOTE
    text += DEFECT_HEAD + table(results, "defect") + DEFECT_NOTE
    return text + EDGE_HEAD + edges(results)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--binary", default=str(ROOT / "build/release/tests/property"))
    results, status = measured(parser.parse_args().binary)
    PAGE.write_text(page(results))
    return status


if __name__ == "__main__":
    sys.exit(main())
