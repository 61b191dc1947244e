# SPDX-License-Identifier: MIT
"""What a run and a map leave: columns by name, as views onto one table, with their units.

They know the compiled file that was run; `.scenario` is added in polhode._scenarios."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from polhode import _core, _tables, _toml
from polhode._columns import Columns, restored
from polhode._notebook import html_rows
from polhode._summary import Summary

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import numpy
    import numpy.typing
    import pandas
    import xarray

    from polhode._core import EventRecord, Outcome, RotorState, Statistics

    Array = numpy.typing.NDArray[numpy.float64]

_Map = TypeVar("_Map", bound="MapColumns")


class RunColumns(Columns):
    """The rows of a run: see polhode.Results."""

    def __init__(
        self,
        file: Any,
        table: Array,
        outcome: Outcome,
        statistics: Statistics,
        events: Sequence[EventRecord],
        energy_change: float | None,
        kept: bool = True,
        end: EventRecord | None = None,
    ) -> None:
        super().__init__(file.groups, table)
        self._file = file
        self._outcome = outcome
        self._statistics = statistics
        self._events = list(events)
        self._energy_change = energy_change
        self._kept = kept
        self._end = end
        self._dates = frozenset(file.date_columns)

    def _column(self, name: str, place: int) -> Array:
        column = self._table[:, place]
        return self._dated(column) if name in self._dates else column

    def _dated(self, times: Array) -> Array:
        import numpy

        dates = numpy.array(self._file.dates(times.tolist()), dtype="<U26")
        dates.flags.writeable = False
        return dates

    @property
    def t(self) -> Array:
        """(N,): the times of the rows."""
        return self["t"]

    @property
    def groups(self) -> dict[str, Array]:
        """Columns that belong together, as views: "q" is (N, 4), "omega" (N, 3), "t" (N,), and
        "date", texts, (N,)."""
        return {
            group: self[group] if group == "t" or group in self._dates else self._table[:, span]
            for group, span in self._spans.items()
        }

    @property
    def states(self) -> RotorState[Array]:
        """The rows as a RotorState of shape (N,), along principal axes; needs groups q and g."""
        if "q" not in self._spans or "g" not in self._spans:
            raise AttributeError(
                "results.states needs the column groups q and g; the scenario has "
                + ", ".join(self._file.columns)
                + ": with_columns([\"q\", \"g\"]) makes one that has them"
            )
        q, g = self._spans["q"].start, self._spans["g"].start
        return self._file.states_in(self._table, q, g)

    @property
    def outcome(self) -> Outcome:
        """How the run ended."""
        return self._outcome

    @property
    def statistics(self) -> Statistics:
        """What the run cost; all 0 for exact free rotation."""
        return self._statistics

    @property
    def events(self) -> list[EventRecord]:
        """The events met, in the order of the run; their states in core units."""
        return list(self._events)

    @property
    def end(self) -> EventRecord | None:
        """Where an integrated run ended: time and state, in core units.

        That is `stop` or the event that stopped the run; the last row may lie before it. None for
        exact free rotation, whose state at any time is `scenario.free_rotation.at(t)`, and for
        scenarios of other kinds."""
        return self._end

    @property
    def energy_change(self) -> float | None:
        """E at the last row less that at t = 0, where every perturbation has an energy; of a free
        motion, which is exact, None."""
        return self._energy_change

    @property
    def summary(self) -> Summary:
        """What the body does and how the run went: what `polhode run` prints."""
        lines = self._file.report_lines(
            self._outcome, self._statistics, self._events, self._energy_change, self._end
        )
        return Summary([*self._file.summary, *lines])

    def to_pandas(self) -> pandas.DataFrame:
        """The columns as a pandas.DataFrame with index t; title, method, units, ... in .attrs."""
        return _tables.to_pandas(dict(self), self._notes(), self._units)

    def to_xarray(self) -> xarray.Dataset:
        """The columns as an xarray.Dataset along t; units are attributes of the variables."""
        return _tables.to_xarray(dict(self), self._notes(), self._units)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes PATH.csv, PATH.h5, ...: the file that the run would have written, byte for byte.

        A file of that name is replaced when the new one is complete (until then it is PATH.part);
        Scenario.save, which may meet a file written by hand, refuses to.
        ValueError for a path that cannot be an output, and where run(keep=False) left no rows;
        OutputError when writing fails.
        """
        if not self._kept:
            raise ValueError("write: these results have no rows, by keep=False")
        self._file.write(path, self._table)

    def _notes(self) -> dict[str, str]:
        file = self._file
        notes = {"title": file.title, "scenario": file.name, "method": file.propagation}
        return {**notes, "outcome": _text_of(self._outcome, file)}

    def _missing(self, name: object) -> str:
        if not isinstance(name, str):
            return super()._missing(name)
        if name in self._spans:
            names = ", ".join(list(self._where)[self._spans[name]])
            return f"\"{name}\" is a group of columns: results.groups[\"{name}\"], or {names}"
        kinds = _toml.known_kinds()
        known = [*kinds.column_names(), *kinds.column_group_names()]
        remedy = "[output] columns must name it; "
        if name in known:
            has = f"these results have {', '.join(self._where)}"
            return f"no column \"{name}\": {remedy}{has}"
        return self._missing_among(name, known, remedy)

    def _head(self) -> tuple[str, str, str]:
        title = self._file.title or self._file.name
        n = len(self._table)
        unit = self._units["t"]
        span = f"t = {self.t[0]:.10g} to {self.t[-1]:.10g} {unit}" if n else "none"
        end = f"{self._file.propagation}; {_text_of(self._outcome, self._file)}"
        return title, f"{n} rows, {span}" if self._kept else "rows in files alone", end

    def _group_texts(self) -> list[tuple[str, str]]:
        """Each group with its columns, those of one unit together."""
        names = list(self._where)
        texts = []
        for group, span in self._spans.items():
            if group == "t":
                continue
            by_unit: dict[str, list[str]] = {}
            for name in names[span]:
                by_unit.setdefault(self._units[name], []).append(name)
            texts.append((
                group,
                ", ".join(
                    " ".join(of) + ("" if unit == "1" else f" [{unit}]")
                    for unit, of in by_unit.items()
                ),
            ))
        return texts

    def __repr__(self) -> str:
        title, rows, end = self._head()
        groups = self._group_texts()
        width = max((len(group) for group, _ in groups), default=0)
        lines = [f"  {group:<{width}}  {text}" for group, text in groups]
        return "\n".join([f"<Results: {title}", f"  {rows}", *lines, f"  {end}>"])

    def _repr_html_(self) -> str:
        import html

        title, rows, end = (html.escape(text) for text in self._head())
        table = html_rows("", self._group_texts())
        return f"<p><b>{title}</b><br>{rows}<br>{end}</p>{table}"

    def __reduce__(self) -> tuple[object, ...]:
        return restored, (
            type(self), (self._file,), self._table.copy(),
            (
                self._outcome, self._statistics, self._events, self._energy_change, self._kept,
                self._end,
            ),
        )


