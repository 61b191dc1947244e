# SPDX-License-Identifier: MIT
"""The tolerances of every test, read from their only home: `budgets.adaptive_short_run`."""

import pathlib
import re

_FILES = sorted(pathlib.Path(__file__).resolve().with_name("budgets").glob("*.hpp"))
# `inline constexpr double a = 1e-3, b = 0x1p-4;`
_VALUES = {
    name: float.fromhex(value) if value.startswith("0x") else float(value)
    for file in _FILES
    for line in re.findall(r"inline constexpr double ([^;]+);", file.read_text("ascii"))
    for name, value in (pair.split(" = ") for pair in re.split(r",\s*", line))
}


def __getattr__(name: str) -> float:
    try:
        return _VALUES[name]
    except KeyError:
        raise AttributeError(f"tests/budgets has no {name}") from None
