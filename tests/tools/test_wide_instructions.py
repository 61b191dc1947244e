# SPDX-License-Identifier: MIT
"""Code for AVX-512 cannot stand in for code for all processors."""

import os
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools/wide_instructions.py"
BUILT = pathlib.Path(os.environ.get("POLHODE_BUILD", ROOT / "build/release")) / "src"
LIBRARIES = [BUILT / "libpolhode.a", BUILT / "libpolhode_ensemble.a"]

sys.path.insert(0, str(TOOL.parent))
import wide_instructions  # noqa: E402


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda library: library.stem)
def test_the_library_keeps_them_apart(library):
    if not library.exists():
        pytest.skip("no static library in this build")
    run = subprocess.run([sys.executable, TOOL, library], capture_output=True, text=True)
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


def test_a_library_without_such_code_is_refused(tmp_path):
    library = tmp_path / "lib.a"
    subprocess.run(["ar", "rc", library], check=True)
    run = subprocess.run([sys.executable, TOOL, library], capture_output=True, text=True)
    assert run.returncode == 1 and "holds no object of src/*/lanes" in run.stdout
