# SPDX-License-Identifier: MIT
"""Ensembles: many runs of a scenario with some of its numbers drawn, and what is made of them."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from polhode import _core, _ensemble_files, _toml, vary
from polhode._columns import Columns, MissingColumn, restored

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import numpy
    import numpy.typing
    import xarray

    from polhode._ensemble_histograms import EnsembleHistogram, FirstTimes
    from polhode.scenarios import Path, Scenario

    Array = numpy.typing.NDArray[numpy.float64]

MARK = "{chunk}"
"""In the name of an output: each chunk has a file of its own."""


class EnsembleResults(Columns):
    """What an ensemble keeps: `results["P_short_mean"]` is a column, a view without a copy.

    Columns are named and have the units as in the files of `polhode ensemble`. By `keep` a row is a
    time ("statistics"), a member with what was drawn and its last row ("final"), one row of a
    member ("rows"), or a chunk whose rows are in a file of its own ("chunks"). Made by
    polhode.ensemble and Scenario.ensemble, or read from a file.
    """

    def __init__(self, given: Mapping[str, Any]) -> None:
        super().__init__(given["groups"], given["table"])
        self._given = dict(given)
        self._members: Any = None  # the ensemble of C++, once it is asked for

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> EnsembleResults:
        """What `polhode ensemble` or a call from Python wrote into a file, CSV or HDF5.

        Of files of chunks, one of them or their index. HDF5 needs the package h5py. A file that is
        not complete yet, PATH.part, has what is done.
        OSError for a file that cannot be read, ValueError for one that is not of an ensemble.
        """
        file = _ensemble_files.read_file(path)
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
        return cls({
            "scenario": None, "file": (file.scenario, file.scenario_name, file.path),
            "title": file.title, "groups": file.groups, "table": file.table, "texts": file.texts,
            "keep": keep, "size": int(sizes[1]) if sizes else 0, "keys": keys,
            "failures": file.failures, "failed": None,
            "own": (int(own[1]), int(own[2]) + 1) if own else None, "beside": file.path,
        })

    def _column(self, name: str, place: int) -> Array:
        return self._texts[name] if name in self._texts else self._table[:, place]

    @property
    def _texts(self) -> dict[str, Any]:
        """Columns that are dates, made when they are asked for."""
        import numpy

        if self._given["texts"] is None:
            file, texts = self.scenario._file, {}
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
    def scenario(self) -> Scenario:
        """What was run, with its table [ensemble]; of a file, the scenario inside."""
        if self._given["scenario"] is None:
            from polhode.scenarios import Scenario

            text, name, path = self._given["file"]
            beside = os.path.join(os.path.dirname(path), name)
            self._given["scenario"] = Scenario.from_text(text, beside)
        return self._given["scenario"]

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
        return _ensemble_files.chunk_files(
            self._given["beside"], self["chunk"], (self.size - 1) // ensemble.chunk
        )

    @property
    def first_times(self) -> dict[str, FirstTimes]:
        """Beside statistics, by event of the scenario: to which part of the members it happened,
        and by when to so many of them. AttributeError where results come from a file, which has
        columns EVENT_part against time alone."""
        from polhode._ensemble_histograms import FirstTimes

        if self.keep != "statistics":
            return {}
        if self._given.get("first_times") is None:
            raise AttributeError(
                "first_times: a file does not hold them; its columns EVENT_part say which part "
                "they had happened to by each time"
            )
        unit, quantiles = self.units["t"], self._given["quantiles"]
        return {
            event: FirstTimes(part, dict(zip(quantiles, times)), unit)
            for event, part, times in self._given["first_times"]
        }

    @property
    def histograms(self) -> dict[str, EnsembleHistogram]:
        """Beside statistics, the histograms of the scenario by name. Of results from a file, those
        next to it: OSError for one that is not there. Empty for another keep. KeyError for a name
        that none has."""
        from polhode import _ensemble_histograms as of

        if self.keep != "statistics":
            return of.Histograms({}, self.keep)
        planned = self._ensemble().histograms
        found = self._given.get("histograms")
        return of.Histograms(
            of.histograms_beside(planned, self._given["beside"]) if found is None
            else of.histograms_in_memory(planned, found),
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

    def member(self, index: int) -> Scenario:
        """The scenario of one member, from 0 on: what `polhode ensemble --member` prints. Its run
        gives the numbers that the ensemble had, to the last bit. ValueError for another index."""
        from polhode.scenarios import Scenario

        return Scenario.from_text(self._ensemble().member_text(index), self.scenario._file.path)

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
            self._members = self.scenario._file.ensemble()
        return self._members

    def _name(self) -> str:
        named = self._given["scenario"]
        return self._given["file"][1] if named is None else named.name

    def _title(self) -> str:
        named = self._given["scenario"]
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
        return _of_parts, ({**self._given, "table": None}, self._table.copy())


def _of_parts(given: dict[str, Any], table: Any) -> EnsembleResults:
    return restored(lambda whole: EnsembleResults({**given, "table": whole}), (), table, ())


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


def with_ensemble(scenario: Scenario, vary_: Any, keys: Mapping[str, Any]) -> Scenario:
    """See Scenario.with_ensemble."""
    from polhode.scenarios import Scenario

    given = {key: value for key, value in keys.items() if value is not None}
    text, table = scenario.text, {}
    if scenario._file.has_ensemble:
        table = _toml.data_from(text)["ensemble"]
        text = _core._changed_text(text, "ensemble", "")
    table.update(given)
    if vary_ is not None:
        table["vary"] = vary.tables_of(vary_)
    tables = _toml.text_from({"ensemble": table}).strip("\n")
    own = text.rstrip("\n") + "\n\n"
    try:
        return Scenario.from_text(own + tables + "\n", scenario._file.path)
    except _core.ScenarioError as error:
        raise _core.ScenarioError(_without_places(str(error), own.count("\n"))) from None


def _without_places(message: str, lines: int) -> str:
    """What is said of lines after these, which are in no text that anybody has: the key alone."""
    def without(found: re.Match[str]) -> str:
        return found[0] if int(found[1]) <= lines else found[2]

    return re.sub(r"^.*?:(\d+):\d+: (ensemble[.:])", without, message, flags=re.MULTILINE)


def run_ensemble(
    scenario: Scenario,
    paths: Sequence[Path],
    threads: int | None,
    executor: Executor | None,
    resume: bool,
    restart: bool,
    any_machine: bool,
    progress: Callable[[int, int], object] | None,
) -> EnsembleResults:
    """The ensemble of a scenario; see Scenario.ensemble."""
    ensemble = scenario._file.ensemble()
    team, names = None, [os.fsdecode(path) for path in paths]
    if executor is not None:
        from polhode._ensemble_team import team_of

        team = team_of(executor, scenario._file, any_machine)
        # workers may be in other folders
        names = [os.path.abspath(name) if MARK in name else name for name in names]
    done = ensemble.run(names, threads or 0, team, resume, restart, any_machine, progress)
    has_index = any(MARK in name for name in names)
    files = [name.replace(MARK, "index", 1) for name in names]
    # what an earlier part wrote is in its files alone
    table, texts, in_file = (
        (done.table, None, None) if done.is_whole else _in_files(done.groups, files)
    )
    results = EnsembleResults({
        "scenario": scenario, "file": None, "title": "", "groups": done.groups, "table": table,
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

    found = EnsembleResults.read(next(name for name in names if name.endswith((".csv", ".h5"))))
    order = [found._where[name] for _, columns in groups for name, _ in columns]
    table = numpy.ascontiguousarray(found._table[:, order])
    table.flags.writeable = False
    return table, found._texts, found._given["failures"]


def ensemble(
    scenario: Scenario | Path,
    vary: Mapping[Any, vary.Distribution] | None = None,
    outputs: Path | Iterable[Path] = (),
    *,
    size: int | None = None,
    seed: int | None = None,
    keep: str | None = None,
    quantiles: Sequence[float] | None = None,
    threads: int | None = None,
    executor: Executor | None = None,
    resume: bool = False,
    restart: bool = False,
    any_machine: bool = False,
    progress: Callable[[int, int], object] | None = None,
    **others: Any,
) -> EnsembleResults:
    """Many runs of a scenario with some of its numbers drawn: its members, and what they have in
    common.

    Parameters
    ----------
    scenario : a Scenario, or the path of its file.
    vary : what is drawn, by key: {"body.moments[0]": polhode.vary.uniform(0.60, 0.63)}. Several
        keys that are drawn together stand in a tuple, and an array by its name. None: what the
        table [ensemble] of the scenario says. What is given takes the place of all its tables
        [[ensemble.vary]]; the rest of [ensemble] stays: size, seed, quantiles, fractions,
        histograms.
    outputs : PATH.csv or PATH.h5, one or several, as those of Scenario.map; or "rows-{chunk}.h5", a
        file for each chunk, as in Scenario.ensemble.
    size : how many members.
    seed : another one draws other members.
    keep : "statistics" of the members at each time, memory not growing with them; "final", what was
        drawn and the last row of each member; "rows", all rows of all.
    quantiles : which ones statistics have, from 0 to 1.
    threads, executor, resume, restart, any_machine, progress : as in Scenario.ensemble.
    others : further keys of the table [ensemble] of scenario files, such as draws="sobol".

    What is None is what the scenario says, or the default of scenario files. The same numbers as
    `polhode ensemble` gives of the same file, to the last bit, for any number of threads
    and whoever computes them.

    Returns
    -------
    EnsembleResults
        A mapping of columns. `.failures` are the members that could not be, `.member(k)` is the
        scenario of one, `.scenario` that of the ensemble, which `polhode ensemble` runs as well.

    ScenarioError for a key that does not exist or cannot vary and for what is no distribution;
    RuntimeError where all members fail, with the first reasons; else as Scenario.ensemble.
    """
    from polhode.scenarios import Scenario, load

    of = scenario if isinstance(scenario, Scenario) else load(scenario)
    keys = {"size": size, "seed": seed, "keep": keep, "quantiles": quantiles, **others}
    if vary is not None or any(value is not None for value in keys.values()):
        of = of.with_ensemble(vary, **keys)
    return of.ensemble(
        outputs, threads=threads, executor=executor, resume=resume, restart=restart,
        any_machine=any_machine, progress=progress,
    )
