# SPDX-License-Identifier: MIT
"""The rows of a map, from the file that `polhode map` wrote or from Scenario.map."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

import polhode
from polhode._core import _numbers
from polhode._output_files import OutputFile, read_output

Source = Union[str, os.PathLike[str], polhode.MapResults, Mapping[str, ArrayLike]]


@dataclass(frozen=True)
class MapData:
    """Columns by name, with their units where they are known."""

    columns: Mapping[str, NDArray[np.float64]]
    units: Mapping[str, str]


def read_map(source: Source) -> MapData:
    """The columns of a file, of MapResults, or of a mapping."""
    if isinstance(source, Mapping):
        columns = {name: _numbers(x, name) for name, x in source.items()}
        return MapData(columns, getattr(source, "units", {}))
    file = source if isinstance(source, OutputFile) else read_output(source)
    return MapData(file.columns, file.units)


def motions_of(source: Any) -> list[MapData]:
    """The points of each cell of a map of sections; its axes are the columns before t.

    Cells that failed have none. ValueError for a map of something else."""
    data = read_map(source)
    names = list(data.columns)
    if "t" not in names:
        raise ValueError(
            f"poincare_section: a map of {', '.join(names)}; expected one of a section"
        )
    table = np.column_stack(list(data.columns.values()))
    places = table[:, : names.index("t")]
    ends = np.flatnonzero(np.any(places[1:] != places[:-1], axis=1)) + 1
    parts = [part[~np.isnan(part).any(axis=1)] for part in np.split(table, ends)]
    return [MapData(dict(zip(names, part.T)), data.units) for part in parts if len(part)]
