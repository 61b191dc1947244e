# SPDX-License-Identifier: MIT
"""Maps: a scenario over a grid of its own numbers, on the processors of this machine."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import closing
from typing import TYPE_CHECKING, Any

from polhode import _core

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    from polhode.scenarios import Path, Scenario

    Array = numpy.typing.NDArray[numpy.float64]

_WAITING_PER_THREAD = 4
_LOOK_EVERY = 0.05  # seconds


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

    cells = _core._ScenarioMap(scenario._file)
    rows = _core._MapRows(cells, list(paths), resume, restart)
    at_a_time = _processors() if threads is None else threads
    try:
        # ends the threads in any case
        with closing(_in_order(cells, len(rows), at_a_time)) as done:
            for cell in done:
                rows.push(cell)
                if progress is not None:
                    progress(len(rows), len(cells))
        table, of, failures = rows.table()
        rows.finish()
    finally:
        rows.close()  # a traceback keeps this frame, and with it the lock
    return MapResults(
        scenario, cells.columns, cells.axes, table, numpy.array(of, dtype=numpy.int64), failures
    )


def _processors() -> int:
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not everywhere
        return os.cpu_count() or 1


def _in_order(cells: Any, first: int, threads: int) -> Iterator[Any]:
    """The cells from the first on, in order, some of them at a time: they give up the GIL."""
    with ThreadPoolExecutor(threads) as pool:
        waiting: deque[Future[Any]] = deque()
        try:
            for index in range(first, len(cells)):
                waiting.append(pool.submit(cells.cell, index))
                if len(waiting) == _WAITING_PER_THREAD * threads:
                    yield _result(waiting.popleft())
            while waiting:
                yield _result(waiting.popleft())
        except BaseException:
            cells.stop()
            for future in waiting:
                future.cancel()
            raise


def _result(future: Future[Any]) -> Any:
    """Waits with looks at signals: one that another thread got does not wake this one."""
    while not wait([future], _LOOK_EVERY).done:
        pass
    return future.result()
