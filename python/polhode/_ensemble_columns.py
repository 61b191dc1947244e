# SPDX-License-Identifier: MIT
"""What an ensemble leaves, in memory and in files, and the text that asks for one.

Results know the compiled file that was run; `.scenario` is added in polhode._scenarios."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from polhode import _ensemble_histograms, _output_files, _toml, vary
from polhode._columns import Columns, MissingColumn, restored

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import numpy
    import numpy.typing
    import xarray

    from polhode._ensemble_histograms import EnsembleHistogram, FirstTimes

    Array = numpy.typing.NDArray[numpy.float64]

_Results = TypeVar("_Results", bound="EnsembleColumns")

MARK = "{chunk}"
"""In the name of an output: each chunk has a file of its own."""


class EnsembleColumns(Columns):
    """What an ensemble keeps: see polhode.ensemble.EnsembleResults."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        super().__init__(given["groups"], given["table"])
        self._given = dict(given)
        self._members: Any = None  # the ensemble of C++, once it is asked for

    def _column(self, name: str, place: int) -> Array:
        return self._texts[name] if name in self._texts else self._table[:, place]

    @property
    def _texts(self) -> dict[str, Any]:
        """Columns that are dates, made when they are asked for."""
        import numpy

        if self._given["texts"] is None:
            file, texts = self._file, {}
            for name in set(file.date_columns) & set(self._where):
                shown = file.dates(self._table[:, self._where[name]].tolist())
                texts[name] = numpy.array(shown, dtype="<U26")
                texts[name].flags.writeable = False
            self._given["texts"] = texts
        return self._given["texts"]

    @property
    def groups(self) -> dict[str, Array]:
        """Columns that belong together, as views: "q" is (N, 4), "t" (N,). Of a CSV file, which
        does not say it, every column by itself."""
        return {
            group: self[self.columns[span.start]] if span.stop - span.start == 1
            else self._table[:, span]
            for group, span in self._spans.items()
        }

    @property
    def keep(self) -> str:
        """"statistics", "final", "rows" or "chunks"."""
        return self._given["keep"]

    @property
    def size(self) -> int:
        """How many members there are, those that failed included; of the file of a chunk, how many
        the ensemble has."""
        return self._given["size"]

    @property
    def _file(self) -> Any:
        """What was run, with its table [ensemble]; of a file, the scenario inside."""
        if self._given["file"] is None:
            self._given["file"] = _toml.compiled(*self._given["inside"])
        return self._given["file"]

    @property
    def failures(self) -> list[tuple[int, str]]:
        """(member, why) of those that could not be or could not go on, the first 20 of them.

        They have no part in statistics. A file says them behind its rows. AttributeError of one
        that does not, since it is not complete or of an older version: member(k), or its run, says
        it of one.
        """
        if self._given["failures"] is None and self.failed:
            raise AttributeError(
                "failures: this file does not say why members failed: it is not complete, or of an "
                "older version; results.failed is how many, results.member(k), or its run, says it "
                "of one"
            )
        return list(self._given["failures"] or [])

    @property
    def failed(self) -> int:
        """How many members could not be or could not go on. Of a file of rows: those that have
        none."""
        import numpy

        if self._given["failed"] is not None:
            return self._given["failed"]
        if self.keep == "chunks":
            return int(self["failed"].sum())
        if self.keep == "statistics":
            return self.size - int(self["members"].max(initial=0.0))
        if self.keep == "final":
            return int(numpy.count_nonzero(numpy.isnan(self["t"])))
        return len(self._own) - len(numpy.unique(self["member"]))

    @property
    def _own(self) -> range:
        """The members that rows may be of: of the file of a chunk, those of the chunk."""
        return range(*(self._given["own"] or (0, self.size)))

    @property
    def chunk_files(self) -> list[str]:
        """Of keep "chunks": the paths of the files that EnsembleResults.read opens, one for each
        row. Else there are none."""
        if self.keep != "chunks":
            return []
        ensemble = self._ensemble()
        return _output_files.chunk_files(
            self._given["beside"], self["chunk"], (self.size - 1) // ensemble.chunk
        )

    @property
    def first_times(self) -> dict[str, FirstTimes]:
        """Beside statistics, by event of the scenario: to which part of the members it happened,
        and by when to so many of them. AttributeError where results come from a file, which has
        columns EVENT_part against time alone."""
        if self.keep != "statistics":
            return {}
        if self._given.get("first_times") is None:
            raise AttributeError(
                "first_times: a file does not hold them; its columns EVENT_part say which part "
                "they had happened to by each time"
            )
        unit, quantiles = self.units["t"], self._given["quantiles"]
        return {
            event: _ensemble_histograms.FirstTimes(part, dict(zip(quantiles, times)), unit)
            for event, part, times in self._given["first_times"]
        }

    @property
    def histograms(self) -> dict[str, EnsembleHistogram]:
        """Beside statistics, the histograms of the scenario by name. Of results from a file, those
        next to it: OSError for one that is not there. Empty for another keep. KeyError for a name
        that none has."""
        if self.keep != "statistics":
            return _ensemble_histograms.Histograms({}, self.keep)
        planned = self._ensemble().histograms
        found = self._given.get("histograms")
        return _ensemble_histograms.Histograms(
            _ensemble_histograms.histograms_beside(planned, self._given["beside"])
            if found is None else _ensemble_histograms.histograms_in_memory(planned, found),
            self.keep,
        )

    @property
    def drawn(self) -> dict[str, Array]:
        """What was drawn for each key that varies: arrays (size,) in the order of the members, in
        the units that the keys have in the file."""
        if self.keep == "final" and len(self._table) == self.size:
            return {key: self[key] for key in self._given["keys"]}
        ensemble = self._ensemble()
        numbers = ensemble.drawn(0, self.size)
        return {key: numbers[:, k] for k, key in enumerate(ensemble.keys)}

    def quantiles(self, column: str) -> dict[float, Array]:
        """Of statistics: the quantiles of a column against time, by their probability.

        KeyError for a column that has none.
        """
        found = quantiles_in(self, column)
        if not found:
            raise MissingColumn(
                f"no quantiles of \"{column}\"; these results have them of "
                f"{', '.join(columns_with_quantiles(self)) or 'none'}"
            )
        return found

    def to_xarray(self) -> xarray.Dataset:
        """The columns as an xarray.Dataset; units and what they are as attributes of the variables.

        Statistics lie along t, last rows along member, rows along member and t, NaN where a member
        has none, an index along chunk. First times of an event, EVENT_first, lie along quantile;
        histograms are datasets of their own. Where rows of one number are at different times (an
        event stopped a member between two rows) the second dimension is `row`, and t a coordinate
        along both.
        """
        from polhode._ensemble_xarray import dataset

        notes = {"title": self._title(), "scenario": self._name(), "size": self.size}
        keys = self._given["keys"]
        table = dataset(dict(self), self._units, keys, self.keep, self._own, notes)
        if not self._given.get("first_times"):
            return table
        return table.assign({
            f"{event}_first": (
                "quantile", list(of.times.values()),
                {"units": of.unit, "long_name": f"by when so many had met {event}"},
            )
            for event, of in self.first_times.items()
        }).assign_coords(quantile=self._given["quantiles"])

    def _ensemble(self) -> Any:
        if self._members is None:
            self._members = self._file.ensemble()
        return self._members

    def _name(self) -> str:
        named = self._given["file"]
        return self._given["scenario_name"] if named is None else named.name

    def _title(self) -> str:
        named = self._given["file"]
        return self._given["title"] if named is None else named.title

    def __repr__(self) -> str:
        rows = {
            "statistics": "statistics at {} times", "final": "last rows of {} members",
            "rows": "{} rows of the members", "chunks": "{} files of chunks",
        }[self.keep].format(len(self._table))
        columns = [
            f"{name} [{unit}]" if unit != "1" else name for name, unit in self._units.items()
        ]
        shown = ", ".join(columns[:12]) + (", ..." if len(columns) > 12 else "")
        failed = f"; {self.failed} members failed" if self.failed else ""
        title = self._title() or self._name()
        return f"<EnsembleResults: {title}: {self.size} members; {rows}: {shown}{failed}>"

    def __reduce__(self) -> tuple[object, ...]:
        return _of_parts, (type(self), {**self._given, "table": None}, self._table.copy())


