# SPDX-License-Identifier: MIT
"""Columns by name, as views onto one table, with their units: what results of every kind are."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    Array = numpy.typing.NDArray[numpy.float64]


class Columns(Mapping[str, "Array"]):
    """A mapping of columns. Two are equal when they have the same ones, with the same units, and
    every number the same bits."""

    def __init__(
        self, groups: Iterable[tuple[str, Sequence[tuple[str, str]]]], table: Array
    ) -> None:
        self._table = table
        self._where: dict[str, int] = {}
        self._units: dict[str, str] = {}
        self._spans: dict[str, slice] = {}
        for group, columns in groups:
            first = len(self._where)
            for name, unit in columns:
                self._where[name] = len(self._where)
                self._units[name] = unit
            self._spans[group] = slice(first, len(self._where))

    def __getitem__(self, name: str) -> Array:
        try:
            place = self._where[name]
        except (KeyError, TypeError):
            raise MissingColumn(self._missing(name)) from None
        return self._column(name, place)

    def __iter__(self) -> Iterator[str]:
        return iter(self._where)

    def __len__(self) -> int:
        return len(self._where)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self._where)

    __hash__ = None  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return NotImplemented
        return self._units == other._units and all(
            same_bits(self[name], other[name]) for name in self
        )

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of all columns, in their order."""
        return tuple(self._where)

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column; "1" for pure numbers."""
        return dict(self._units)

    def _column(self, name: str, place: int) -> Array:
        return self._table[:, place]

    def _missing(self, name: object) -> str:
        """What is said of a name that no column has."""
        return self._missing_among(name, self._where)

    def _missing_among(self, name: object, known: Iterable[str], remedy: str = "") -> str:
        has = f"{remedy}these results have {', '.join(self._where)}"
        if not isinstance(name, str):
            return f"got {name!r}; expected the name of a column: {has}"
        near = difflib.get_close_matches(name, known, n=3)
        mean = f"did you mean {' or '.join(near)}? " if near else ""
        return f"no column \"{name}\"; {mean}{has}"


class MissingColumn(KeyError):
    """KeyError shows the repr of its message; this one is a sentence."""

    def __str__(self) -> str:
        return self.args[0]


def same_bits(a: Any, b: Any) -> bool:
    return a.shape == b.shape and a.tobytes() == b.tobytes()


def restored(
    made: Callable[..., Any], before: Sequence[Any], table: Any, after: Sequence[Any]
) -> Any:
    """Results from a pickle, whose table could be written into."""
    table.flags.writeable = False
    return made(*before, table, *after)
