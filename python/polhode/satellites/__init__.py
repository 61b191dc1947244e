# SPDX-License-Identifier: MIT
"""Satellites of the Earth from two-line elements (TLE) and orbit mean-elements messages (OMM).

Days of elements have 86,400 s, also those that end in a leap second, which therefore has no name.

SGP4 (the package `sgp4`: pip install 'polhode[satellites]') propagates them; what comes out are
tables of positions and velocities along equator and equinox of J2000, as orbits or as files that a
scenario reads. As a command:

    python -m polhode.satellites iss.tle --from 2026-05-01T00:00:00Z --to 2026-05-02T00:00:00Z \\
        --out iss.csv
"""

from __future__ import annotations

import calendar
import datetime
import gzip
import math
import os
import pathlib
import re
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode._core import (
    Date,
    SatellitePath,
    SatelliteState,
    SatelliteSystem,
    SecularRates,
    TableOrbit,
    _number,
    _numbers,
    date_after,
    j2_rates,
    j2000_from_teme,
    mean_elements,
    mean_motion,
    pericentre_distance,
    satellite_path,
    satellite_rates,
    seconds_between,
    semi_major_axis,
)
from polhode._signatures import publish
from polhode.satellites import _omm

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Satellite",
    "SatellitePath",
    "SatelliteState",
    "SatelliteSystem",
    "SecularRates",
    "j2_rates",
    "mean_elements",
    "mean_motion",
    "pericentre_distance",
    "satellite_from_omm",
    "satellite_from_tle",
    "satellite_path",
    "satellite_rates",
    "satellites_from_file",
    "satellites_from_text",
    "semi_major_axis",
]

# s. The spacing is the longest of these that leaves so many rows in a turn at the rate of the
# perigee: order 12 then leaves less than a centimetre.
_SPACINGS = (10.0, 15.0, 20.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0)
_ROWS_A_TURN = 80
_LEAST_ROWS = 12
_LONGEST_NAME = 24  # characters, in a line above elements
_NO_LINE_1 = (
    'expected line 1 of the elements of "{}", 69 characters that begin with "1 "; got "{}"'
)
_FAR = 30 * 86400.0  # s from the epoch of elements: kilometres, and soon hundreds of them
# Central differences of order 8, of rows at -4 to 4 steps, each a sixth of a spacing
_SLOPE = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
_SLOPE_STEPS = 6


