# SPDX-License-Identifier: MIT
"""Maps: a scenario over a grid of its own numbers, on the processors of this machine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from polhode._columns import Columns, restored

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    from polhode.scenarios import Path, Scenario

    Array = numpy.typing.NDArray[numpy.float64]


class MapResults(Columns):
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
        super().__init__([(name, [(name, unit)]) for name, unit in columns], table)
        self._scenario = scenario
        self._axes = axes
        self._cells = cells
        self._failures = list(failures)

    @property
    def scenario(self) -> Scenario:
        """What was run."""
        return self._scenario

    @property
    def axes(self) -> tuple[str, ...]:
        """The names of the columns that are axes of the grid; the last one runs fastest."""
        return tuple(list(self._where)[: self._axes])

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
        columns = ", ".join(n if u == "1" else f"{n} [{u}]" for n, u in self._units.items())
        failed = f"; {len(self._failures)} cells failed" if self._failures else ""
        return f"<MapResults: {title}: {len(self._table)} rows of {columns}{failed}>"

    def __reduce__(self) -> tuple[object, ...]:
        before = (self._scenario, list(self._units.items()), self._axes)
        return restored, (
            type(self), before, self._table.copy(), (self._cells, self._failures)
        )


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