def _of_parts(kind: type[_Results], given: dict[str, Any], table: Any) -> _Results:
    return restored(lambda whole: kind({**given, "table": whole}), (), table, ())


def read_ensemble(kind: type[_Results], path: str | os.PathLike[str]) -> _Results:
    """The ensemble in a file; see EnsembleResults.read."""
    file = _output_files.read_ensemble_file(path)
    noted = "\n".join(file.notes)
    names = [name for _, columns in file.groups for name, _ in columns]
    if "part" in names:
        raise ValueError(
            f"{file.path}: a histogram; expected rows or statistics of an ensemble, whose "
            "results have it in .histograms"
        )
    sizes = re.search(r"^ensemble: (\d+) members", noted, re.MULTILINE)
    own = re.search(r"^chunk \d+: members (\d+) to (\d+)$", noted, re.MULTILINE)
    keys = _keys_in(file.notes, names)
    keep = "statistics" if "member" not in names else "final" if keys else "rows"
    if "first_member" in names:
        keep = "chunks"
    file.table.flags.writeable = False
    beside = os.path.join(os.path.dirname(file.path), file.scenario_name)
    return kind({
        "file": None, "inside": (file.scenario, beside), "scenario_name": file.scenario_name,
        "title": file.title, "groups": file.groups, "table": file.table, "texts": file.texts,
        "keep": keep, "size": int(sizes[1]) if sizes else 0, "keys": keys,
        "failures": file.failures, "failed": None,
        "own": (int(own[1]), int(own[2]) + 1) if own else None, "beside": file.path,
    })


