# SPDX-License-Identifier: MIT
"""Numbers that figures are asked for: what cannot be drawn is refused in one sentence."""

from __future__ import annotations

import math
from typing import Any

from polhode._core import _number


def require_positive(function: str, name: str, value: Any) -> None:
    """ValueError unless the number is positive and finite; TypeError for what is no number."""
    required = f"{function}: got {name} = {value!r}; expected a positive, finite number"
    try:
        finite = math.isfinite(value)
    except TypeError:
        raise TypeError(required) from None
    value = _number(value, f"{function}: {name}")
    if not (finite and value > 0):
        raise ValueError(required)
