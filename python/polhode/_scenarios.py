# SPDX-License-Identifier: MIT
"""Scenarios: files that say what body rotates, how it starts, what acts on it and what to write;
and what their runs, maps and ensembles leave."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Union

from polhode import _building, _core, _toml
from polhode._ensemble_columns import EnsembleColumns, ensemble_tables, read_ensemble, run_ensemble
from polhode._results import MapColumns, RunColumns, run_map
from polhode._summary import Summary
from polhode._tables import plotted

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from numpy.typing import ArrayLike, NDArray

    from polhode import vary
    from polhode._core import (
        Adaptive,
        Body,
        Collocation,
        Frame,
        FreeRotation,
        KeplerOrbit,
        PrecessingKeplerOrbit,
        RotorState,
        SaveAt,
        Splitting,
        System,
        TableOrbit,
        TurnedKeplerOrbit,
        Units,
        VariationOfConstants,
    )

    Path = Union[str, bytes, os.PathLike[str], os.PathLike[bytes]]

_LARGEST_FILE = 16 << 20


class Citation(NamedTuple):
    """A paper that a scenario rests on: its key, how it is cited, what is taken from it, and its
    entry for BibTeX."""

    key: str
    text: str
    reason: str
    bibtex: str


def load(path: Path) -> Scenario:
    """The scenario in a TOML file.

    ScenarioError (a ValueError) with one line per mistake, `FILE:LINE:COLUMN: KEY: got ...;
    expected ...`; OSError for a file that cannot be read.
    """
    with open(os.fspath(path), "rb") as file:
        text = file.read(_LARGEST_FILE + 1)
    return Scenario.from_text(text, os.fsdecode(path))


class Scenario:
    """A body, its state at an epoch, what acts on it, and what to write. Immutable.

    Made by `load`, `from_text`, `from_dict` or `build`; the reference of scenario files lists the
    keys. Objects (body, state, system, ...) are in core units: radians, and the units of time,
    moment and length of the scenario. Results are in its units.
    """

    __slots__ = ("_file",)
    _file: Any

    def __init__(self) -> None:
        raise TypeError("Scenario: made by polhode.load, from_text, from_dict or build")

    @classmethod
    def _of(cls, file: Any) -> Scenario:
        scenario = object.__new__(cls)
        scenario._file = file
        return scenario

    @classmethod
    def from_text(cls, text: str | bytes, name: str = "scenario.toml") -> Scenario:
        """The scenario in a text; `name` stands for the file in messages and outputs.

        Files that it names (tables, meshes) are looked for next to `name`: with the default, in the
        current folder. A UserWarning names a table whose rows are too far apart.
        """
        if not isinstance(text, (str, bytes)):
            raise TypeError(f"from_text: got {text!r}; expected a str or bytes")
        return cls._of(_toml.compiled(text, name))

    @classmethod
    def from_dict(cls, data: Mapping[str, Any], name: str = "scenario.toml") -> Scenario:
        """The scenario in a nested dict, as TOML has it: {"body": {"moments": [1, 2, 2.5]}, ...}.

        Numbers keep their bits; NumPy arrays and numbers will do. Of `name` as in from_text;
        messages count the lines of the text that the dict is written as.
        """
        if not isinstance(data, Mapping):
            raise TypeError(f"from_dict: got {data!r}; expected a dict")
        return cls.from_text(_toml.text_from(data), name)

    @classmethod
    def build(
        cls,
        system: System | Body,
        state: Any,
        time: SaveAt | tuple[float, float, float] | ArrayLike | None = None,
        method: Adaptive | Collocation | Splitting | VariationOfConstants | None = None,
        *,
        columns: str | Sequence[str] = ("q", "omega"),
        title: str = "",
        units: Units | Mapping[str, str] | None = None,
        events: Sequence[Mapping[str, Any]] = (),
        epoch: str = "",
        axes: str = "inertial",
        damper_rate: ArrayLike = (0.0, 0.0, 0.0),
        orbits: Mapping[str, Any] | None = None,
        name: str = "scenario.toml",
    ) -> Scenario:
        """The scenario of Python objects: a file that anyone runs without Python.

        Parameters
        ----------
        system : System, or a Body that moves freely. Its terms are any but those that are written
            in Python, along orbits and in fields that are not; its frame inertial, precessing or a
            local vertical.
        state : at t = 0, in any chart, or a FreeRotation. A chart that files do not know becomes a
            quaternion and a momentum.
        time : SaveAt, (start, stop, step), or times (N,).
        method : None: exact where nothing acts, otherwise Collocation().
        columns : groups of columns.
        units : of the outputs; a Units, or a dict for it. The numbers of the objects are in its
            units of time, moment and length, and in radians.
        events : tables [[event]]: {"column": "theta", "value": 90, "stops": True}, in these units.
        epoch, axes : of [state].
        damper_rate : (3,), rate at t = 0 of the sphere of the system's damper relative to the body.
        orbits : names of orbits of the terms, such as the `orbits` of another scenario: {"moon":
            orbit}. Others are called orbit-1, orbit-2, ...

        Numbers keep their bits, but for the pole of a TumblerState, which becomes two angles.
        Vectors of the file are along principal axes; the columns q, omega and g along the axes of
        body.q_FB. Rows of tables and facets stand in the file. ValueError for what has no place in
        a file, such as a function in Python, naming it.
        """
        data = _building.data_of(
            system, state, time, method, [columns] if isinstance(columns, str) else columns,
            title=title, units=_units_of(units), events=events, epoch=epoch, axes=axes,
            damper_rate=damper_rate, orbits=orbits or {},
        )
        return cls.from_dict(data, name)

    def to_dict(self) -> dict[str, Any]:
        """The file as a nested dict of plain Python values: from_dict takes it, changed or not."""
        return _toml.data_from(self.text)

    def with_columns(self, columns: str | Sequence[str]) -> Scenario:
        """The same scenario with these groups of columns; its text too, where comments stay."""
        names = [columns] if isinstance(columns, str) else list(columns)
        return self.replace({"output.columns": names})

    def with_ensemble(
        self, vary: Mapping[Any, vary.Distribution] | None = None, **keys: Any
    ) -> Scenario:
        """The same scenario with a table [ensemble], which says what of it is drawn; its text too.

        Parameters
        ----------
        vary : distributions by key, as in Scenario.ensemble; None: those that the scenario has.
            What is given takes the place of all of its tables [[ensemble.vary]].
        keys : those of [ensemble]: size=10000, seed=2, keep="final", draws="sobol", ...; what is
            not given is what the scenario has, fractions and histograms among them.

        ScenarioError for what is no ensemble.
        """
        return Scenario._of(self._file.with_ensemble(ensemble_tables(self._file, vary, keys)))

    def replace(self, changes: Mapping[str, Any] | None = None, **tables: Any) -> Scenario:
        """The same scenario with other values of some keys, as `polhode run --set` makes it.

        Parameters
        ----------
        changes : values by key, with dots and, for tables of an array, an index:
            {"state.tumbler.rotation_period": 100.0, "event.0.value": 45}. None takes a key out. A
            quantity has its unit in the text: "27.38 h".
        tables : the same for keys at the top: title="Other", time={"at": [1, 2, 4]}.

        The text is changed where these keys stand; comments stay. ValueError for a key that can
        have no place, ScenarioError for one that scenarios do not know and for a wrong value.
        """
        if changes is not None and not isinstance(changes, Mapping):
            raise TypeError(f"replace: got {changes!r}; expected a dict of values by key")
        text = self.text
        for key, value in {**(changes or {}), **tables}.items():
            if not isinstance(key, str):
                raise TypeError(f"replace: got a key {key!r}; expected a str")
            toml = "" if value is None else _toml.value_text(value, key)
            text = _core._changed_text(text, key, toml)
        return Scenario.from_text(text, self._file.path)

    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Writes the text to a file, as PATH.part until it is complete.

        Files that it names by relative paths have to lie next to the new file too.

        FileExistsError for a file that is there, unless `overwrite`: it may be written by hand.
        (Results.write and run replace the files that they write.)
        """
        path = os.fsdecode(path)
        if not overwrite and os.path.lexists(path):
            raise FileExistsError(f"{path} is there; overwrite=True replaces it")
        part = f"{path}.part"
        with open(part, "wb") as file:
            file.write(self.text.encode("utf-8"))
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)

    def run(
        self,
        outputs: Path | Iterable[Path] = (),
        events: Path | None = None,
        *,
        keep: bool = True,
        resume: bool = False,
        restart: bool = False,
        progress: Callable[[float], object] | None = None,
    ) -> Results:
        """Every row of the scenario, into memory and into files.

        Parameters
        ----------
        outputs : paths, one or several, whose extensions say the format (.csv, .h5, ...): the files
            that `polhode run` writes, byte for byte. A file is written as PATH.part, and renamed
            when it is complete: it replaces one of that name (save refuses to).
        events : PATH.csv for the events of the scenario; replaces one of that name.
        keep : False: no rows in memory, for runs that only a file can hold.
        resume : continues a run that was stopped or killed, from its PATH.checkpoint: its files
            become those of the run that never was, byte for byte (HDF5: in contents). Without a
            checkpoint it begins anew; where all files are complete nothing is done.
        restart : begins anew where an unfinished run is, which is an error otherwise.
        progress : called with the time reached, some ten times a second; what it raises ends the
            run.

        Returns
        -------
        Results
            Also of a run that could not go on: with its rows so far, an outcome that says what to
            try, and a RuntimeWarning.

        ValueError without [time] and for a path that cannot be an output; OutputError (a
        RuntimeError) when writing fails. Ctrl-C raises KeyboardInterrupt, and leaves
        PATH.part and a checkpoint.
        Releases the GIL.
        """
        paths = _several(outputs, "run")
        _require_files(paths if events is None else [*paths, events])
        done = self._file.run(paths, events, keep, resume, restart, progress)
        results = Results(
            self._file, done.table, done.outcome, done.statistics, done.events,
            done.energy_change, keep, done.end,
        )
        if not done.outcome.ok:
            warnings.warn(_failure(self, done, paths), RuntimeWarning, stacklevel=2)
        return results

    def map(
        self,
        outputs: Path | Iterable[Path] = (),
        *,
        threads: int | None = None,
        executor: Executor | None = None,
        resume: bool = False,
        restart: bool = False,
        any_machine: bool = False,
        progress: Callable[[int, int], object] | None = None,
    ) -> MapResults:
        """Every cell of the grid of [map]: chaos, extremes of a column, or surfaces of section.

        Parameters
        ----------
        outputs : PATH.csv or PATH.h5, one or several: the files that `polhode map` writes, byte for
            byte. As those of run they are PATH.part until they are complete, with a checkpoint.
        threads : how many cells at a time; None: one on each processor. The result does not depend
            on it.
        executor : a concurrent.futures.Executor that computes the cells instead of these threads,
            as in Scenario.ensemble. The result is that of threads, to the last bit.
        resume : continues a map that was stopped or killed, from its PATH.checkpoint; begins anew
            without one, also where the map is complete.
        restart : begins anew where an unfinished map is, which is an error otherwise.
        any_machine : whether workers may work together, or a map go on, on machines whose sines and
            logarithms differ in last digits: so does the result.
        progress : called with the number of cells so far and that of all, after each; what it
            raises ends the map.

        Returns
        -------
        MapResults
            Its columns. Cells that could not be, or could not go on, hold NaN; `.failures` says
            why.

        ValueError for a scenario without [map], for a path that cannot be an output or that another
        map is writing, and for an unfinished map without resume or restart; OutputError
        when writing fails; RuntimeError for a worker that dies or fails, after which the cells so
        far are in the checkpoint. Cells release the GIL; Ctrl-C raises KeyboardInterrupt, and
        leaves PATH.part and a checkpoint.
        """
        paths = _several(outputs, "map")
        _require_files(paths, "map")
        if threads is not None and threads < 1:
            raise ValueError(f"map: threads: got {threads!r}; expected a whole number from 1")
        if threads is not None and executor is not None:
            raise ValueError("map: got threads and an executor; expected one of them")
        if resume and not paths:
            raise ValueError("map: got resume=True; expected it with outputs")
        return run_map(
            MapResults, self._file, paths, threads, executor, resume, restart, any_machine,
            progress,
        )

    def ensemble(
        self,
        outputs: Path | Iterable[Path] = (),
        *,
        vary: Mapping[Any, vary.Distribution] | None = None,
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
        """A Monte Carlo ensemble: many runs of this scenario with some of its numbers drawn.

        The same numbers as `polhode ensemble` gives of the same file, to the last bit, for any
        number of threads and whoever computes them.

        Parameters
        ----------
        outputs : PATH.csv or PATH.h5, one or several: the files that `polhode ensemble` writes,
            byte for byte. As those of run they are PATH.part until they are complete, with a
            checkpoint. With {chunk} in the name of the one output, each chunk of "final" or "rows"
            goes into a file of its own, written by whoever computes it, on a disk that all share;
            what comes back is their index.
        vary : what is drawn, by key: {"body.moments[0]": polhode.vary.uniform(0.60, 0.63)}. Several
            keys that are drawn together stand in a tuple, and an array by its name. It replaces all
            tables [[ensemble.vary]]; the rest of [ensemble] stays. None: as [ensemble] says.
        size : how many members.
        seed : another one draws other members.
        keep : "statistics" of the members at each time, memory not growing with them; "final", what
            was drawn and the last row of each member; "rows", all rows of all.
        quantiles : which ones statistics have, from 0 to 1.
        threads : how many members at a time; None: one on each processor. The result does not
            depend on it.
        executor : a concurrent.futures.Executor in place of these threads: ProcessPoolExecutor,
            MPIPoolExecutor of mpi4py.futures, client.get_executor() of Dask. Each worker makes the
            ensemble from the text of the scenario once, and computes chunks of members; files that
            it names must be there for the workers too. The result is that of threads, to the last
            bit.
        resume : continues an ensemble that was stopped or killed, from its PATH.checkpoint, which
            is written every 5 seconds; begins anew without one. Of one that is complete the files
            are read.
        restart : begins anew where an unfinished ensemble is, which is an error otherwise.
        any_machine : whether workers may work together, or an ensemble go on, on machines whose
            sines and logarithms differ in last digits: so does the result.
        progress : called with the number of members so far and that of all, after each chunk of
            them; what it raises ends the ensemble.
        others : further keys of the table [ensemble], such as draws="sobol". What is None is as the
            scenario says, or its default.

        Returns
        -------
        EnsembleResults
            A mapping of columns: statistics of the members, their last rows or all of their rows.
            Members that could not be made, or could not go on, are left out; `.failures` has the
            reasons. `.member(k)` is the scenario of one, `.scenario` that of the ensemble.

        ScenarioError for a scenario without [ensemble], for a key that does not exist or cannot
        vary and for what is no distribution; ValueError for a path that cannot be an
        output or that another ensemble is writing, and for an unfinished ensemble without resume or
        restart; MemoryError for rows that do not fit; OutputError when writing fails; RuntimeError
        for a worker that dies or fails, after which what was done is in the checkpoint, and where
        all members fail, with the first reasons: then the outputs stay PATH.part. Members
        release the GIL; Ctrl-C raises KeyboardInterrupt, and leaves PATH.part and a checkpoint.
        """
        paths = _several(outputs, "ensemble")
        _require_files(paths, "ensemble")
        if threads is not None and threads < 1:
            raise ValueError(f"ensemble: threads: got {threads!r}; expected a whole number from 1")
        if threads is not None and executor is not None:
            raise ValueError("ensemble: got threads and an executor; expected one of them")
        keys = {"size": size, "seed": seed, "keep": keep, "quantiles": quantiles, **others}
        of = self
        if vary is not None or any(value is not None for value in keys.values()):
            of = self.with_ensemble(vary, **keys)
        return run_ensemble(
            EnsembleResults, of._file, paths, threads, executor, resume, restart, any_machine,
            progress,
        )

    @property
    def text(self) -> str:
        """The file itself."""
        return self._file.text

    @property
    def name(self) -> str:
        """Of the file, without its folder."""
        return self._file.name

    @property
    def title(self) -> str:
        """One line that outputs carry along; may be empty."""
        return self._file.title

    @property
    def units(self) -> Units:
        """What bare numbers of the file and of its results mean."""
        return self._file.units

    @property
    def body(self) -> Body:
        """The rigid body."""
        return self._file.body

    @property
    def chart(self) -> str:
        """The chart of [state]: "tumbler", "attitude-rate", "euler", "andoyer", "serret", ..."""
        return self._file.chart

    @property
    def state(self) -> Any:
        """The state as the file gives it, one of the charts; of attitude-rate the RotorState."""
        return self._file.state

    @property
    def epoch(self) -> str:
        """The date of t = 0 with its scale, or nothing."""
        return self._file.epoch

    @property
    def axes(self) -> str:
        """The inertial axes: "inertial", "ecliptic-J2000" or "equator-J2000"."""
        return self._file.axes

    @property
    def frame(self) -> Frame:
        """The reference frame."""
        return self._file.frame

    @property
    def orbits(
        self,
    ) -> dict[str, KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit]:
        """The orbits by name."""
        return self._file.orbits

    @property
    def system(self) -> System:
        """Body, frame and terms."""
        return self._file.system

    @property
    def initial_state(self) -> RotorState[float]:
        """The state at t = 0 in the reference frame, along principal axes."""
        return self._file.initial_state

    @property
    def damper_rate(self) -> NDArray[Any]:
        """(3,): at t = 0, rate of the system's damper relative to the body, principal axes."""
        return self._file.damper_rate

    @property
    def free_rotation(self) -> FreeRotation:
        """The exact motion through the state at t = 0, were nothing acting on it."""
        return self._file.free_rotation

    @property
    def method(self) -> Adaptive | Collocation | Splitting | VariationOfConstants | None:
        """Adaptive, Collocation, Splitting or VariationOfConstants; None: exact free rotation."""
        return self._file.method

    @property
    def propagation(self) -> str:
        """How a run goes, in words."""
        return self._file.propagation

    @property
    def time(self) -> SaveAt | None:
        """When rows are written; None: nothing to run."""
        return self._file.time

    @property
    def columns(self) -> tuple[str, ...]:
        """The groups of columns that results hold, t apart."""
        return tuple(self._file.columns)

    @property
    def summary(self) -> Summary:
        """What the body does: mode, periods, momentum, energy, ...; the lines of `polhode info`."""
        return Summary(self._file.summary)

    @property
    def citations(self) -> list[Citation]:
        """The papers that this scenario rests on, in the order of their weight."""
        return [Citation(*fields) for fields in self._file.citations]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scenario):
            return NotImplemented
        return self.text == other.text and self.name == other.name

    def __hash__(self) -> int:
        return hash((self.text, self.name))

    def __reduce__(self) -> tuple[object, ...]:
        return Scenario.from_text, (self.text, self.name)

    def __repr__(self) -> str:
        time = self.time
        rows = "" if time is None else f"; {len(time)} rows of {', '.join(('t', *self.columns))}"
        title = f" \"{self.title}\"" if self.title else ""
        return f"<Scenario {self.name}{title}: state.{self.chart}; {self.propagation}{rows}>"

    def _repr_html_(self) -> str:
        return self.summary._repr_html_()


