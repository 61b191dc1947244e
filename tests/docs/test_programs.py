# SPDX-License-Identifier: MIT
"""The programs in examples/ print what they say at their end: C++ compiled against the build,
Python with the package of the build."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from test_blocks import compile_command, difference

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
PROGRAMS = sorted([*EXAMPLES.glob("*.cpp"), *EXAMPLES.glob("*.py")])


def printed(program, folder, build):
    environment = dict(os.environ, PYTHONPATH=str(build / "python"))
    command = [sys.executable, program]
    if program.suffix == ".cpp":
        command = [folder / "program"]
        subprocess.run(compile_command(build, program, *command), check=True)
    return subprocess.run(command, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE,
                          check=True).stdout


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda p: p.name)
def test_an_example_prints_what_it_says(program, tmp_path, build):
    mark = "//" if program.suffix == ".cpp" else "#"
    text = program.read_text(encoding="utf-8")
    lines = text.split(f"{mark} Prints:\n")[1].splitlines()
    expected = "\n".join(line.removeprefix(mark) for line in lines)
    assert difference(printed(program, tmp_path, build), expected) is None


def test_there_are_examples_in_both_languages():
    assert {program.suffix for program in PROGRAMS} == {".cpp", ".py"}
