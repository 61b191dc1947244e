# SPDX-License-Identifier: MIT
"""Draws what polhode wrote: python -m polhode.figures FILE, which `polhode plot` runs."""

from __future__ import annotations

import argparse
import pathlib
import sys

import matplotlib


def main(words: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser("polhode plot", description=__doc__)
    parser.add_argument("FILE", help="CSV or HDF5 output of polhode run, map or ensemble")
    parser.add_argument("--column", action="append", default=[], help="what to draw, by name")
    parser.add_argument("--out", help="PATH.png, PATH.pdf or PATH.svg; default: FILE.png")
    options = parser.parse_args(words)
    out = pathlib.Path(options.out or pathlib.Path(options.FILE).with_suffix(".png"))
    matplotlib.use("Agg")
    from polhode import figures

    try:
        if options.out is None and out.exists():
            raise ValueError(f"{out} exists; name it with --out to replace it")
        figures.save(figures.plot(options.FILE, options.column), out)
    except (ValueError, TypeError, OSError, ImportError) as error:
        why = f"{error.filename}: {error.strerror}" if isinstance(error, OSError) else error
        print(f"plot: {why}", file=sys.stderr)
        return 2
    print(f"{out}: written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
