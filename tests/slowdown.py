# SPDX-License-Identifier: MIT
"""How many times as long limits of time are: on busy machines, and under sanitizers."""

import os

SLOWDOWN = float(os.environ.get("POLHODE_TEST_SLOWDOWN", "1"))
