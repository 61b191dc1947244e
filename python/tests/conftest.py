# SPDX-License-Identifier: MIT
"""What the tests of the package share: they can be interrupted, and leave no figures open."""

import signal
import sys

import pytest

# A shell that starts the tests in the background has them ignore SIGINT, as would every program
# that they start.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")