def _keys_in(notes: Sequence[str], names: Sequence[str]) -> list[str]:
    """The keys that vary, of those that are columns."""
    said = [note[8:] for note in notes if note.startswith("varied: ")]
    of_notes = [key for note in said for key in note.partition(": ")[0].split(", ")]
    return [key for key in of_notes if key in names]


def columns_with_quantiles(columns: Iterable[str]) -> list[str]:
    """The columns of rows that statistics have quantiles of."""
    found = (re.fullmatch(r"(.+)_p[0-9.e+-]+", name) for name in columns)
    return list(dict.fromkeys(match[1] for match in found if match))


def quantiles_in(columns: Mapping[str, Any], column: str) -> dict[float, Any]:
    """Probability -> quantiles of a column, in the order of the probabilities."""
    found = {}
    for name in columns:
        match = re.fullmatch(re.escape(column) + r"_p([0-9.e+-]+)", name)
        if match:
            found[float(f"{float(match[1]) / 100:.12g}")] = columns[name]
    return dict(sorted(found.items()))


def ensemble_tables(file: Any, vary_: Any, keys: Mapping[str, Any]) -> str:
    """The tables [ensemble] of a file with these changes, as TOML; see Scenario.with_ensemble."""
    table = _toml.data_from(file.text)["ensemble"] if file.has_ensemble else {}
    table.update({key: value for key, value in keys.items() if value is not None})
    if vary_ is not None:
        table["vary"] = vary.tables_of(vary_)
    return _toml.text_from({"ensemble": table}).strip("\n")


def run_ensemble(
    kind: type[_Results],
    file: Any,
    paths: Sequence[Any],
    threads: int | None,
    executor: Executor | None,
    resume: bool,
    restart: bool,
    any_machine: bool,
    progress: Callable[[int, int], object] | None,
) -> _Results:
    """The ensemble of a file; see Scenario.ensemble."""
    ensemble = file.ensemble()
    run_stage, names = None, [os.fsdecode(path) for path in paths]
    if executor is not None:
        from polhode._executor import stage_runner

        run_stage = stage_runner("ensemble", executor, file, any_machine)
        # workers may be in other folders
        names = [os.path.abspath(name) if MARK in name else name for name in names]
    done = ensemble.run(names, threads or 0, run_stage, resume, restart, any_machine, progress)
    has_index = any(MARK in name for name in names)
    files = [name.replace(MARK, "index", 1) for name in names]
    # what an earlier part wrote is in its files alone
    table, texts, in_file = (
        (done.table, None, None) if done.is_whole else _in_files(done.groups, files)
    )
    results = kind({
        "file": file, "groups": done.groups, "table": table,
        "texts": {} if has_index else texts, "keep": "chunks" if has_index else ensemble.keep,
        "size": ensemble.size,
        "keys": ensemble.keys if ensemble.keep == "final" and not has_index else [],
        "failed": None if done.was_done else done.failed,
        "failures": in_file if done.was_done else done.failures,
        "own": None, "beside": files[0] if files else "",
        "first_times": None if done.was_done else done.first_times,
        "histograms": None if done.was_done else [
            (name, groups, table.copy()) for name, groups, table in done.histograms
        ],
        "quantiles": ensemble.quantiles,
    })
    results._members = ensemble
    return results


def _in_files(groups: Any, names: Sequence[str]) -> tuple[Any, dict[str, Any], Any]:
    """The rows in the first file that can be read, in the order of these columns; the texts; and
    which members failed."""
    import numpy

    path = next(name for name in names if name.endswith((".csv", ".h5")))
    found = read_ensemble(EnsembleColumns, path)
    order = [found._where[name] for _, columns in groups for name, _ in columns]
    table = numpy.ascontiguousarray(found._table[:, order])
    table.flags.writeable = False
    return table, found._texts, found._given["failures"]
