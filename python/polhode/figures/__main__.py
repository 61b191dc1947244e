# SPDX-License-Identifier: MIT
"""`polhode plot`: python -m polhode.figures FILE OUT [COLUMN]...; OUT may be empty."""

from __future__ import annotations

import pathlib
import sys
from collections.abc import Sequence

import matplotlib


def draw(file: str, out: str = "", columns: Sequence[str] = ()) -> int:
    """Draws a file that polhode wrote; the exit status: 2 for bad input, 1 if writing fails."""
    path = pathlib.Path(out or pathlib.Path(file).with_suffix(".png"))
    matplotlib.use("Agg")
    from polhode import figures

    try:
        if not out and path.exists():
            raise ValueError(f"{path} exists; name it with --out to replace it")
        drawn = figures.plot(file, columns)
    except (ValueError, TypeError, OSError, ImportError) as error:
        return _failed(error, 2)
    try:
        figures.save(drawn, path)
    except ValueError as error:  # an unknown extension
        return _failed(error, 2)
    except OSError as error:
        return _failed(error, 1)
    print(f"{path}: written")
    return 0


def _failed(error: Exception, status: int) -> int:
    named = isinstance(error, OSError) and error.filename
    why = f"{error.filename}: {error.strerror}" if named else str(error)  # type: ignore[attr-defined]
    print(f"plot: {why.removeprefix('plot: ')}", file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(draw(sys.argv[1], *sys.argv[2:3], sys.argv[3:]))
