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
    keep: str = ""
    """What the ensemble kept, where that is known."""

    def other_keep(self, *wanted: str) -> str:
        """Ends a message about what is not there: that another keep has it; or nothing."""
        if not self.keep or self.keep in wanted:
            return ""
        ask = " or ".join(f'keep="{keep}"' for keep in wanted)
        return f'; it takes results of {ask}, and these are of keep="{self.keep}"'

    def require(self, names: Iterable[str], *keeps: str) -> None:
        """ValueError naming a column that is not there; `keeps`: which results have it."""
        for name in names:
            if name not in self.columns:
                there = ", ".join(self.columns)
                is_event = f"{name}_first" in self.columns
                when = f'; when the event first happened is "{name}_first"' if is_event else ""
                hint = when + (self.other_keep(*keeps) if keeps else "")
                raise ValueError(f'{self.function}: no column "{name}"{hint}; there are: {there}')

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
        return EnsembleData(numbers, source.units, keys, function, source.keep)
    if not isinstance(source, Mapping):
        raise TypeError(
            f"{function}: got {source!r}; expected EnsembleResults, the path of a file of an "
            "ensemble, or a mapping of columns"
        )
    columns = {str(name): _numbers(x, name) for name, x in source.items()}
    units = dict(getattr(source, "units", {}))  # of a Posterior
    return EnsembleData(columns, units, [key for key in columns if "." in key], function)
