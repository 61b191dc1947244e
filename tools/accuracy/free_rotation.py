#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures FreeRotation at the full counts and writes docs/accuracy/free-rotation.md.

Runs the tests FreeAccuracy.* and FreeTransition.* of the property binary, two at a time (about ten
minutes of two cores), and makes the tables from what they record."""

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import budgets  # noqa: E402

PAGE = ROOT / "docs/accuracy/free-rotation.md"

# Test -> what its cases are, and how long they run.
STATES = {
    "RandomBodies": ("random triaxial bodies, any state", "100"),
    "NearPrincipalAxes": ("momentum within 1e-14 .. 1e-3 of a principal axis", "100"),
    "NearlyEqualMoments": ("two or three moments equal to within 1e-15 .. 1e-3, or exactly", "100"),
    "NearTheSeparatrix": ("2TI2/G^2 - 1 of 1e-16 .. 1e-3, both signs", "100"),
    "OnTheSeparatrix": ("2TI2/G^2 - 1 = 0 exactly", "100"),
    "SmallAngles": ("J and I within 1e-150 .. 1e-3 of 0 and pi", "100"),
    "ExtremeShapesAndUnits": ("needles, discs with I3 = I1 + I2, units of 1e-140 .. 1e140", "100"),
    "AfterAMillionTurns": ("random, 2TI2/G^2 - 1 beyond 1e-3", "1e6"),
    "AfterABillionTurns": ("random, 2TI2/G^2 - 1 beyond 1e-3", "1e9"),
    "EdgeMiddleSpin": ("momentum across the middle axis of 1e-310 .. 1e-8 of G", "500"),
    "EdgeSeparatrixOfFullMoments": ("2TI2/G^2 - 1 of 1e-17 .. 1e-9, every bit of the moments "
                                    "used", "100"),
    "EdgeSeparatrixAfterABillionTurns": ("the same, 1e-15", "1e9"),
    "EdgeMomenta": ("momenta of 1e-160 and 1e300, moments of order one", "100"),
}
MATRICES = {
    "RandomBodies": "random triaxial bodies, any state",
    "NearPrincipalAxes": "momentum within 1e-14 .. 1e-3 of a principal axis",
    "NearlyEqualMoments": "two or three moments nearly or exactly equal",
    "NearTheSeparatrix": "2TI2/G^2 - 1 of 1e-16 .. 1e-3, both signs",
    "OnTheSeparatrix": "2TI2/G^2 - 1 = 0 exactly",
    "FromFlipToFlip": "next to the middle axis, up to three flips",
    "Degenerate": "J = 0, spins about each axis, separatrix, I1 = I2, I2 = I3, sphere, rest",
}

HEAD = """\
# Accuracy of free rotation

This page is written by `tools/accuracy/free_rotation.py`, which runs the tests `FreeAccuracy.*` and
`FreeTransition.*` (tests/property) at their full counts; `make test` runs a seeded sample of each.

Every state of `FreeRotation` is compared with a Taylor integration of Euler's equations and of the
attitude at 76 digits, steps good to 1e-66 (tests/oracle/free_body.hpp). It shares no formula with
the library: no elliptic function, no theta series. Half a polhode period is integrated; the rest
follows from symmetry, so that 1e9 turns cost no more than one. The numbers of the input (moments,
q/|q|, g, t - t0) are taken exactly as the doubles given. The oracle itself is held against the
integration of the quaternion, the axisymmetric solution, typed digits of mpmath, invariants and
other orders (tests/unit/oracle): its own ways agree to 1e-56.

Moments come in any order of the axes. A turn is 2 pi / |omega| at the start; times are uniform
between minus and plus the number of turns (all of it in the rows of 1e6 and 1e9). The angle is that
of the rotation between the two attitudes.
"""

STATE_HEAD = """
## States

| cases | up to turns | count | angle, median (rad) | angle, max (rad) | \
error of g / G, median | error of g / G, max |
|---|---|---|---|---|---|---|
"""

STATE_NOTE = """
Every angle and every error of g / G is tested to be at most {free_state:g}, and every median
at most {free_state_median:g} (tests/budgets.hpp). After a long time, or near the separatrix, a
change of the input in its last digit moves the state much more than that: the table says how well
the state is computed for the numbers given, not how well those numbers are known.
"""

MATRIX_HEAD = """
## State transition matrices

Up to ten turns either way, against 76-digit variational equations
(tests/oracle/free_transition.hpp). The error is the largest over the four 3x3 blocks of
|block - exact| / |exact|, and is tested to be at most {free_transition:g}.

| cases | count | median | max |
|---|---|---|---|
"""


def measured(binary, test):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        run = subprocess.run(
            [binary, f"--gtest_filter={test}", f"--gtest_output=json:{report}"],
            env={**os.environ, "POLHODE_TEST_FULL": "1"}, text=True, stdout=subprocess.PIPE)
        if run.returncode != 0:
            sys.stderr.write(run.stdout)
        found = json.loads(report.read_text())["testsuites"][0]["testsuite"][0]
    print(test, found["time"], "ok" if run.returncode == 0 else "FAILED", flush=True)
    return found, run.returncode == 0


def page(results):
    text = HEAD + STATE_HEAD
    for name, (what, turns) in STATES.items():
        r = results[f"FreeAccuracy.{name}"]
        text += (f"| {what} | {turns} | {r['cases']} | {r['angle_median']} | {r['angle_max']} "
                 f"| {r['momentum_median']} | {r['momentum_max']} |\n")
    names = ("free_state", "free_state_median", "free_transition")
    limits = {name: getattr(budgets, name) for name in names}
    text += STATE_NOTE.format(**limits) + MATRIX_HEAD.format(**limits)
    for name, what in MATRICES.items():
        r = results[f"FreeTransition.{name}"]
        text += f"| {what} | {r['cases']} | {r['transition_median']} | {r['transition_max']} |\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--binary", default=str(ROOT / "build/release/tests/property"))
    binary = parser.parse_args().binary
    tests = [f"FreeAccuracy.{n}" for n in STATES] + [f"FreeTransition.{n}" for n in MATRICES]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = dict(zip(tests, pool.map(lambda test: measured(binary, test), tests)))
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page({test: found for test, (found, _) in runs.items()}))
    return 0 if all(passed for _, passed in runs.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
