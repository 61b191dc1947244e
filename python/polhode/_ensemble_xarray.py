# SPDX-License-Identifier: MIT
"""The columns of an ensemble as a Dataset of xarray: along time, along the members, or along both.
What each column is goes with it as attributes, units and long_name."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy

from polhode._tables import imported

if TYPE_CHECKING:
    import xarray

_STATISTICS = (  # as they end, and what they are of X
    ("_members", "members where there is {}"),
    ("_mean", "mean of {}"),
    ("_deviation", "standard deviation of {}"),
    ("_least", "least {}"),
    ("_greatest", "greatest {}"),
    ("_p_error", "most that a quantile of {} may be off"),
    ("_mean_w", "mean attitude of {}, w"),
    ("_mean_x", "mean attitude of {}, x"),
    ("_mean_y", "mean attitude of {}, y"),
    ("_mean_z", "mean attitude of {}, z"),
    ("_mean_error", "most that the mean attitude of {} may be off"),
    ("_cov_error", "most that the covariance of {} may be off"),
    ("_SAM", "part of the members in short-axis mode"),
    ("_LAM", "part of the members in long-axis mode"),
    ("_other", "part of the members in neither mode"),
    ("_part", "part of the members: {}"),
)


def long_name(column: str, keep: str) -> str:
    """What a column of an ensemble is, in words."""
    if column == "member":
        return "index of the member"
    if keep != "statistics":
        return column
    if column == "members":
        return "members that have a row"
    if found := re.fullmatch(r"(.+)_p([0-9.e+-]+)", column):
        return f"quantile {float(found[2]) / 100:.10g} of {found[1]}"
    if found := re.fullmatch(r"(.+)_cov_([123])([123])", column):
        return f"covariance of the rotation vectors of {found[1]}, body axes {found[2]}, {found[3]}"
    for end, words in _STATISTICS:
        if column.endswith(end) and column != end:
            return words.format(column[: -len(end)])
    return column


def dataset(
    columns: Mapping[str, Any],
    units: Mapping[str, str],
    drawn: Sequence[str],
    keep: str,
    members: range,
    notes: Mapping[str, Any],
) -> xarray.Dataset:
    """Columns by name; `drawn` are those that were drawn."""
    xarray = imported("xarray")
    words = {name: f"drawn: {name}" if name in drawn else long_name(name, keep) for name in columns}
    attributes = {name: {"units": units[name], "long_name": words[name]} for name in columns}

    def variables(dimensions: Any, arrays: Mapping[str, Any], left_out: Sequence[str]) -> Any:
        return {
            name: (dimensions, array, attributes[name])
            for name, array in arrays.items() if name not in left_out
        }

    if keep == "rows":
        dimension, coordinates, arrays = _by_member(columns, members)
        numbers = ("member", numpy.array(members, dtype=numpy.int64), attributes["member"])
        times = (*coordinates, attributes["t"])
        return xarray.Dataset(
            variables(("member", dimension), arrays, ("member", "t")),
            coords={"member": numbers, "t": times}, attrs=dict(notes),
        )
    along = {"statistics": "t", "final": "member", "chunks": "chunk"}[keep]
    place = columns[along] if along == "t" else columns[along].astype(numpy.int64)
    return xarray.Dataset(
        variables(along, columns, (along,)),
        coords={along: (along, place, attributes[along])}, attrs=dict(notes),
    )


def _by_member(columns: Mapping[str, Any], members: range) -> tuple[str, Any, dict[str, Any]]:
    """Rows of these members side by side, NaN where a member has none: the second dimension, t with
    its own dimensions, and the arrays (size, most rows of a member).

    Where every row is at the same time as those of its number, t is the dimension."""
    size = len(members)
    member = columns["member"].astype(numpy.int64) - members.start
    counts = numpy.bincount(member, minlength=size)
    within = numpy.arange(len(member)) - numpy.repeat(numpy.cumsum(counts) - counts, counts)
    most = int(counts.max(initial=0))
    arrays = {}
    for name, column in columns.items():
        empty = "" if column.dtype.kind == "U" else numpy.nan
        arrays[name] = numpy.full((size, most), empty, dtype=column.dtype)
        arrays[name][member, within] = column
    times = arrays["t"]
    longest = times[counts.argmax()] if size else times.reshape(-1)
    if numpy.array_equal(columns["t"], longest[within]):
        return "t", ("t", longest), arrays
    return "row", (("member", "row"), times), arrays
