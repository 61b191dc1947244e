# SPDX-License-Identifier: MIT
"""What an ensemble keeps beside its columns: histograms, and first times of events."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy

from polhode import _output_files
from polhode._columns import MissingColumn, same_bits
from polhode._tables import imported

if TYPE_CHECKING:
    import numpy.typing
    import xarray

    Array = numpy.typing.NDArray[numpy.float64]


class FirstTimes(NamedTuple):
    """When an event first happened to the members of an ensemble that did not fail."""

    part: float
    """To which part of them it happened at all."""
    times: dict[float, float]
    """By when it had happened to so many of them, by quantile; NaN where fewer ever had it."""
    unit: str
    """Of the times."""


@dataclass(frozen=True, eq=False)
class EnsembleHistogram:
    """Members counted in bins of one or two columns: an [[ensemble.histogram]].

    `members[k]` are the counts at the time `t[k]`, along one axis or two; the first and the last
    bin of each are open, so that `members[k][1:-1, 1:-1]` is the picture.
    """

    name: str
    t: Array
    """(T,): the times, or the last one alone."""
    edges: dict[str, Array]
    """By column: (T, bins + 1), from -inf to inf. A bin has its lower edge, the last one before
    the open bin both."""
    members: Array
    """(T, bins) or (T, bins of the first column, bins of the second): how many are in each."""
    part: Array
    """The same of those that have these numbers then; NaN where none has."""
    units: dict[str, str]
    """Of t and of the columns."""

    @property
    def columns(self) -> tuple[str, ...]:
        """What is counted, in the order of the axes."""
        return tuple(self.edges)

    def to_xarray(self) -> xarray.Dataset:
        """Members and part as an xarray.Dataset along t and a dimension for each column, named
        after it; COLUMN_low and COLUMN_high are the edges of the bins."""
        words = {"members": "members in a bin", "part": "part of the members in a bin"}
        dimensions = ("t", *self.columns)
        coordinates = {"t": ("t", self.t, {"units": self.units["t"], "long_name": "t"})}
        for column, edges in self.edges.items():
            for end, some in (("low", edges[:, :-1]), ("high", edges[:, 1:])):
                said = {"units": self.units[column], "long_name": f"{end} edge of {column}"}
                coordinates[f"{column}_{end}"] = (("t", column), some, said)
        return imported("xarray").Dataset(
            {
                name: (dimensions, getattr(self, name), {"units": "1", "long_name": text})
                for name, text in words.items()
            },
            coords=coordinates, attrs={"histogram": self.name},
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, EnsembleHistogram):
            return NotImplemented
        ours, theirs = (
            [one.t, one.members, one.part, *one.edges.values()] for one in (self, other)
        )
        return (self.name, self.units, self.columns) == (
            other.name, other.units, other.columns
        ) and all(map(same_bits, ours, theirs))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        axes = ", ".join(
            f"{column} ({edges.shape[1] - 1} bins)" for column, edges in self.edges.items()
        )
        return f"<EnsembleHistogram: {self.name}: {axes}; {len(self.t)} times>"


class Histograms(dict[str, EnsembleHistogram]):
    """By name; says of a name that none has what there is."""

    def __init__(self, found: dict[str, EnsembleHistogram], keep: str) -> None:
        super().__init__(found)
        self._keep = keep

    def __missing__(self, name: object) -> EnsembleHistogram:
        if self._keep != "statistics":
            raise MissingColumn(
                f"no histogram {name!r}: histograms go with keep=\"statistics\", and these results "
                f"have keep=\"{self._keep}\""
            )
        there = ", ".join(self) or "none; a table [[ensemble.histogram]] asks for one"
        raise MissingColumn(f"no histogram {name!r}; there are: {there}")


def histogram_of(
    name: str, columns: Sequence[str], units: dict[str, str], rows: dict[str, Any]
) -> EnsembleHistogram:
    """From the columns of its file: a row is a time and a bin, those of the last column side by
    side; at each time the first bin of a column begins at -inf."""
    t, at = numpy.unique(rows["t"], return_index=True)
    t = rows["t"][numpy.sort(at)]
    shape = [len(t), -1]
    if len(columns) == 2:
        first = numpy.count_nonzero(rows[f"{columns[0]}_low"] == -numpy.inf)
        shape = [len(t), -1, first // max(len(t), 1)]
    edges = {}
    for axis, column in enumerate(columns):
        low, high = (rows[f"{column}_{end}"].reshape(shape) for end in ("low", "high"))
        if len(columns) == 2:
            low, high = (x[:, :, 0] if axis == 0 else x[:, 0] for x in (low, high))
        edges[column] = numpy.hstack([low, high[:, -1:]])
    members, part = (rows[which].reshape(shape) for which in ("members", "part"))
    for array in (t, members, part, *edges.values()):
        array.flags.writeable = False
    return EnsembleHistogram(
        name, t, edges, members, part,
        {"t": units["t"], **{column: units[f"{column}_low"] for column in columns}},
    )


def _columns_of(groups: Any, table: Any) -> tuple[dict[str, str], dict[str, Any]]:
    units = {name: unit for _, columns in groups for name, unit in columns}
    return units, {name: table[:, k] for k, name in enumerate(units)}


def histograms_in_memory(planned: Any, found: Any) -> dict[str, EnsembleHistogram]:
    """Of what a run has left: (name, groups, rows)."""
    columns = dict(planned)
    return {
        name: histogram_of(name, columns[name], *_columns_of(groups, table))
        for name, groups, table in found
    }


def histograms_beside(planned: Any, output: str) -> dict[str, EnsembleHistogram]:
    """Of the files next to an output. OSError for one that is not there."""
    stem, extension = os.path.splitext(output.removesuffix(".part"))
    found = {}
    for name, columns in planned:
        file = _output_files.read_ensemble_file(f"{stem}.{name}{extension}")
        found[name] = histogram_of(name, columns, *_columns_of(file.groups, file.table))
    return found
