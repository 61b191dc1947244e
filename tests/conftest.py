# SPDX-License-Identifier: MIT
"""What the Python tests share: where the checkout, its build and its command line are."""

import os
import pathlib
import signal

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]

# A shell that starts the tests in the background has them ignore SIGINT, and every program that
# they start would inherit that: none could be interrupted.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def root() -> pathlib.Path:
    return ROOT


@pytest.fixture(scope="session")
def build() -> pathlib.Path:
    """The build tree under test: build/release, or POLHODE_BUILD."""
    path = ROOT / os.environ.get("POLHODE_BUILD", "build/release")
    assert (path / "CMakeCache.txt").exists(), f"{path} is not built: make build"
    return path


@pytest.fixture(scope="session")
def polhode(build) -> pathlib.Path:
    """The command line under test."""
    path = build / "polhode"
    assert path.exists(), f"{path} is missing: make build"
    return path


@pytest.fixture(scope="session")
def full() -> bool:
    """True in `make test-full`: run the whole sweep, not the sample."""
    return os.environ.get("POLHODE_TEST_FULL") == "1"
