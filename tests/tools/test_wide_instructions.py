# SPDX-License-Identifier: MIT
"""Code for AVX-512 cannot stand in for code for all processors."""

import os
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools/wide_instructions.py"
BUILT = pathlib.Path(os.environ.get("POLHODE_BUILD", ROOT / "build/release"))

sys.path.insert(0, str(TOOL.parent))
import wide_instructions  # noqa: E402


def test_the_build_keeps_them_apart():
    if not list(BUILT.glob("src/CMakeFiles/polhode_*_baseline.dir")):
        pytest.skip("no objects in this build")
    run = subprocess.run([sys.executable, TOOL, BUILT], capture_output=True, text=True)
    assert run.returncode == 0, run.stdout


def test_what_others_could_take_is_found():
    listing = """\
0000000000000000 W polhode::v0::f(polhode::v0::Pack<(polhode::v0::InstructionSet)2>)
0000000000000010 W std::clamp(double const&, double const&)
0000000000000020 T polhode::v0::g(polhode::v0::Pack<(polhode::v0::InstructionSet)1>)
0000000000000030 t polhode::v0::local(double)
"""
    assert list(wide_instructions.shared(listing, "avx512")) == [
        "std::clamp(double const&, double const&)",
        "polhode::v0::g(polhode::v0::Pack<(polhode::v0::InstructionSet)1>)",
    ]


def test_a_build_without_such_code_is_refused(tmp_path):
    run = subprocess.run([sys.executable, TOOL, tmp_path], capture_output=True, text=True)
    assert run.returncode == 1 and "holds no object of src/*/lanes for avx512" in run.stdout
