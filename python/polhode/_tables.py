# SPDX-License-Identifier: MIT
"""Columns as tables of pandas and xarray, which are imported here alone and only when asked for."""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing
    import pandas
    import xarray

    Columns = Mapping[str, numpy.typing.NDArray[Any]]


def imported(package: str, what: str = "") -> ModuleType:
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as error:
        # a package that is there but lacks one of its own is another story
        if error.name != package:
            raise
        needs = what or f"to_{package}"
        raise ImportError(f"{needs} needs {package}: pip install {package}") from None


def plotted(source: Any, columns: str | Sequence[str]) -> Any:
    """What polhode.figures.plot draws."""
    try:
        figures = importlib.import_module("polhode.figures")
    except ModuleNotFoundError as error:
        if error.name != "matplotlib":
            raise
        raise ImportError("plot needs matplotlib: pip install 'polhode[figures]'") from None
    return figures.plot(source, columns)


def to_pandas(
    columns: Columns, notes: Mapping[str, str], units: Mapping[str, str] | None = None
) -> pandas.DataFrame:
    """A DataFrame with index t and the other columns in their order; notes, and units if any, in
    `.attrs`."""
    pandas = imported("pandas")
    index = pandas.Index(columns["t"], name="t", copy=True)
    frame = pandas.DataFrame({name: x for name, x in columns.items() if name != "t"}, index=index)
    frame.attrs.update(notes)
    if units is not None:
        frame.attrs["units"] = dict(units)
    return frame


def to_xarray(
    columns: Columns, notes: Mapping[str, str], units: Mapping[str, str] | None = None
) -> xarray.Dataset:
    """A Dataset along the coordinate t; units, if any, are attributes of each variable."""
    attributes = {
        name: {"units": units[name]} if units is not None and name in units else {}
        for name in columns
    }
    return imported("xarray").Dataset(
        {name: ("t", x, attributes[name]) for name, x in columns.items() if name != "t"},
        coords={"t": ("t", columns["t"], attributes["t"])},
        attrs=dict(notes),
    )
