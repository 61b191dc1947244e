# SPDX-License-Identifier: MIT
"""The tolerances of every test, read from their only home: `budgets.adaptive_short_run`."""

import pathlib
import re

_TEXT = pathlib.Path(__file__).resolve().with_name("budgets.hpp").read_text("ascii")
_VALUES = {
    name: float(value)
    for name, value in re.findall(r"inline constexpr double (\w+) = ([-+.e\d]+);", _TEXT)
}


def __getattr__(name: str) -> float:
    try:
        return _VALUES[name]
    except KeyError:
        raise AttributeError(f"tests/budgets.hpp has no {name}") from None
