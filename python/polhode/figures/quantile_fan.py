# SPDX-License-Identifier: MIT
"""Fans: how far the members of an ensemble have spread, against time."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from polhode._ensemble_columns import columns_with_quantiles, quantiles_in
from polhode.figures.ensemble_data import Source, read_ensemble
from polhode.figures.style import (
    SINGLE_COLUMN,
    axes_or_new,
    faded,
    legend_above,
    series,
    styled,
)

WIDEST, NARROWEST = 0.15, 0.5
"""Opacity of the outermost band and of the innermost."""


@styled
def quantile_fan(
    source: Source,
    column: str,
    ax: Axes | None = None,
    *,
    label: str | None = None,
) -> Axes:
    """Bands between the quantiles of a column against time, and its median as a line.

    Parameters
    ----------
    source : EnsembleResults with statistics, the file that `polhode ensemble` wrote, or its columns
        by name.
    column : of the rows of members: "P_short" draws P_short_p5, P_short_p50, ... Quantiles that lie
        as far from 0 as from 1 are the edges of one band; the others are thin lines.
    label : what the ensemble is, for the legend. Drawing twice on the same Axes compares two: each
        takes the next colour.

    ValueError for a column without quantiles. Angles of an ensemble are within half a turn of those
    of the file's own run: they go on beyond a turn, and so does the fan."""
    data = read_ensemble(source, "quantile_fan")
    found = quantiles_in(data.columns, column)
    if not found or "t" not in data.columns:
        there = ", ".join(columns_with_quantiles(data.columns)) or "none"
        raise ValueError(
            f'quantile_fan: no quantiles of "{column}" against t{data.other_keep("statistics")}; '
            f"there are: {there}"
        )
    axis = axes_or_new(ax, SINGLE_COLUMN)
    drawn = sum(str(line.get_gid()).endswith("-median") for line in axis.get_lines())
    look = series(drawn)
    t = data.columns["t"]
    bands = [(p, q) for p in found for q in found if p < 0.5 and abs(p + q - 1.0) < 1e-9]
    for k, (low, high) in enumerate(bands):
        opacity = WIDEST + (NARROWEST - WIDEST) * k / max(len(bands) - 1, 1)
        said = ", ".join(filter(None, (label, f"{100 * low:.4g} to {100 * high:.4g} %")))
        axis.fill_between(
            t, found[low], found[high], color=faded(look.color, opacity), linewidth=0.0,
            label=said, gid=f"{column}-{low:.10g}", zorder=1.0 + 0.01 * k,
        )  # fmt: skip
    in_bands = {p for band in bands for p in band}
    for p in found:
        if p not in in_bands and p != 0.5:
            axis.plot(t, found[p], color=look.color, linewidth=0.4, label=f"{100 * p:.4g} %")
    middle = found.get(0.5, np.full(t.shape, np.nan))
    said = ", ".join(filter(None, (label, "median")))
    axis.plot(t, middle, **look.line, label=said if 0.5 in found else None, gid=f"{column}-median")
    axis.margins(x=0)
    one = next(name for name in data.columns if name.startswith(f"{column}_p"))
    axis.set(xlabel=data.label("t"), ylabel=data.label(column, of=one))
    legend_above(axis)
    return axis
