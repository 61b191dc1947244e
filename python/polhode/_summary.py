# SPDX-License-Identifier: MIT
"""What a body does, in a few lines: values by key, with units, and the table that people read."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Union

from polhode._core import _shown_number
from polhode._notebook import html_rows

Value = Union[float, "tuple[float, ...]", str]
Line = tuple[str, str, list[float], str, str]


class Summary(dict[str, Value]):
    """What a scenario says of its body, or a run of itself: the lines of `polhode info`.

    A dict: key -> number, tuple of numbers, or text, in the units of the scenario. Printed, it is
    the table of the command line.

    Attributes
    ----------
    units : dict of key -> unit, of the numbers that have one.
    labels : dict of key -> what the value is, in words.
    """

    def __init__(self, lines: Iterable[Line]) -> None:
        super().__init__()
        self.units: dict[str, str] = {}
        self.labels: dict[str, str] = {}
        for key, label, numbers, text, unit in lines:
            self[key] = text if not numbers else numbers[0] if len(numbers) == 1 else tuple(numbers)
            self.labels[key] = label
            if unit:
                self.units[key] = unit

    def _cells(self) -> list[tuple[str, str]]:
        cells = []
        for key, value in self.items():
            numbers = value if isinstance(value, tuple) else (value,)
            text = ", ".join(x if isinstance(x, str) else _shown_number(key, x) for x in numbers)
            unit = self.units.get(key, "")
            cells.append((self.labels[key], f"{text} {unit}" if unit else text))
        return cells

    def __str__(self) -> str:
        cells = self._cells()
        width = max((len(label) for label, _ in cells), default=0)
        return "\n".join(f"{label:<{width}}  {text}" for label, text in cells)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return html_rows("", self._cells())

    def __reduce__(self) -> tuple[object, ...]:
        return _summary_from, (dict(self), self.units, self.labels)


def _summary_from(
    values: dict[str, Value], units: dict[str, str], labels: dict[str, str]
) -> Summary:
    summary = Summary(())
    summary.update(values)
    summary.units, summary.labels = units, labels
    return summary
