# SPDX-License-Identifier: MIT
"""How the tests of the command line run it."""

import os
import subprocess

import pytest
from ensemble_files import VARY
from fit_files import FREE_LIGHT, HEAD, NIGHT, TUMBLER
from slowdown import SLOWDOWN

# With what tools/sanitized asks of the sanitizers.
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name == "PATH" or name.endswith("SAN_OPTIONS")}
ENVIRONMENT["LANG"] = "C.UTF-8"
SECONDS = 120 * SLOWDOWN


class CommandLine:
    """run("info", path, stdin="...") -> CompletedProcess with text, whatever its exit code."""

    def __init__(self, program):
        self.program = program

    def __call__(self, *arguments, stdin="", **options):
        return subprocess.run([self.program, *map(str, arguments)], input=stdin, text=True,
                              capture_output=True, timeout=SECONDS, env=ENVIRONMENT, **options)

    def ok(self, *arguments, **options):
        """The same of a command that succeeds."""
        done = self(*arguments, **options)
        assert done.returncode == 0, done.stderr
        return done

    def rejected(self, *arguments, **options):
        """What a command that is rejected says."""
        done = self(*arguments, **options)
        assert done.returncode == 2, done.stderr
        return done.stderr


@pytest.fixture(scope="session")
def run(polhode):
    return CommandLine(polhode)


@pytest.fixture
def elsewhere(polhode, run, tmp_path):
    """elsewhere("map", ...) -> CompletedProcess of a machine whose sines have other last digits:
    the C library of a processor without fused multiplication stands for it."""
    environment = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}

    def call(*arguments):
        return subprocess.run([polhode, *map(str, arguments)], capture_output=True, text=True,
                              timeout=SECONDS, env=environment)

    here, there = tmp_path / "here.csv", tmp_path / "there.csv"
    words = ["ensemble", "examples/apophis-ensemble.toml", "--set", "ensemble.size=500", "--set",
             "ensemble.chunk=100", "--out"]
    run.ok(*words, here)
    assert call(*words, there).returncode == 0
    if here.read_bytes() == there.read_bytes():
        pytest.skip("the sines of this machine have no other last digits")
    return call


@pytest.fixture
def scenario(tmp_path):
    """scenario("...", time="...") writes a scenario of a short-axis body and returns its path."""

    def write(body="moments = [1, 2, 2.5]", time="stop = 10\nstep = 0.5",
              columns='"q", "omega", "g"', name="body.toml",
              state="[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0.1, 0.2, 1]"):
        path = tmp_path / name
        path.write_text(f"schema = 1\ntitle = \"A body\"\n[body]\n{body}\n{state}\n"
                        f"[time]\n{time}\n[output]\ncolumns = [{columns}]\n", encoding="utf-8")
        return path

    return write


@pytest.fixture
def ensemble(scenario):
    """ensemble("size = 10", ...) writes a scenario with [ensemble] and returns its path."""

    def write(head, vary=VARY, extra="", **parts):
        path = scenario(**parts)
        path.write_text(path.read_text() + f"{extra}\n[ensemble]\n{head}\n{vary}")
        return path

    return write


@pytest.fixture(scope="session")
def table():
    """table(csv text) -> (names, rows of floats)"""

    def parse(text):
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        return lines[0].split(","), [[float(x) for x in line.split(",")] for line in lines[1:]]

    return parse


@pytest.fixture
def fit_file(tmp_path):
    """fit_file("...") writes a scenario of kind "fit" and returns its path."""

    def write(*parts, head=HEAD, name="fit.toml"):
        path = tmp_path / name
        path.write_text(head + "".join(parts), encoding="utf-8")
        return path

    return write


@pytest.fixture
def night(run, fit_file, tmp_path):
    """The file of a night whose light curve is there."""
    path = fit_file(NIGHT, FREE_LIGHT, head=TUMBLER)
    run.ok("simulate", path, "--into", tmp_path)
    return path
