# SPDX-License-Identifier: MIT
"""Test programs: their tests, each run alone without a mutant for its time and for the mutants that
it reaches; and runs of some tests with a mutant."""

import dataclasses
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time

from . import results

LIMITS = ["prlimit", "--as=8589934592", "--core=0"]


@dataclasses.dataclass(frozen=True)
class Test:
    program: str  # unit_free
    name: str  # Suite.Case
    seconds: float
    reached: tuple  # numbers of mutants
    left_out: float = 0.0  # s: the limit that it exceeded


def names_of(program):
    """What gtest lists: suites, and their tests indented."""
    listed = subprocess.run([program, "--gtest_list_tests"], text=True, check=True,
                            stdout=subprocess.PIPE).stdout
    names, suite = [], ""
    for line in listed.splitlines():
        word = line.split("#")[0].strip()
        if line.startswith("  "):
            names.append(suite + word)
        elif word.endswith("."):
            suite = word
    return [n for n in names if "DISABLED_" not in n]


def environment(**more):
    kept = {k: v for k, v in os.environ.items()
            if not k.startswith(("GTEST_", "POLHODE_"))}
    return {**kept, **{k: str(v) for k, v in more.items()}}


def alone(task):
    """One test without a mutant."""
    folder, program, name, slowest = task
    with tempfile.TemporaryDirectory() as scratch:
        reached = pathlib.Path(scratch) / "reached"
        start = time.monotonic()
        try:
            run = subprocess.run([folder / program, f"--gtest_filter={name}"], cwd=scratch,
                                 env=environment(POLHODE_REACHED=reached), text=True,
                                 timeout=slowest, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired:
            return Test(program, name, slowest, (), slowest)
        seconds = time.monotonic() - start
        if run.returncode != 0:
            raise RuntimeError(f"mutate: {program} {name} fails without a mutant:\n"
                               + run.stdout[-2000:])
        return Test(program, name, seconds, tuple(int(n) for n in reached.read_text().split()))


def recorded(folder, programs, cache, jobs, slowest=None):
    """Every test of the programs, those that take longer than `slowest` seconds left out. What is
    known of a program is kept until it is built anew."""
    built = {p: (folder / p).stat().st_mtime_ns for p in programs}
    known = {}
    for r in results.read(cache):
        if built.get(r["program"]) == r["built"] and r["left_out"] in (0.0, slowest):
            known[r["program"], r["name"]] = Test(
                r["program"], r["name"], r["seconds"], tuple(r["reached"]), r["left_out"])
    tasks = [(folder, p, name, slowest) for p in programs for name in names_of(folder / p)
             if (p, name) not in known]

    def one(task):
        test = alone(task)
        results.append(cache, {**dataclasses.asdict(test), "built": built[test.program]})
        return test

    return [*known.values(), *results.each(one, tasks, jobs)]


def with_mutant(folder, number, tests, most):
    """None if the tests of one program pass within `most` seconds, or else who caught it and
    how."""
    with tempfile.TemporaryDirectory() as scratch:
        flags = pathlib.Path(scratch) / "flags"
        flags.write_text("--gtest_filter=" + ":".join(t.name for t in tests) + "\n")
        command = [*LIMITS, folder / tests[0].program, f"--gtest_flagfile={flags}"]
        env = environment(POLHODE_MUTANT=number, GTEST_BREAK_ON_FAILURE=1, GTEST_FAIL_FAST=1)
        with open(flags.with_name("out"), "w+b") as out:
            try:
                code = subprocess.run(command, cwd=scratch, env=env, stdout=out,
                                      stderr=subprocess.STDOUT, timeout=most).returncode
            except subprocess.TimeoutExpired:
                code = None
            if code == 0:
                return None
            out.seek(0)
            begun = re.findall(rb"^\[ RUN      \] (\S+)", out.read(), flags=re.M)
    test = begun[-1].decode() if begun else tests[0].name
    how = "timeout" if code is None else "failure" if code in (1, -signal.SIGTRAP) else "crash"
    return {"by": f"{tests[0].program} {test}", "how": how}
