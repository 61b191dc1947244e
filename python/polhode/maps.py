# SPDX-License-Identifier: MIT
"""Maps: a scenario over a grid of its own numbers, on the processors of this machine."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    from polhode.scenarios import Path, Scenario

    Array = numpy.typing.NDArray[numpy.float64]


class MapResults(Mapping[str, "Array"]):
    """The rows of a map: `results["mean_megno"]` is a column, a read-only view without a copy.

    Columns are named and have the units as in the files of `polhode map`: the axes, then the
    results. Made by `Scenario.map`; figures.chaos_map and figures.poincare_section draw them.
    """

    def __init__(
        self,
        scenario: Scenario,
        columns: Sequence[tuple[str, str]],
        axes: int,
        table: Array,
        cells: Array,
        failures: Sequence[tuple[int, str]],
    ) -> None:
        self._scenario = scenario
        self._columns = list(columns)
        self._axes = axes
        self._table = table
        self._cells = cells
        self._failures = list(failures)
        self._where = {name: k for k, (name, _) in enumerate(columns)}

    def __getitem__(self, name: str) -> Array:
        return self._table[:, self._where[name]]

    def __iter__(self) -> Iterator[str]:
        return iter(self._where)

    def __len__(self) -> int:
        return len(self._where)

    __hash__ = None  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MapResults):
            return NotImplemented
        return (
            self._columns == other._columns
            and self._table.shape == other._table.shape
            and self._table.tobytes() == other._table.tobytes()
        )

    @property
    def scenario(self) -> Scenario:
        """What was run."""
        return self._scenario

    @property
    def axes(self) -> tuple[str, ...]:
        """The names of the columns that are axes of the grid; the last one runs fastest."""
        return tuple(list(self._where)[: self._axes])

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column; "1" for pure numbers."""
        return dict(self._columns)

    @property
    def cell(self) -> numpy.typing.NDArray[numpy.int64]:
        """(N,): which cell each row is of. A cell is one row, of a section one for each point."""
        return self._cells

    @property
    def failures(self) -> list[tuple[int, str]]:
        """(cell, why) of the cells that hold NaN, because they could not be or could not go on."""
        return list(self._failures)

    def __repr__(self) -> str:
        title = self._scenario.title or self._scenario.name
        columns = ", ".join(n if u == "1" else f"{n} [{u}]" for n, u in self._columns)
        failed = f"; {len(self._failures)} cells failed" if self._failures else ""
        return f"<MapResults: {title}: {len(self._table)} rows of {columns}{failed}>"

    def __reduce__(self) -> tuple[object, ...]:
        return _restored, (
            self._scenario,
            self._columns,
            self._axes,
            self._table.copy(),
            self._cells,
            self._failures,
        )


def _restored(scenario: Any, columns: Any, axes: int, table: Any, *others: Any) -> MapResults:
    table.flags.writeable = False
    return MapResults(scenario, columns, axes, table, *others)


def run_map(
    scenario: Scenario,
    paths: Sequence[Path],
    threads: int | None,
    resume: bool,
    restart: bool,
    progress: Callable[[int, int], object] | None,
) -> MapResults:
    """The map of a scenario; see Scenario.map."""
    import numpy

    done = scenario._file.map(list(paths), threads or 0, resume, restart, progress)
    groups = numpy.array(done.cells_and_rows, dtype=numpy.int64).reshape(-1, 2)
    rows = numpy.repeat(groups[:, 1], groups[:, 0])  # of each cell
    cells = numpy.repeat(numpy.arange(len(rows), dtype=numpy.int64), rows)
    return MapResults(scenario, done.columns, done.axes, done.table, cells, done.failures)