class Results(RunColumns):
    """The rows of a scenario: `results["theta"]` is a column, a read-only view without a copy.

    Columns are named and have the units as in the files of `polhode run`, t first; `results.groups`
    has those that belong together as one array. Made by `Scenario.run`. `results["date"]` holds
    texts, which numpy.asarray(..., "datetime64[us]") turns into times.
    """

    @property
    def scenario(self) -> Scenario:
        """What was run."""
        return Scenario._of(self._file)

    def plot(self, columns: str | Sequence[str] = ()) -> Any:
        """The run at a glance: momentum, Euler angles and angular velocity.

        Parameters
        ----------
        columns : names of columns to draw; none: the overview.

        Returns
        -------
        Axes of Matplotlib, or an array of them, as of polhode.figures.plot. ImportError without
        Matplotlib.
        """
        return plotted(self, columns)


class MapResults(MapColumns):
    """The rows of a map: `results["mean_megno"]` is a column, a read-only view without a copy.

    Columns are named and have the units as in the files of `polhode map`: the axes, then the
    results. Made by `Scenario.map`; figures.chaos_map and figures.poincare_section draw them.
    """

    @property
    def scenario(self) -> Scenario:
        """What was run."""
        return Scenario._of(self._file)

    def cell_scenario(self, index: int) -> Scenario:
        """The scenario of one cell (the first is 0), as `polhode map --cell` prints it. ValueError
        for another index, or if the numbers of the cell are rejected."""
        return Scenario._of(self._file.map_cell(index))

    def plot(self, columns: str | Sequence[str] = ()) -> Any:
        """The map as colours, or the points of its sections.

        Parameters
        ----------
        columns : names of columns to draw; none: what suits the map.

        Returns
        -------
        Axes of Matplotlib, or an array of them, as of polhode.figures.plot. ImportError without
        Matplotlib.
        """
        return plotted(self, columns)


