# SPDX-License-Identifier: MIT
"""The columns of an ensemble, of EnsembleResults, of a file that it wrote, or of a mapping; and its
members as points, each with the colour of a number or the look of a regime."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from numpy.typing import ArrayLike, NDArray

import polhode
from polhode._core import _number, _numbers
from polhode.figures.columns import symbol, unit_text
from polhode.figures.style import legend_above, regime_look, series

Source = Union[str, os.PathLike[str], polhode.ensemble.EnsembleResults, Mapping[str, ArrayLike]]
MODES = {1.0: ("SAM", "short_axis"), -1.0: ("LAM", "long_axis"), 0.0: ("others", "separatrix")}
"""Numbers of the column mode: what they are called, and the regime whose look they have."""
MANY = 5000
"""Points above which a picture of vectors would be large."""


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
        source = polhode.ensemble.EnsembleResults.read(source)
    if isinstance(source, polhode.ensemble.EnsembleResults):
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


def draw_points(
    axis: Axes,
    data: EnsembleData,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    value: str | None,
    limits: Any,
    size: Any,
    **bar: Any,
) -> None:
    """With a legend of regimes for the column mode, a colour bar for any other; None: one colour.
    Points without a number are crosses. `bar`: keywords of the colour bar."""
    wide = float(_number(_usual_size(x.size) if size is None else size, "size"))
    common = {"markersize": wide, "markeredgewidth": 0.0, "rasterized": x.size > MANY}
    if value is None:
        axis.plot(x, y, **{**series(0).point, **common}, alpha=0.6, gid="members")
        return
    numbers = data.columns[value]
    if value == "mode":
        for mode, (said, regime) in MODES.items():
            these = numbers == mode
            if these.any():
                look = {**regime_look(regime).point, **common}
                axis.plot(x[these], y[these], **look, label=said, gid=f"mode-{said}")
    else:
        ends = (np.nanmin(numbers), np.nanmax(numbers)) if limits is None else limits
        low, high = _numbers(ends, "limits")
        there = np.isfinite(numbers)
        drawn = axis.scatter(
            x[there], y[there], c=numbers[there], s=wide**2, linewidths=0.0, gid=value,
            norm=Normalize(low, high), rasterized=x.size > MANY,
        )  # fmt: skip
        extend = "neither" if limits is None else "both"
        axis.figure.colorbar(drawn, ax=axis, extend=extend, label=data.label(value), **bar)
    failed = ~np.isfinite(numbers) & np.isfinite(x) & np.isfinite(y)
    if failed.any():
        cross = {"color": "black", "markersize": 3, "label": "failed", "gid": "failed"}
        axis.plot(x[failed], y[failed], "x", **cross)
    if axis.get_legend_handles_labels()[1]:
        legend_above(axis, markerscale=max(1.0, 3.5 / wide))


def _usual_size(points: int) -> float:
    return float(np.clip(60.0 / np.sqrt(max(points, 1)), 0.8, 4.0))