def _text_of(outcome: Outcome, file: Any) -> str:
    if outcome.status == _core.Outcome.Status.completed:
        return "completed"
    where = f"at t = {outcome.t!r} {file.units.time}"
    return f"stopped by an event {where}" if outcome.ok else f"failed {where}: {outcome.advice}"


class MapColumns(Columns):
    """The rows of a map: see polhode.MapResults."""

    def __init__(
        self,
        file: Any,
        columns: Sequence[tuple[str, str]],
        axes: int,
        table: Array,
        cells: Array,
        failures: Sequence[tuple[int, str]],
    ) -> None:
        super().__init__([(name, [(name, unit)]) for name, unit in columns], table)
        self._file = file
        self._axes = axes
        self._cells = cells
        self._failures = list(failures)

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
        title = self._file.title or self._file.name
        columns = ", ".join(n if u == "1" else f"{n} [{u}]" for n, u in self._units.items())
        failed = f"; {len(self._failures)} cells failed" if self._failures else ""
        return f"<MapResults: {title}: {len(self._table)} rows of {columns}{failed}>"

    def __reduce__(self) -> tuple[object, ...]:
        before = (self._file, list(self._units.items()), self._axes)
        return restored, (
            type(self), before, self._table.copy(), (self._cells, self._failures)
        )


def run_map(
    kind: type[_Map],
    file: Any,
    paths: Sequence[Any],
    threads: int | None,
    executor: Executor | None,
    resume: bool,
    restart: bool,
    any_machine: bool,
    progress: Callable[[int, int], object] | None,
) -> _Map:
    """The map of a file; see Scenario.map."""
    import numpy

    run_stage = None
    if executor is not None:
        from polhode._executor import stage_runner

        run_stage = stage_runner("map", executor, file, any_machine)
    done = file.map(list(paths), threads or 0, run_stage, resume, restart, any_machine, progress)
    groups = numpy.array(done.cells_and_rows, dtype=numpy.int64).reshape(-1, 2)
    rows = numpy.repeat(groups[:, 1], groups[:, 0])  # of each cell
    cells = numpy.repeat(numpy.arange(len(rows), dtype=numpy.int64), rows)
    return kind(file, done.columns, done.axes, done.table, cells, done.failures)
