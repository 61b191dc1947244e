# SPDX-License-Identifier: MIT
"""What a run of a scenario leaves: columns by name, as views onto one table, with their units."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from polhode import _core, _tables
from polhode._columns import Columns, restored
from polhode._notebook import html_rows
from polhode._summary import Summary

if TYPE_CHECKING:
    import numpy
    import numpy.typing
    import pandas
    import xarray

    from polhode import EventRecord, Outcome, RotorState, Statistics
    from polhode.scenarios import Scenario

    Array = numpy.typing.NDArray[numpy.float64]


class Results(Columns):
    """The rows of a scenario: `results["theta"]` is a column, a read-only view without a copy.

    Columns are named and have the units as in the files of `polhode run`, t first; `results.groups`
    has those that belong together as one array. Made by `Scenario.run`. `results["date"]` holds
    texts, which numpy.asarray(..., "datetime64[us]") turns into times.
    """

    def __init__(
        self,
        scenario: Scenario,
        table: Array,
        outcome: Outcome,
        statistics: Statistics,
        events: Sequence[EventRecord],
        energy_change: float | None,
        kept: bool = True,
        end: EventRecord | None = None,
    ) -> None:
        super().__init__(scenario._file.groups, table)
        self._scenario = scenario
        self._outcome = outcome
        self._statistics = statistics
        self._events = list(events)
        self._energy_change = energy_change
        self._kept = kept
        self._end = end  # the last state of an integrated run
        self._dates = frozenset(scenario._file.date_columns)

    def _column(self, name: str, place: int) -> Array:
        column = self._table[:, place]
        return self._dated(column) if name in self._dates else column

    def _dated(self, times: Array) -> Array:
        import numpy

        dates = numpy.array(self._scenario._file.dates(times.tolist()), dtype="<U26")
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
                + ", ".join(self._scenario.columns)
                + ": with_columns([\"q\", \"g\"]) makes one that has them"
            )
        q, g = self._spans["q"].start, self._spans["g"].start
        return self._scenario._file.states_in(self._table, q, g)

    @property
    def scenario(self) -> Scenario:
        """What was run."""
        return self._scenario

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
    def energy_change(self) -> float | None:
        """E at the last row less that at t = 0, where every perturbation has an energy; of a free
        motion, which is exact, None."""
        return self._energy_change

    @property
    def summary(self) -> Summary:
        """What the body does and how the run went: what `polhode run` prints."""
        file = self._scenario._file
        lines = file.report_lines(
            self._outcome, self._statistics, self._events, self._energy_change, self._end
        )
        return Summary([*file.summary, *lines])

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
        self._scenario._file.write(path, self._table)

    def _notes(self) -> dict[str, str]:
        scenario = self._scenario
        notes = {"title": scenario.title, "scenario": scenario.name, "method": scenario.propagation}
        return {**notes, "outcome": _text_of(self._outcome, scenario)}

    def _missing(self, name: object) -> str:
        if not isinstance(name, str):
            return super()._missing(name)
        if name in self._spans:
            names = ", ".join(list(self._where)[self._spans[name]])
            return f"\"{name}\" is a group of columns: results.groups[\"{name}\"], or {names}"
        known = [*_core._column_names(), *_core._column_group_names()]
        remedy = "[output] columns must name it; "
        if name in known:
            has = f"these results have {', '.join(self._where)}"
            return f"no column \"{name}\": {remedy}{has}"
        return self._missing_among(name, known, remedy)

    def _head(self) -> tuple[str, str, str]:
        title = self._scenario.title or self._scenario.name
        n = len(self._table)
        unit = self._units["t"]
        span = f"t = {self.t[0]:.10g} to {self.t[-1]:.10g} {unit}" if n else "none"
        end = f"{self._scenario.propagation}; {_text_of(self._outcome, self._scenario)}"
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
            type(self), (self._scenario,), self._table.copy(),
            (
                self._outcome, self._statistics, self._events, self._energy_change, self._kept,
                self._end,
            ),
        )


def _text_of(outcome: Outcome, scenario: Scenario) -> str:
    if outcome.status == _core.Outcome.Status.completed:
        return "completed"
    where = f"at t = {outcome.t!r} {scenario.units.time}"
    return f"stopped by an event {where}" if outcome.ok else f"failed {where}: {outcome.advice}"
