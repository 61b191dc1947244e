# SPDX-License-Identifier: MIT
"""The figure that suits what polhode computed: `polhode plot`, and the method plot of results."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from polhode import MapResults
from polhode._ensemble_columns import columns_with_quantiles
from polhode._output_files import OutputFile, read_output
from polhode.ensemble import EnsembleResults
from polhode.figures.chaos import chaos_map
from polhode.figures.ensembles import outcomes, quantile_fan, regime_fractions
from polhode.figures.light_curves import light_curve_fit
from polhode.figures.overview import overview
from polhode.figures.section import poincare_section
from polhode.figures.style import DOUBLE_COLUMN, SINGLE_COLUMN, axes_or_new, panels, series, styled
from polhode.figures.time_series import time_series
from polhode.fit import FitResults, LightScenarioSolution

MANY = 6
"""Panels of a figure, at most."""
STATE = {"qw", "qx", "qy", "qz"}
PLACES = {"table", "line"}
"""Columns of residuals that say where an observation is from."""
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


class Table(dict[str, Any]):
    """Columns of a file by name, with their units."""

    def __init__(self, file: OutputFile) -> None:
        numbers = {name: x for name, x in file.columns.items() if x.dtype.kind == "f"}
        super().__init__(numbers)
        self.units = file.units


@styled
def plot(source: Any, columns: str | Sequence[str] = ()) -> Any:
    """The figure that suits a run, a map, an ensemble or a fit.

    Parameters
    ----------
    source : Results, MapResults, EnsembleResults, FitResults, or the path of a CSV or HDF5 file
        that polhode wrote.
    columns : names of columns: of a run and of statistics or rows of an ensemble a panel each, of a
        map and of last rows one, of a map of sections two, x and y. None are given: what suits
        the source.

    Returns
    -------
    Axes, or an array of them: of a run its overview, or its columns against time if it has no
    attitudes; of a map its colours or points of sections; of an ensemble quantiles and regimes
    against time, or members over the numbers drawn; of a fit its residuals, of light curves with
    the fluxes.

    ValueError for a column that is not there, and for a fit without solutions."""
    names = [columns] if isinstance(columns, str) else list(columns)
    if isinstance(source, FitResults):
        return _fit(source, names)
    if isinstance(source, (str, os.PathLike)):
        file = read_output(source)
        _require_numbers(file.columns, names)
        if file.kind == "ensemble":
            source = EnsembleResults.read(source)
        elif file.kind == "map":
            return _map(Table(file), names, file)
        elif file.scenario and _has_states(file.columns) and not names:
            return overview(file)
        else:
            return _against_time(Table(file), names)
    if isinstance(source, Mapping):
        _require_numbers(source, names)
    if isinstance(source, EnsembleResults):
        return _ensemble(source, names)
    if isinstance(source, MapResults):
        return _map(source, names, source)
    if names or (isinstance(source, Mapping) and not _has_states(source)):
        return _against_time(source, names)
    return overview(source)


def _has_states(columns: Mapping[str, Any]) -> bool:
    return STATE <= columns.keys() and ("w1" in columns or "g1" in columns)


def _require_numbers(columns: Mapping[str, Any], names: list[str]) -> None:
    for name in names:
        if name in columns and np.asarray(columns[name]).dtype.kind not in "fi":
            raise ValueError(f'plot: the column "{name}" has no numbers')


def _refuse_times(names: list[str]) -> None:
    if "t" in names:
        raise ValueError("plot: got the column t; expected columns to draw against it")


def _one(names: list[str], of: str) -> None:
    if len(names) > 1:
        raise ValueError(f"plot: got {len(names)} columns; expected one for {of}")


def _grouped(names: Sequence[str]) -> list[tuple[str, ...]]:
    """Components of a vector share a panel: w1, w2, w3; qw, qx, qy, qz; turn_x, turn_y, turn_z."""
    groups: dict[str, tuple[str, ...]] = {}
    for name in names:
        stem = re.sub(r"(?<=.)(_?[wxyz]|_?\d)$", "", name)
        groups[stem] = (*groups.get(stem, ()), name)
    return list(groups.values())[:MANY]


def _against_time(source: Any, names: list[str]) -> Any:
    _refuse_times(names)
    if names:
        return time_series(source, names if len(names) > 1 else names[0])
    others = [name for name in source if name != "t" and name not in PLACES]
    found = [name for name in others if np.isfinite(_float(source[name])).any()]
    if "t" not in source or not found:
        raise ValueError(f"plot: no numbers against t; there are: {', '.join(source)}")
    return time_series(source, _grouped(found))


def _float(column: Any) -> Any:
    numbers = np.asarray(column)
    return numbers if numbers.dtype.kind in "fi" else np.full(numbers.shape, np.nan)


def _map(source: Any, names: list[str], of: Any) -> Any:
    there = list(source)
    if "t" in there:
        if len(names) not in (0, 2):
            raise ValueError("plot: a map of sections is drawn as points; expected two columns, "
                             "x and y, or none")  # fmt: skip
        return poincare_section(of, *names)
    axes = [name for name in there if "." in name]
    _one(names, "a map")
    value = names[0] if names else "mean_megno" if "mean_megno" in there else there[len(axes)]
    if len(axes) > 1:
        return chaos_map(source, value)
    if value not in there:
        raise ValueError(f'plot: no column "{value}"; there are: {", ".join(there)}')
    axis = axes_or_new(None, SINGLE_COLUMN)
    axis.plot(source[axes[0]], source[value], **series(0).line)
    for set_label, name in ((axis.set_xlabel, axes[0]), (axis.set_ylabel, value)):
        unit = source.units.get(name, "1")
        set_label(name if unit in ("", "1") else f"{name} ({unit})")
    return axis


def _ensemble(source: EnsembleResults, names: list[str]) -> Any:
    if source.keep == "chunks":
        raise ValueError("plot: got an index of chunks; expected the file of one of them")
    if source.keep == "final":
        keys = [key for key in source.drawn if key in source]
        others = [name for name in source
                  if name not in (*keys, "member", "t") and source[name].dtype.kind == "f"]
        _one(names, "the last rows of an ensemble")
        if not names and not others:
            raise ValueError("plot: got no columns besides the numbers drawn; name one")
        value = names[0] if names else "mode" if "mode" in source else others[0]
        return outcomes(source, value, x=keys[0], y=keys[1] if len(keys) > 1 else value)
    _refuse_times(names)
    data: Any = source
    if source.keep == "rows":
        data = _quantiles(source, names)
    found = columns_with_quantiles(data)
    shown = names or [name for name in found if name != "mode"][: MANY - 1]
    has_regimes = not names and "mode_SAM" in source
    count = len(shown) + has_regimes
    if not count:
        raise ValueError(f"plot: no quantiles against t; there are: {', '.join(source)}")
    drawn = panels(None, count, 1, (DOUBLE_COLUMN, 0.5 + 1.5 * count)).ravel()
    for axis, name in zip(drawn, shown):
        quantile_fan(data, name, axis)
    if has_regimes:
        regime_fractions(source, ax=drawn[-1])
    return drawn


class _Quantiles(dict[str, Any]):
    units: Mapping[str, str]


def _quantiles(source: EnsembleResults, names: list[str]) -> _Quantiles:
    """Of all rows, at each time."""
    left_out = {"member", "t", "mode", *STATE}
    numbers = [name for name in source if source[name].dtype.kind == "f"]
    columns = names or [name for name in numbers if name not in left_out][: MANY - 1]
    times, place = np.unique(source["t"], return_inverse=True)
    found = _Quantiles(t=times)
    units = {"t": source.units["t"]}
    for name in columns:
        rows = [source[name][place == k] for k in range(len(times))]
        for p in QUANTILES:
            found[f"{name}_p{100 * p:g}"] = np.array([np.nanquantile(row, p) for row in rows])
            units[f"{name}_p{100 * p:g}"] = source.units[name]
    found.units = units
    return found


def _fit(results: FitResults, names: list[str]) -> Any:
    if not results.solutions:
        raise ValueError(f"plot: a fit without solutions: {results.failure}")
    best = results.solutions[0]
    if isinstance(best, LightScenarioSolution) and not names:
        return light_curve_fit(results.curves, best)
    return _against_time(best.residuals, names)