class EnsembleResults(EnsembleColumns):
    """What an ensemble keeps: `results["P_short_mean"]` is a column, a view without a copy.

    Columns are named and have the units as in the files of `polhode ensemble`. By `keep` a row is a
    time ("statistics"), a member with what was drawn and its last row ("final"), one row of a
    member ("rows"), or a chunk whose rows are in a file of its own ("chunks"). Made by
    Scenario.ensemble, or read from a file.
    """

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> EnsembleResults:
        """What `polhode ensemble` or a call from Python wrote into a file, CSV or HDF5.

        Of files of chunks, one of them or their index. HDF5 needs the package h5py. A file that is
        not complete yet, PATH.part, has what is done.
        OSError for a file that cannot be read, ValueError for one that is not of an ensemble.
        """
        return read_ensemble(cls, path)

    @property
    def scenario(self) -> Scenario:
        """What was run, with its table [ensemble]; of a file, the scenario inside."""
        return Scenario._of(self._file)

    def member(self, index: int) -> Scenario:
        """The scenario of one member, from 0 on: what `polhode ensemble --member` prints. Its run
        gives the numbers that the ensemble had, to the last bit. ValueError for another index."""
        return Scenario._of(self._ensemble().member(index))

    def plot(self, columns: str | Sequence[str] = ()) -> Any:
        """Quantiles against time, or members over the numbers drawn.

        Parameters
        ----------
        columns : names of columns to draw; none: what suits its `keep`.

        Returns
        -------
        Axes of Matplotlib, or an array of them, as of polhode.figures.plot. ImportError without
        Matplotlib.
        """
        return plotted(self, columns)


