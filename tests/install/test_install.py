# SPDX-License-Identifier: MIT
"""An installed polhode is found by find_package, links, runs, and says its headers' version."""

import re
from pathlib import Path

import budgets
import pytest
from shell import sh

CONSUMER = Path(__file__).resolve().parent / "consumer"


@pytest.fixture(scope="module")
def consumer(prefix, tmp_path_factory):
    """The consumer project, built with nothing of our settings: a plain CMake project."""
    path = tmp_path_factory.mktemp("consumer")
    sh("cmake", "-S", CONSUMER, "-B", path, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}")
    sh("cmake", "--build", path)
    return path


def version(root):
    text = (root / "include/polhode/version.hpp").read_text()
    return ".".join(re.findall(r"#define POLHODE_VERSION_\w+ (\d+)", text))


def test_core_consumer_runs(consumer, root):
    printed_version, energy = sh(consumer / "core").split()
    assert printed_version == version(root)
    assert float(energy) == 6.5  # (1 + 4/2 + 25/2.5) / 2


def test_io_consumer_runs(consumer):
    label, rate, cells = sh(consumer / "io").split()
    assert label == "deg/h" and cells == "3"
    assert float(rate) == pytest.approx(27.38, rel=budgets.cli_rounding)


def test_mpi_consumer_runs(consumer):
    assert sh(consumer / "mpi") == "one process\n"


def test_installed_command_line_says_its_version(prefix, root):
    assert version(root) in sh(prefix / "bin/polhode", "--version")


def test_nothing_private_is_installed(prefix, root):
    installed = {p.relative_to(prefix).as_posix() for p in prefix.rglob("*") if p.is_file()}
    headers = {name for name in installed if name.endswith(".hpp")}
    assert headers == {p.relative_to(root).as_posix() for p in root.glob("include/**/*.hpp")}
    assert not [name for name in installed if re.search(r"Eigen|gtest|CLI11", name)]


def test_flags_that_values_depend_on_reach_the_consumer(consumer):
    commands = sh("cmake", "--build", consumer, "--", "-t", "commands")
    assert all("-ffp-contract=off" in line for line in commands.splitlines() if " -c " in line)
    assert "-Werror" not in commands
