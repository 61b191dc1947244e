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

# Spin axes over ages (python/tests/test_spin_axes.py): 28 of Laskar's 160 terms against La2004, rad;
# two methods, and the same orbit as a table.
la2004_obliquity = 3.2e-3
la2004_climatic = 6e-3
spin_methods = 1e-10
spin_length = 1e-15
