# SPDX-License-Identifier: MIT
"""The columns of an ensemble: of EnsembleResults, of a file that it wrote, or of a mapping."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

import polhode
from polhode._core import _numbers
from polhode.figures.columns import symbol, unit_text

Source = Union[str, os.PathLike[str], polhode.EnsembleResults, Mapping[str, ArrayLike]]


@dataclass(frozen=True)
class EnsembleData:
    """Columns by name, their units where they are known, and the keys that were drawn."""

    columns: Mapping[str, NDArray[np.float64]]
    units: Mapping[str, str]
    keys: Sequence[str]
    function: str
    """Whose messages these are."""

    def require(self, names: Iterable[str]) -> None:
        """ValueError naming a column that is not there."""
        for name in names:
            if name not in self.columns:
                there = ", ".join(self.columns)
                raise ValueError(f'{self.function}: no column "{name}"; there are: {there}')

    def label(self, name: str, of: str | None = None) -> str:
        """Symbol and unit; of a key its end: "rotation period (h)". `of`: whose unit it is."""
        end = symbol(name.rpartition(".")[2])
        if "." in name and "$" not in end:
            end = end.replace("_", " ")
        unit = self.units.get(of or name, "")
        return end if unit in ("", "1") else f"{end} ({unit_text(unit)})"


def read_ensemble(source: Source, function: str) -> EnsembleData:
    """The columns of results, of a file of `polhode ensemble`, or of a mapping of arrays."""
    if isinstance(source, (str, os.PathLike)):
        source = polhode.EnsembleResults.read(source)
    if isinstance(source, polhode.EnsembleResults):
        numbers = {name: x for name, x in source.items() if x.dtype.kind == "f"}
        keys = [key for key in numbers if key in source.drawn] if source.keep == "final" else []
        return EnsembleData(numbers, source.units, keys, function)
    if not isinstance(source, Mapping):
        raise TypeError(
            f"{function}: got {source!r}; expected EnsembleResults, the path of a file of an "
            "ensemble, or a mapping of columns"
        )
    columns = {str(name): _numbers(x, name) for name, x in source.items()}
    units = dict(getattr(source, "units", {}))  # of a Posterior
    return EnsembleData(columns, units, [key for key in columns if "." in key], function)
