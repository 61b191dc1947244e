# SPDX-License-Identifier: MIT
"""Parts of a scenario: a body with moments 1, 2 and 2.5, and its state."""

BODY = "schema = 1\n[body]\nmoments = [1, 2, 2.5]\n"
STATE = "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0.1, 0.2, 1]\n"
