# SPDX-License-Identifier: MIT
"""Satellites of the Earth from two-line elements (TLE) and orbit mean-elements messages (OMM).

SGP4 (the package `sgp4`: pip install 'polhode[satellites]') propagates them; what comes out are
tables of positions and velocities along equator and equinox of J2000, as orbits or as files that a
scenario reads.
"""

from __future__ import annotations

import csv
import gzip
import io
import math
import os
import pathlib
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import ArrayLike, NDArray

from polhode._core import (
    Date,
    TableOrbit,
    _number,
    _numbers,
    date_after,
    j2000_from_teme,
    seconds_between,
)

__all__ = ["Satellite", "satellite_from_omm", "satellite_from_tle"]

_SPACING = 60.0  # s: order 10 leaves micrometres in a low orbit
_LEAST_ROWS = 12
_FAR = 30 * 86400.0  # s from the epoch of elements: kilometres, and soon hundreds of them


@dataclass(frozen=True)
class Satellite:
    """A satellite with mean elements of SGP4.

    name : as its elements give it, or its number.
    epoch : of the elements, a Date in UTC.
    elements : the `sgp4.api.Satrec` that propagates it.
    """

    name: str
    epoch: Date
    elements: Any = field(repr=False, compare=False)

    def states(
        self, epoch: Date | str, times: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Positions (N, 3) in km and velocities (N, 3) in km/s at times (N,) in s after `epoch`.

        Along equator and equinox of J2000. ValueError where SGP4 gives up: the satellite has
        decayed, or the time is too far from its elements. A UserWarning for times more than 30
        days from the elements, which do not hold that long.

        epoch : a Date, or a text such as the `epoch` of a scenario.
        """
        epoch = _date(epoch)
        t = _numbers(times, "times")
        if t.ndim != 1:
            raise ValueError("states: expected times of one dimension")
        self._warn_of_age(epoch, t)
        x, v = np.empty((len(t), 3)), np.empty((len(t), 3))
        for k, after in enumerate(t):
            date = date_after(epoch, float(after))
            # elapsed time, so that a leap second since the elements is a second
            minutes = seconds_between(self.epoch, date) / 60
            code, position, velocity = self.elements.sgp4_tsince(minutes)
            if code:
                raise ValueError(f"{self.name}: SGP4 has no position {after:g} s after the epoch: "
                                 f"{_reason(code)}")  # fmt: skip
            turn = j2000_from_teme(date)
            x[k], v[k] = turn @ position, turn @ velocity
        return x, v

    def orbit(
        self, epoch: Date | str, first: float, last: float, spacing: float = _SPACING
    ) -> TableOrbit:
        """A TableOrbit (km) from `first` to `last`, s after `epoch`, with a row every `spacing`.

        Through positions alone: the velocities of SGP4 are not their derivatives to 1 m/s.
        """
        t = _times(first, last, spacing)
        return TableOrbit(t, self.states(epoch, t)[0])

    def write(
        self,
        path: str | PathLike[str],
        epoch: Date | str,
        first: float,
        last: float,
        spacing: float = _SPACING,
    ) -> None:
        """Writes a table that a scenario reads as kind "table" (.gz where the name ends so).

        Its columns are t (s after `epoch`, which is to be `state.epoch`), x, y, z (km) in axes
        "equator-J2000"; its first line says so, and a scenario of another epoch, other axes or
        other units refuses it.
        """
        epoch = _date(epoch)
        t = _times(first, last, spacing)
        header = f"{self.name}, SGP4; t in s after {_text(epoch)}; km; equator-J2000\nt,x,y,z"
        rows = np.column_stack([t, self.states(epoch, t)[0]])
        final = os.fsdecode(path)
        part = final + ".part"
        opened = gzip.open if final.endswith(".gz") else open
        with opened(part, "wt", encoding="utf-8") as file:
            np.savetxt(file, rows, "%.17g", ",", header=header)
        os.replace(part, final)

    def _warn_of_age(self, epoch: Date, t: NDArray[np.float64]) -> None:
        if not len(t):
            return
        begin = seconds_between(self.epoch, epoch)
        far = max(abs(begin + t.min()), abs(begin + t.max()))
        if far > _FAR:
            warnings.warn(
                f"{self.name}: {far / 86400:.0f} d from its elements, of {_text(self.epoch)}",
                UserWarning,
                stacklevel=3,
            )


def satellite_from_tle(line1: str, line2: str, name: str | None = None) -> Satellite:
    """The satellite of two lines of elements.

    ValueError for lines that are not element sets, or whose checksum is wrong: it names the
    line and both digits.
    """
    lines = [line1.rstrip(), line2.rstrip()]
    for number, line in enumerate(lines, 1):
        _check_line(number, line)
    if lines[0][2:7] != lines[1][2:7]:
        raise ValueError(f"line 2: of satellite {lines[1][2:7]}; line 1 is of {lines[0][2:7]}")
    from_lines = _sgp4().Satrec.twoline2rv(*lines)
    return _satellite(from_lines, name or lines[0][2:7].strip())


def satellite_from_omm(message: str | PathLike[str] | Mapping[str, Any]) -> Satellite:
    """The satellite of an OMM: its fields, a CSV or XML text, or the path of such a file.

    A CSV holds the names in its first line and one message in its second. ValueError for fields
    that are missing or are no numbers.
    """
    fields = dict(message) if isinstance(message, Mapping) else _omm_fields(message)
    api = _sgp4()
    from sgp4 import omm

    satrec = api.Satrec()
    try:
        omm.initialize(satrec, {key: str(value) for key, value in fields.items()})
    except KeyError as missing:
        raise ValueError(f"OMM: the field {missing.args[0]} is missing") from None
    except ValueError as wrong:
        raise ValueError(f"OMM: {wrong}") from None
    return _satellite(satrec, str(fields.get("OBJECT_NAME") or satrec.satnum))


def _sgp4() -> Any:
    try:
        from sgp4 import api
    except ImportError:
        raise ImportError(
            "polhode.satellites needs sgp4: pip install 'polhode[satellites]'"
        ) from None
    return api


def _check_line(number: int, line: str) -> None:
    if len(line) != 69 or not line.isascii():
        raise ValueError(f"line {number}: has {len(line)} characters; expected 69")
    if line[0] != str(number) or line[1] != " ":
        raise ValueError(f'line {number}: begins with "{line[:2]}"; expected "{number} "')
    digits = sum(int(c) for c in line[:68] if c.isdigit()) + line[:68].count("-")
    if line[68] != str(digits % 10):
        raise ValueError(f"line {number}: its checksum is {line[68]}; its characters give "
                         f"{digits % 10}")  # fmt: skip


def _omm_fields(source: str | PathLike[str]) -> dict[str, str]:
    text = source if isinstance(source, str) and ("\n" in source or "<" in source) else None
    if text is None:
        text = pathlib.Path(source).read_text(encoding="utf-8")
    if text.lstrip().startswith("<"):
        try:
            root = ElementTree.fromstring(text)
        except ElementTree.ParseError as wrong:
            raise ValueError(f"OMM: not XML: {wrong}") from None
        return {node.tag: (node.text or "").strip() for node in root.iter() if not len(node)}
    rows = list(csv.DictReader(io.StringIO(text)))
    if len(rows) != 1:
        raise ValueError(f"OMM: {len(rows)} messages; expected one line below the names")
    return rows[0]


def _satellite(satrec: Any, name: str) -> Satellite:
    if satrec.error:
        raise ValueError(f"{name}: {_reason(satrec.error)}")
    return Satellite(name, Date("UTC", satrec.jdsatepoch, satrec.jdsatepochF), satrec)


def _reason(code: int) -> str:
    from sgp4.api import SGP4_ERRORS

    return SGP4_ERRORS.get(code, f"error {code}")


def _date(epoch: Date | str) -> Date:
    return Date(epoch) if isinstance(epoch, str) else epoch


def _text(date: Date) -> str:
    """As the epoch of a scenario, to a millisecond."""
    # cut after half a millisecond more, not rounded: 59.9996 s are no 60.000 s of that minute
    later = date_after(date, 0.0005).to(date.scale)
    year, month, day, hour, minute, second = later.calendar
    cut = math.floor(second * 1000.0) / 1000.0
    whole = f"{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{cut:06.3f}"
    return f"{whole} {date.scale.name}"


def _times(first: float, last: float, spacing: float) -> NDArray[np.float64]:
    first, last = _number(first, "first"), _number(last, "last")
    spacing = _number(spacing, "spacing")
    if not (first < last and spacing > 0):
        raise ValueError("expected first < last and a positive spacing")
    count = max(math.ceil((last - first) / spacing) + 1, _LEAST_ROWS)
    return np.linspace(first, last, count)
