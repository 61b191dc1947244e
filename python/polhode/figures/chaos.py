# SPDX-License-Identifier: MIT
"""Chaos: an indicator over a grid of starts, and along runs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from numpy.typing import NDArray

from polhode._core import _number, _numbers
from polhode.figures.map_data import Source, read_map
from polhode.figures.style import DOUBLE_COLUMN, SINGLE_COLUMN, axes_or_new, panels, series, styled

EMPTY = "#FFFFFF"
"""Behind cells without a number."""

SAID = {
    "mean_megno": "mean MEGNO",
    "lyapunov": "Lyapunov indicator",
}


@styled
def chaos_map(
    source: Source,
    value: str = "mean_megno",
    ax: Axes | None = None,
    *,
    x: str | None = None,
    y: str | None = None,
    limits: tuple[float, float] | None = None,
    log: bool | None = None,
) -> Axes:
    """A result of `polhode map` over two of its axes, as colours.

    Parameters
    ----------
    source : MapResults, the file that `polhode map` wrote, or its columns by name.
    value : the column to show. x, y : the axes, by the names of their columns; None takes the
        second axis of the map for x (it runs fastest) and the first for y.
    limits : the numbers of the two ends of the colour bar; what is beyond has the colour of the
        end. None: 2 to 100 for mean MEGNO, so that all regular motion is dark; else what there is.
    log : whether colours go with the logarithm; None: for mean MEGNO.

    Cells without a number (failed ones) are white and crossed out. ValueError for a column that is
    not there, and for places that make no grid."""
    data = read_map(source)
    columns, units = data.columns, data.units
    names = list(columns)
    across = names[1] if x is None else x
    up = names[0] if y is None else y
    for name in (across, up, value):
        if name not in columns:
            raise ValueError(f'chaos_map: no column "{name}"; there are: {", ".join(names)}')
    grid_x, grid_y, grid = _grid(columns[across], columns[up], columns[value])
    axis = axes_or_new(ax, SINGLE_COLUMN, 0.8 * SINGLE_COLUMN)
    megno = value == "mean_megno"
    limits = None if limits is None else tuple(_numbers(limits, "limits"))
    low, high = limits or ((2.0, 100.0) if megno else (np.nanmin(grid), np.nanmax(grid)))
    norm = (LogNorm if (megno if log is None else log) else Normalize)(low, high, clip=True)
    axis.set_facecolor(EMPTY)
    mesh = axis.pcolormesh(
        grid_x, grid_y, np.ma.masked_invalid(grid), norm=norm, rasterized=True, shading="nearest"
    )
    missing = np.argwhere(np.isnan(grid))
    axis.plot(grid_x[missing[:, 1]], grid_y[missing[:, 0]], "x", color="black", markersize=3)
    bar = axis.figure.colorbar(mesh, ax=axis, extend="both" if limits or megno else "neither")
    bar.set_label(_label(SAID.get(value, value), units.get(value, "")))
    axis.set_xlabel(_label(across, units.get(across, "")))
    axis.set_ylabel(_label(up, units.get(up, "")))
    axis.tick_params(direction="out", top=False, right=False)
    return axis


def _label(name: str, unit: str) -> str:
    return name if unit in ("", "1") else f"{name} ({unit})"


def _grid(
    x: NDArray[np.float64], y: NDArray[np.float64], values: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    across, i = np.unique(x, return_inverse=True)
    up, j = np.unique(y, return_inverse=True)
    if across.size * up.size != x.size:
        raise ValueError(
            f"chaos_map: {x.size} cells; expected a grid of {across.size} by {up.size} places: "
            "take the cells of one value of every other axis"
        )
    grid = np.full((up.size, across.size), np.nan)
    grid[j, i] = values
    return across, up, grid


@styled
def chaos_growth(runs: Any, ax: Any = None, *, unit: str = "", scale: float = 1.0) -> Any:
    """Lyapunov indicator and mean MEGNO against time, regular runs next to chaotic ones.

    Parameters
    ----------
    runs : a ChaosIndicator, or a mapping of names to them; their samples are what is drawn.
    ax : two Axes, or None for a new figure.
    unit : of time, for the labels. scale : how many of it are a unit of time of the runs.

    Returns
    -------
    An array of two Axes: the indicator on logarithmic axes, where that of a regular run falls like
    ln(t) / t and that of a chaotic one settles; and MEGNO, which stays at 2 or grows in a line."""
    named = runs if isinstance(runs, Mapping) else {None: runs}
    scale = _number(scale, "scale")
    axes = panels(ax, 1, 2, (DOUBLE_COLUMN, 2.4)).ravel()
    for k, (name, run) in enumerate(named.items()):
        t = scale * np.asarray(run.t)
        positive = (t > 0) & (run.lyapunov > 0)
        look = series(k).line
        axes[0].loglog(t[positive], run.lyapunov[positive] / scale, label=name, **look)
        axes[1].plot(t, run.mean_megno, label=name, **look)
    axes[1].axhline(2.0, color="0.6", linewidth=0.6, zorder=0)
    time = "$t$" + (f" ({unit})" if unit else "")
    axes[0].set(xlabel=time, ylabel="Lyapunov indicator" + (f" (1/{unit})" if unit else ""))
    axes[1].set(xlabel=time, ylabel="mean MEGNO", ylim=(0, None))
    axes[1].margins(x=0)
    if any(name is not None for name in named):
        axes[1].legend(loc="upper left")
    return axes
