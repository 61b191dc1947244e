# SPDX-License-Identifier: MIT
"""Tables that polhode wrote, read back: CSV by itself, HDF5 with h5py."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from typing import Any

import numpy

from polhode import _toml
from polhode._tables import imported

Groups = list[tuple[str, list[tuple[str, str]]]]  # [(group, [(column, unit), ...]), ...]
_FIRST = ("member", "t", "members")  # of files that do not say the order of their groups


@dataclass(frozen=True)
class OutputFile:
    """The rows of a file, and what it says of where they are from."""

    path: str
    groups: Groups
    table: Any
    texts: dict[str, Any]
    """Columns that are no numbers, dates; their numbers are NaN."""
    title: str
    notes: list[str]
    scenario: str
    scenario_name: str
    failed: list[str]
    """What it says of members that failed: how many, then "member 7: why" of the first."""

    @property
    def kind(self) -> str:
        """The command that wrote it: "run", "map" or "ensemble"."""
        if any(re.match(r"ensemble: \d+ members", note) for note in self.notes):
            return "ensemble"
        # the first columns of a map are keys of its scenario
        return "map" if self.scenario and "." in self.groups[0][0] else "run"

    @property
    def columns(self) -> dict[str, Any]:
        names = [name for _, columns in self.groups for name, _ in columns]
        return {**dict(zip(names, self.table.T)), **self.texts}

    @property
    def units(self) -> dict[str, str]:
        return {name: unit for _, columns in self.groups for name, unit in columns}

    @property
    def failures(self) -> list[tuple[int, str]] | None:
        """(member, why); None where it does not say."""
        found = [re.fullmatch(r"member (\d+): (.*)", line, re.DOTALL) for line in self.failed]
        return [(int(match[1]), match[2]) for match in found if match] if found else None


def read_output(path: str | os.PathLike[str]) -> OutputFile:
    """OSError for what cannot be read, ValueError for what is no table."""
    name = os.fsdecode(path)
    with open(name, "rb") as file:
        is_hdf5 = file.read(8) == b"\x89HDF\r\n\x1a\n"
    found = _read_hdf5(name) if is_hdf5 else _read_csv(name)
    if not found.groups:
        raise ValueError(f"{name}: no columns; expected a table that polhode wrote")
    return found


def read_ensemble_file(path: str | os.PathLike[str]) -> OutputFile:
    """ValueError for what is no file of an ensemble."""
    found = read_output(path)
    if found.kind != "ensemble":
        raise ValueError(
            f"{found.path}: no file of an ensemble; expected what polhode ensemble wrote"
        )
    return found


def chunk_files(index: str, chunks: Any, last: int) -> list[str]:
    """The files of these chunks, of `last` + 1, beside their index: it has "index" where they have
    their number. OSError where there are none."""
    path, digits = index.removesuffix(".part"), len(str(last))
    for place in reversed([found.start() for found in re.finditer("index", path)]):
        files = [f"{path[:place]}{int(k):0{digits}}{path[place + 5 :]}" for k in chunks]
        if all(map(os.path.exists, files[:1])):
            return files
    raise FileNotFoundError(f"{index}: the files of chunks are not beside it")


def _read_hdf5(path: str) -> OutputFile:
    h5py = imported("h5py", "reading an HDF5 file")
    try:
        opened = h5py.File(path)
    except OSError as error:  # h5py does not name the file
        raise OSError(f"{path}: {error}") from error
    with opened as file:
        said = {name: file.attrs[name] for name in file.attrs}
        groups, parts, texts = [], [], {}
        first = [g for g in map(str, file.attrs.get("groups", _FIRST)) if g in file]
        for group in [*first, *(g for g in file if g not in first)]:
            data = file[group]
            if not _is_group_of_columns(data):
                continue  # the names of the columns of a group, or what others wrote
            columns = [str(name) for name in data.attrs["columns"]]
            groups.append((group, list(zip(columns, map(str, data.attrs["units"])))))
            if data.dtype.kind == "f":
                parts.append(data[()].reshape(len(data), len(columns)))
                continue
            shown = data.asstr()[()].reshape(len(data), len(columns))
            texts.update((column, shown[:, k].astype("<U26")) for k, column in enumerate(columns))
            parts.append(numpy.full(shown.shape, numpy.nan))
    if not groups:
        raise ValueError(f"{path}: no columns; expected a table that polhode wrote")
    return OutputFile(
        path, groups, numpy.hstack(parts), texts, str(said.get("title", "")),
        [str(note) for note in said.get("notes", ())], str(said.get("scenario", "")),
        str(said.get("scenario_name", "")), [str(line) for line in said.get("failed", ())],
    )


def _is_group_of_columns(data: Any) -> bool:
    """Whether it is a table of numbers or texts whose attributes name its columns."""
    import h5py

    if not {"columns", "units"} <= set(data.attrs) or getattr(data, "ndim", 0) < 1:
        return False
    is_known = data.dtype.kind == "f" or h5py.check_string_dtype(data.dtype) is not None
    return is_known and data.size == len(data) * len(data.attrs["columns"])


def _read_csv(path: str) -> OutputFile:
    with open(path, encoding="utf-8-sig") as file:
        try:
            lines = file.read().splitlines()
        except UnicodeDecodeError as error:
            raise ValueError(f"{path}: no text in UTF-8; expected CSV or HDF5") from error
    head = [line[2:] for line in lines if line.startswith("#")]
    scenario = [line[2:] for line in head if line.startswith("|")]
    said = [line for line in head if not line.startswith("|")]
    places = [k for k, line in enumerate(lines, 1) if not line.startswith("#")]
    rows = [lines[k - 1] for k in places]
    names = rows[0].split(",") if rows else []
    units = dict(re.findall(r"(\S+) \[([^][]*)\](?:, |$)", _said(said, "units: ")))
    for k, row in zip(places, rows):
        if row.count(",") + 1 != len(names):
            raise ValueError(f'{path}:{k}: got the row "{row[:60]}"; expected {len(names)} '
                             "numbers, as in the line of names")  # fmt: skip
    table, texts = _numbers(rows[1:], names)
    text = "\n".join(scenario) + "\n" * bool(scenario)
    return OutputFile(
        path, [(name, [(name, units.get(name, "1"))]) for name in names], table, texts,
        str(_toml.data_from(text).get("title", "")), said, text, _said(said, "scenario: "),
        [line[len("failed: ") :] for line in said if line.startswith("failed: ")],
    )


def _said(lines: list[str], begin: str) -> str:
    return next((line[len(begin) :] for line in lines if line.startswith(begin)), "")


def _numbers(rows: list[str], names: list[str]) -> tuple[Any, dict[str, Any]]:
    """A table, and the columns that are texts."""
    if not rows:
        return numpy.empty((0, len(names))), {}
    try:
        return numpy.loadtxt(rows, delimiter=",", ndmin=2), {}
    except ValueError:  # a column of dates
        cells = [row.split(",") for row in rows]
    columns, texts = [], {}
    for k, name in enumerate(names):
        try:
            columns.append(numpy.array([float(row[k]) for row in cells]))
        except ValueError:
            texts[name] = numpy.array([row[k] for row in cells], dtype="<U26")
            columns.append(numpy.full(len(cells), numpy.nan))
    return numpy.column_stack(columns), texts