@dataclass(frozen=True)
class Satellite:
    """A satellite with mean elements of SGP4.

    name : as its elements give it, or its number.
    epoch : of the elements, a Date in UTC.
    elements : the `sgp4.api.Satrec` that propagates it.
    number : its catalogue number, of up to nine digits.
    """

    name: str
    epoch: Date
    elements: Any = field(repr=False, compare=False)
    number: str = ""

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

    @property
    def spacing(self) -> float:
        """Seconds between the rows of a table of it, if nothing else is asked for."""
        e = float(self.elements.ecco)
        rate = float(self.elements.no_kozai) / 60 * math.sqrt(1 + e) / (1 - e) ** 1.5
        most = 2 * math.pi / rate / _ROWS_A_TURN
        return max((one for one in _SPACINGS if one <= most), default=_SPACINGS[0])

    def _age(self, epoch: Date | str, first: float, last: float) -> float:
        """The most seconds between its elements and `first` to `last`, s after `epoch`."""
        begin = seconds_between(self.epoch, _date(epoch))
        return max(abs(begin + _number(first, "first")), abs(begin + _number(last, "last")))

    def _distance(self, epoch: Date | str, first: float, last: float) -> float:
        """The seconds from its elements to the interval: 0 inside of it."""
        begin = seconds_between(self.epoch, _date(epoch))
        return max(begin + min(first, last), -begin - max(first, last), 0.0)

    def orbit(
        self, epoch: Date | str, first: float, last: float, spacing: float | None = None
    ) -> TableOrbit:
        """A TableOrbit (km) from `first` to `last`, s after `epoch`, with a row every `spacing`.

        spacing : s; left out, 60 in a low orbit and up to 900 in a high one.

        Its velocities are the derivatives of the positions, by differences. Those that SGP4 gives
        are not, to 1 m/s.
        """
        t = _times(first, last, self.spacing if spacing is None else spacing)
        x, v = self._rows(_date(epoch), t)
        return TableOrbit(t, x, v)

    def write(
        self,
        path: str | PathLike[str],
        epoch: Date | str,
        first: float,
        last: float,
        spacing: float | None = None,
    ) -> int:
        """Writes a table that a scenario reads as kind "table" (.gz where the name ends so).

        Its columns are t (s after `epoch`, which is to be `state.epoch`), x, y, z (km) and vx, vy,
        vz (km/s, as those of `orbit`) along axes "equator-J2000"; lines at its top say so, and a
        scenario of another epoch, other axes or other units refuses it. Returns how many rows.
        """
        epoch = _date(epoch)
        t = _times(first, last, self.spacing if spacing is None else spacing)
        x, v = self._rows(epoch, t)
        rows = np.column_stack([t, x, v])
        final = os.fsdecode(path)
        part = final + ".part"
        opened = gzip.open if final.endswith(".gz") else open
        with opened(part, "wt", encoding="utf-8") as file:
            np.savetxt(file, rows, "%.17g", ",", header=self._header(epoch), comments="")
        os.replace(part, final)
        return len(rows)

    def _header(self, epoch: Date) -> str:
        # "; " separates what a reader of the table looks at
        name = self.name.encode("ascii", "replace").decode().replace(";", ",")
        columns = ["t", "x", "y", "z", "vx", "vy", "vz"]
        units = ["s", *["km"] * 3, *["km/s"] * 3]
        pairs = ", ".join(f"{name} [{unit}]" for name, unit in zip(columns, units, strict=True))
        return "\n".join([
            f"# satellite {name}, by SGP4 from elements of {_text(self.epoch)}",
            f"# t counts from {_text(epoch)}; seconds are those of TT; axes: equator-J2000",
            f"# units: {pairs}",
            ",".join(columns),
        ])  # fmt: skip

    def _rows(
        self, epoch: Date, t: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Positions, and their derivatives."""
        step = self.spacing / _SLOPE_STEPS
        around = t[:, None] + step * np.arange(-4, 5)
        x = self.states(epoch, around.ravel())[0].reshape(len(t), 9, 3)
        return x[:, 4], np.einsum("k,nkc->nc", _SLOPE, x) / step

    def _warn_of_age(self, epoch: Date, t: NDArray[np.float64]) -> None:
        if not len(t):
            return
        far = self._age(epoch, float(t.min()), float(t.max()))
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
        _check_fields(number, line)
    if lines[0][2:7] != lines[1][2:7]:
        raise ValueError(f"line 2: of satellite {lines[1][2:7]}; line 1 is of {lines[0][2:7]}")
    satrec = _sgp4().Satrec.twoline2rv(*lines)
    # SGP4 counts 86,400 s a day; a Date stretches a day that ends in a leap second
    midnight, fraction = satrec.jdsatepoch, satrec.jdsatepochF
    length = round(seconds_between(Date("UTC", midnight), Date("UTC", midnight + 1.0)))
    if length != 86400:
        fraction *= 86400 / length
    epoch = Date("UTC", midnight, fraction)
    return _satellite(satrec, epoch, name or lines[0][2:7].strip(), str(satrec.satnum))


def satellites_from_file(path: str | PathLike[str]) -> list[Satellite]:
    """The satellites of a file (.gz or not): two-line elements, each below a line with its name or
    not, or OMM in XML, JSON, CSV or KEYWORD = value notation, one or several.

    ValueError, with the line or the message of the file, for what is no elements.
    """
    return satellites_from_text(_text_of_file(path), os.fsdecode(path))


def _text_of_file(path: str | PathLike[str]) -> str:
    file = os.fsdecode(path)
    data = pathlib.Path(file).read_bytes()
    return (gzip.decompress(data) if file.endswith(".gz") else data).decode("utf-8")


def satellites_from_text(text: str, source: str = "text") -> list[Satellite]:
    """The same from a text; `source` stands for it in messages."""
    text = text.removeprefix("\ufeff")
    try:
        found = _omm.messages(text)
    except ValueError as wrong:
        raise ValueError(f"{source}: {wrong}") from None
    if found is None:
        return _satellites_of_lines(text, source)
    if not found:
        raise ValueError(f"{source}: holds 0 messages; expected one OMM or more")
    satellites = []
    for k, fields in enumerate(found, 1):
        try:
            satellites.append(_satellite_of_fields(fields))
        except ValueError as wrong:
            name = fields.get("OBJECT_NAME") or fields.get("NORAD_CAT_ID") or "no name"
            place = f"message {k} ({_printable(name)}): " if len(found) > 1 else ""
            raise ValueError(f"{source}: {place}{wrong}") from None
    return satellites


def _satellites_of_lines(text: str, source: str) -> list[Satellite]:
    found, name, line1, number1, number = [], None, None, 0, 0
    for number, line in enumerate(text.splitlines(), 1):
        line = line.rstrip()
        if not line or line.startswith("#"):
            continue
        place = f"{source}:{number}: "
        is_element = line[:2] in ("1 ", "2 ") and len(line) > _LONGEST_NAME
        if line1 is not None:
            if not (is_element and line[0] == "2"):
                raise ValueError(f'{place}expected line 2 of the elements of line {number1}, which '
                                 f'begins with "2 "; got "{_printable(line)}"')  # fmt: skip
            try:
                found.append(satellite_from_tle(line1, line, name))
            except ValueError as wrong:
                at = f"{source}:{number1}: " if str(wrong).startswith("line 1") else place
                raise ValueError(at + str(wrong)) from None
            name, line1 = None, None
        elif is_element and line[0] == "1":
            line1, number1 = line, number
        elif is_element:
            raise ValueError(f"{place}line 2 of elements has no line 1 above it")
        elif name is not None:
            raise ValueError(place + _NO_LINE_1.format(_printable(name), _printable(line)))
        else:
            name = line.removeprefix("0 ").strip()
    if line1 is not None:
        raise ValueError(f"{source}:{number1}: line 1 of elements has no line 2 below it")
    if name is not None:
        end = _NO_LINE_1.format(_printable(name), "").removesuffix('; got ""')
        raise ValueError(f"{source}:{number}: {end}; the file ends with this name")
    if not found:
        raise ValueError(f"{source}: holds no two-line elements")
    return found


def satellite_from_omm(message: str | PathLike[str] | Mapping[str, Any]) -> Satellite:
    """The satellite of an OMM: its fields, a text in XML, JSON, CSV or KEYWORD = value notation, or
    the path of such a file.

    ValueError for fields that are missing or wrong, for elements that are not for SGP4, and for a
    text with several messages: `satellites_from_text` takes these.
    """
    if isinstance(message, Mapping):
        found = [{name: "" if x is None else str(x) for name, x in message.items()}]
    else:
        is_text = isinstance(message, str) and any(mark in message for mark in "\n<{")
        try:
            found = _omm.messages(message if is_text else _text_of_file(message)) or []
        except ValueError as wrong:
            raise ValueError(f"OMM: {wrong}") from None
    if len(found) != 1:
        raise ValueError(f"OMM: {len(found)} messages; expected one (satellites_from_text)")
    try:
        return _satellite_of_fields(found[0])
    except ValueError as wrong:
        raise ValueError(f"OMM: {wrong}") from None


def _satellite_of_fields(fields: Mapping[str, str]) -> Satellite:
    _omm.require_sgp4(fields)
    epoch = _epoch_of_omm(_omm.required(fields, "EPOCH"))
    _sgp4()
    from sgp4 import alpha5, api, omm

    number = fields.get("NORAD_CAT_ID", "")
    if not re.fullmatch(r"[0-9]{0,9}|[A-HJ-NP-Z][0-9]{4}", number):
        raise ValueError(f'NORAD_CAT_ID: got "{_printable(number)}"; expected up to nine digits')
    number = str(alpha5.from_alpha5(number)) if number else ""
    # Satrec has room for five characters of the number, and for microseconds
    room = number if number and int(number) < 340_000 else "0"
    year, month, day, hour, minute, second = epoch.calendar
    micro = min(math.floor(second * 1e6), 59_999_999)
    clock = f"{hour:02}:{minute:02}:{micro // 10**6:02}.{micro % 10**6:06}"
    text = f"{year:04}-{month:02}-{day:02}T{clock}"
    satrec = api.Satrec()
    try:
        omm.initialize(satrec, {**_omm.DEFAULTS, **{k: v for k, v in fields.items() if v},
                                **_omm.elements(fields), "EPOCH": text, "NORAD_CAT_ID": room})
    except ValueError as wrong:
        raise ValueError(str(wrong)) from None
    return _satellite(satrec, epoch, fields.get("OBJECT_NAME") or number, number)


def _epoch_of_omm(text: str) -> Date:
    """2026-05-01T00:00:00.5 or, with the number of the day, 2026-121T00:00:00.5."""
    date, mark, clock = text.removesuffix("Z").partition("T")
    try:
        if re.fullmatch(r"[0-9]{4}-[0-9]{3}", date):
            date = datetime.datetime.strptime(date, "%Y-%j").date().isoformat()
        return Date(f"{date}{mark}{clock} UTC")
    except ValueError:
        raise ValueError(f'EPOCH: got "{_printable(text)}"; expected a date such as '
                         "2026-05-01T00:00:00.000") from None  # fmt: skip


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


# What stands in a line, by columns from 0.
_FIELDS = {
    1: {"year of the epoch": (18, 20), "day of the epoch": (20, 32)},
    2: {"inclination": (8, 16), "node": (17, 25), "eccentricity": (26, 33), "perigee": (34, 42),
        "mean anomaly": (43, 51), "mean motion": (52, 63)},
}  # fmt: skip

_LARGEST = {"inclination": 180, "node": 360, "perigee": 360, "mean anomaly": 360}


def _check_fields(number: int, line: str) -> None:
    """SGP4 itself reads a letter as the end of a number, and goes on."""
    for name, (begin, end) in _FIELDS[number].items():
        field = line[begin:end].strip()
        if not re.fullmatch(r"[0-9]+" if name == "eccentricity" else r"[0-9]*\.?[0-9]*", field) or (
            not any(c.isdigit() for c in field)
        ):
            raise ValueError(f'line {number}: its {name} "{line[begin:end]}", in columns '
                             f"{begin + 1} to {end}, is not a number")  # fmt: skip
    if number == 1 and not re.fullmatch(r"[ +-][0-9 ]{5}[ +-][0-9]", line[53:61]):
        raise ValueError(f'line 1: its drag term "{line[53:61]}", in columns 54 to 61, is not a '
                         "number")  # fmt: skip
    if number == 1:
        if line[62] not in " 02":
            raise ValueError(f"line 1: its ephemeris type, in column 63, is {line[62]}; SGP4 "
                             "elements have 0 (4 is SGP4-XP)")  # fmt: skip
        year = int(line[18:20]) + (2000 if int(line[18:20]) < 57 else 1900)
        days = 366 if calendar.isleap(year) else 365
        if not 1 <= float(line[20:32]) < days + 1:
            raise ValueError(f"line 1: the day of its epoch is {float(line[20:32]):g}; expected 1 "
                             f"to {days}, the days of {year}")  # fmt: skip
        return
    for name, most in _LARGEST.items():
        begin, end = _FIELDS[2][name]
        if float(line[begin:end]) > most:
            raise ValueError(f"line 2: its {name} is {line[begin:end].strip()}; expected at most "
                             f"{most} deg")  # fmt: skip
    if not float(line[52:63]) > 0:
        raise ValueError("line 2: its mean motion is 0; expected revolutions per day")


def _printable(text: str) -> str:
    return text[:80].encode("ascii", "replace").decode()


def _satellite(satrec: Any, epoch: Date, name: str, number: str) -> Satellite:
    if satrec.error:
        raise ValueError(f"{name}: {_reason(satrec.error)}")
    return Satellite(name, epoch, satrec, number)


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


publish(globals())
