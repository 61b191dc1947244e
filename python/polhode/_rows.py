# SPDX-License-Identifier: MIT
"""Rows that an earlier part of a run or map has left in its files."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from polhode.scenarios import Path


def _readable(paths: Sequence[Path]) -> list[str]:
    return [name for name in map(os.fsdecode, paths) if name.endswith((".csv", ".h5"))]


def require_readable(paths: Sequence[Path]) -> None:
    if not _readable(paths):
        raise ValueError("run: resume=True with keep=True reads the rows so far from PATH.csv or "
                         "PATH.h5; expected one of them, or keep=False")


def rows_in(paths: Sequence[Path], count: int, groups: Sequence[str]) -> Any:
    """The first rows of a file of this run; `groups` of columns as HDF5 names them."""
    import numpy

    name = _readable(paths)[0]
    if not os.path.exists(name):  # the rest of the run failed
        name += ".part"
    if ".csv" in name[-9:]:
        with open(name, encoding="utf-8") as file:
            line = next(file)
            while line.startswith("#"):
                line = next(file)
            return numpy.loadtxt(file, delimiter=",", ndmin=2, max_rows=count)
    import h5py

    with h5py.File(name, "r") as file:
        return numpy.column_stack([file[group][:count] for group in groups])


def stacked(before: Any, after: Any) -> Any:
    import numpy

    table = numpy.concatenate([before, after])
    table.flags.writeable = False
    return table
