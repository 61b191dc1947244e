# SPDX-License-Identifier: MIT
"""The programs in examples/ compile against the build and print what they say at their end."""

import subprocess
from pathlib import Path

import pytest
from test_blocks import compile_command, difference

PROGRAMS = sorted((Path(__file__).resolve().parents[2] / "examples").glob("*.cpp"))


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda p: p.name)
def test_an_example_prints_what_it_says(program, tmp_path, build):
    text = program.read_text(encoding="utf-8")
    expected = [line.removeprefix("//") for line in text.split("// Prints:\n")[1].splitlines()]
    subprocess.run(compile_command(build, program, tmp_path / "program"), check=True)
    done = subprocess.run([tmp_path / "program"], text=True, stdout=subprocess.PIPE, check=True)
    assert difference(done.stdout, "\n".join(expected)) is None


def test_there_are_examples():
    assert PROGRAMS
