# SPDX-License-Identifier: MIT
"""`python -m polhode.satellites`: from two-line elements to a table that a scenario reads."""

from __future__ import annotations

import argparse
import math
import sys
import warnings
from collections.abc import Sequence
from typing import Any

from polhode import satellites
from polhode._core import Date, Units, seconds_between

_PROGRAM = "python -m polhode.satellites"
_EXAMPLE = """\
example:
  python -m polhode.satellites iss.tle --from 2026-05-01T00:00:00Z --to 2026-05-02T00:00:00Z \\
      --out iss.csv
"""
_OLD = 30.0  # days
_MOST_ROWS = 200_000  # some 15 s, and 100 MB


def main(words: Sequence[str] | None = None) -> int:
    asked = _parser().parse_args(words)
    try:
        _write(asked)
    except (ImportError, OSError, ValueError) as wrong:
        print(f"{_PROGRAM}: {_said(wrong)}", file=sys.stderr)
        return 2
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=_PROGRAM,
        description="Writes a table of positions and velocities of a satellite of the Earth, from "
        "its mean elements by SGP4: what [orbit.NAME] of a scenario reads.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "elements",
        metavar="TLE",
        help="a file of two-line elements, with or without a line of the name, or of OMM (XML, "
        "JSON, CSV or KEYWORD = value); - is standard input",
    )
    parser.add_argument(
        "--from", dest="start", required=True, metavar="DATE",
        help="from when on, such as 2026-05-01T00:00:00Z, '2026-05-01 TT' or 'JD 2461161.5 TDB'; "
        "t = 0 of the table, so that it is epoch in [state]",
    )  # fmt: skip
    parser.add_argument("--to", dest="stop", required=True, metavar="DATE", help="until when")
    parser.add_argument(
        "--out", required=True, metavar="TABLE", help="what is written; .csv or .csv.gz"
    )
    parser.add_argument(
        "--step", metavar="TIME",
        help="between rows, such as '30 s'; left out, 60 s in a low orbit, up to 900 s in a high "
        "one, 10 s at least where the perigee is passed fast",
    )  # fmt: skip
    parser.add_argument(
        "--epoch", metavar="DATE", help="t = 0 of the table, where that is another than --from"
    )
    parser.add_argument(
        "--satellite", metavar="NAME", help="its name or number, where the file has several"
    )
    parser.add_argument(
        "--any-age", action="store_true",
        help=f"also where elements are more than {_OLD:g} days from the interval",
    )  # fmt: skip
    return parser


def _rounded_up(days: float) -> float:
    """To a tenth: more than _OLD is shown as more."""
    return math.ceil(10 * days) / 10


def _write(asked: argparse.Namespace) -> None:
    start, stop = _date(asked.start, "--from"), _date(asked.stop, "--to")
    epoch = start if asked.epoch is None else _date(asked.epoch, "--epoch")
    if not seconds_between(start, stop) > 0:
        raise ValueError(f"--to {asked.stop} must be later than --from {asked.start}")
    if not str(asked.out).removesuffix(".gz").endswith((".csv", ".txt")):
        raise ValueError(f"--out {asked.out} must end with .csv, .txt or one of these and .gz")
    first, last = seconds_between(epoch, start), seconds_between(epoch, stop)
    satellite = _chosen(_read(asked.elements), asked, epoch, 0.5 * (first + last))
    days = satellite._age(epoch, first, last) / 86400
    away = satellite._distance(epoch, first, last) / 86400
    if away > _OLD and not asked.any_age:
        raise ValueError(
            f"{asked.elements}: the elements of {satellite.name} are of "
            f"{satellites._text(satellite.epoch)}, {_rounded_up(away):g} days from the interval: "
            "SGP4 is off by kilometres in a week, by hundreds after "
            f"{_OLD:g} days; use elements of the time, or --any-age"
        )
    if days > _OLD and not asked.any_age:
        print(f"warning: {asked.elements}: the interval goes on until {_rounded_up(days):g} days "
              f"from the elements of {satellite.name}: SGP4 is off by hundreds of kilometres after "
              f"{_OLD:g} days", file=sys.stderr)  # fmt: skip
    spacing = satellite.spacing if asked.step is None else _seconds(asked.step)
    if (last - first) / spacing > _MOST_ROWS:
        raise ValueError(f"{(last - first) / spacing:.3g} rows; expected at most {_MOST_ROWS}: a "
                         "longer --step, or a shorter interval")  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the age, which is said below
        rows = satellite.write(asked.out, epoch, first, last, spacing)
    print(f"{asked.out}: {satellite.name}, {rows} rows, {(last - first) / (rows - 1):g} s apart, "
          f"up to {days:.1f} days from its elements")  # fmt: skip
    print(f'for a scenario with epoch = "{satellites._text(epoch)}" in [state]')


def _read(path: str) -> list[satellites.Satellite]:
    if path == "-":
        return satellites.satellites_from_text(sys.stdin.read(), "standard input")
    return satellites.satellites_from_file(path)


def _chosen(
    found: list[satellites.Satellite], asked: argparse.Namespace, epoch: Date, middle: float
) -> satellites.Satellite:
    """Of several elements of one satellite those that are nearest to the interval."""
    if asked.satellite is not None:
        wanted = asked.satellite.strip().upper()
        number = wanted.lstrip("0")
        named = [s for s in found if wanted == s.name.upper() or number == s.number]
        if not named:
            raise ValueError(f"{asked.elements}: no satellite is {asked.satellite}; there are "
                             f"{_listed(found)}")  # fmt: skip
        found = named
    if len({one.number for one in found}) > 1:
        raise ValueError(f"{asked.elements}: holds several satellites; expected --satellite with "
                         f"one of {_listed(found)}")  # fmt: skip
    return min(found, key=lambda one: one._age(epoch, middle, middle))


def _listed(found: list[satellites.Satellite]) -> str:
    """Their names; of several of one name the numbers."""
    most = 8
    numbers: dict[str, set[str]] = {}
    for one in found:
        numbers.setdefault(one.name, set()).add(one.number)
    names = list(dict.fromkeys(
        one.name if len(numbers[one.name]) == 1 else f"{one.number} ({one.name})"
        for one in found))  # fmt: skip
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def _date(text: str, option: str) -> Date:
    try:
        return Date(text)
    except ValueError as wrong:
        raise ValueError(f"{option}: {wrong}") from None


def _seconds(text: str) -> float:
    number, _, unit = text.strip().partition(" ")
    try:
        seconds = Units("s").to_core(float(number), "time", unit.strip() or "s")
    except ValueError:
        seconds = 0.0
    if not 0 < seconds < float("inf"):
        raise ValueError(f'--step: got "{text}"; expected a time such as 60 or "2 min"')
    return seconds


def _said(wrong: Any) -> str:
    if isinstance(wrong, OSError) and wrong.strerror:
        return f"{wrong.filename}: {wrong.strerror}"
    if isinstance(wrong, UnicodeDecodeError):
        return "the elements are no text in UTF-8"
    return str(wrong)


if __name__ == "__main__":
    sys.exit(main())