def _units_of(units: Units | Mapping[str, str] | None) -> Units:
    if isinstance(units, _core.Units):
        return units
    kinds = ("time", "angle", "moment", "length")
    given = {} if units is None else units
    if not isinstance(given, Mapping) or not set(given) <= set(kinds):
        raise TypeError(f"build: units: got {units!r}; expected Units or a dict of {kinds}")
    return _core.Units(**given)


def _several(outputs: Any, function: str) -> list[Path]:
    if isinstance(outputs, (str, bytes, os.PathLike)):
        return [outputs]
    if not isinstance(outputs, Iterable):
        raise TypeError(f"{function}: outputs: got {outputs!r}; expected a path or several")
    return list(outputs)


def _require_files(paths: Sequence[Path], function: str = "run") -> None:
    seen = set()
    for path in paths:
        name = os.fsdecode(path)
        if name == "-":
            raise ValueError(f"{function}: got \"-\"; expected files, {_core._readable_paths()}")
        if name in seen:
            raise ValueError(f"{function}: {name} is named twice")
        seen.add(name)


def _failure(scenario: Scenario, done: Any, paths: Sequence[Path]) -> str:
    outcome = done.outcome
    parts = ", ".join(f"{os.fsdecode(path)}.part" for path in paths)
    return (
        f"{scenario.name}: the run failed at t = {outcome.t!r} {scenario.units.time}: "
        f"{outcome.advice}; rows so far: {done.rows}" + (f", in {parts}" if parts else "")
    )
