# SPDX-License-Identifier: MIT
"""Ensembles: how far their members have spread, which regimes they are in, what became of each."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from polhode._ensemble_columns import columns_with_quantiles, quantiles_in
from polhode.figures.ensemble_data import Source, draw_points, read_ensemble
from polhode.figures.style import (
    SINGLE_COLUMN,
    axes_or_new,
    faded,
    legend_above,
    regime_look,
    series,
    styled,
)

WIDEST, NARROWEST = 0.15, 0.5
"""Opacity of the outermost band and of the innermost."""
REGIMES = {"SAM": "short_axis", "LAM": "long_axis", "other": "separatrix"}
OPACITY = 0.55  # of a regime


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


@styled
def regime_fractions(
    source: Source,
    column: str = "mode",
    ax: Axes | None = None,
) -> Axes:
    """The part of the members in each regime, one above the other, against time.

    Parameters
    ----------
    source : EnsembleResults with statistics, the file that `polhode ensemble` wrote, or its columns
        by name.
    column : of the rows of members: "mode" (group `tumbler`) draws mode_SAM, mode_LAM, mode_other.
        A regime that no member is ever in is left out.

    ValueError for a column whose parts are not there."""
    data = read_ensemble(source, "regime_fractions")
    parts = {
        name[len(column) + 1 :]: x for name, x in data.columns.items()
        if name.startswith(f"{column}_")
    }  # fmt: skip
    if "t" not in data.columns or not parts:
        raise ValueError(
            f'regime_fractions: no parts of "{column}" against t{data.other_keep("statistics")}; '
            "expected statistics of an ensemble with the group tumbler; there are: "
            f"{', '.join(data.columns)}"
        )
    met = {name: x for name, x in parts.items() if (x > 0).any()}
    looks = [
        regime_look(REGIMES[name]) if name in REGIMES else series(k)
        for k, name in enumerate(met)
    ]  # fmt: skip
    axis = axes_or_new(ax, SINGLE_COLUMN)
    t = data.columns["t"]
    layers = axis.stackplot(
        t, *met.values(), labels=["others" if name == "other" else name for name in met],
        colors=[faded(look.color, OPACITY) for look in looks], linewidth=0.0,
    )  # fmt: skip
    total = 0.0
    for name, layer, look in zip(met, layers, looks):
        layer.set_gid(f"{column}-{name}")
        total = total + met[name]
        if name != list(met)[-1]:
            axis.plot(t, total, **look.line)
    axis.margins(x=0)
    axis.set(ylim=(0.0, 1.0), xlabel=data.label("t"), ylabel="part of the members")
    legend_above(axis)
    return axis


@styled
def outcomes(
    source: Source,
    value: str = "mode",
    ax: Axes | None = None,
    *,
    x: str | None = None,
    y: str | None = None,
    limits: tuple[float, float] | None = None,
    size: float | None = None,
) -> Axes:
    """Each member as a point over two drawn numbers, its colour what became of it.

    Parameters
    ----------
    source : EnsembleResults of keep="final", its file, or columns by name.
    value : the column to show. "mode" has the looks of its regimes and a legend; any other one is a
        number, with a colour bar.
    x, y : columns; None takes the first two keys that were drawn.
    limits : the numbers of the two ends of the colour bar; None: what there is.
    size : of points, in points of the paper; None: by their number.

    Where an event stops members, their last rows are at different times: the column t is when, and
    EVENT_first when an event first happened. Members that failed are crosses. ValueError for a
    column that is not there."""
    data = read_ensemble(source, "outcomes")
    if (x is None or y is None) and len(data.keys) < 2:
        many = "1 column" if len(data.keys) == 1 else f"{len(data.keys)} columns"
        raise ValueError(
            f"outcomes: {many} of keys that were drawn{data.other_keep('final')}; expected two, or "
            "x and y, names of columns"
        )
    across, up = data.keys[0] if x is None else x, data.keys[1] if y is None else y
    data.require((across, up, value), "final")
    axis = axes_or_new(ax, SINGLE_COLUMN, 0.8 * SINGLE_COLUMN)
    draw_points(axis, data, data.columns[across], data.columns[up], value, limits, size)
    axis.set(xlabel=data.label(across), ylabel=data.label(up))
    return axis
