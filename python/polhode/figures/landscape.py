# SPDX-License-Identifier: MIT
"""The landscape of a Fourier scan: chi-square over two frequencies, with its minima."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from polhode._core import _number
from polhode.figures.labels import HALO
from polhode.figures.style import SINGLE_COLUMN, VERMILLION, axes_or_new, styled
from polhode.light import FourierScan

ZOOM = 15
"""Steps of the grid to each side of a minimum."""
PIXELS = 700
"""Cells across, above which each pixel is the least of those in it: minima are narrow."""


@styled
def scan_landscape(
    scan: FourierScan,
    ax: Axes | None = None,
    *,
    minima: int = 5,
    unit: str = "",
    zoom: int = 0,
) -> Axes:
    """Chi-square per degree of freedom by two frequencies, on a logarithmic scale; dark is low.

    Parameters
    ----------
    scan : what fourier_scan returned, or `.scan` of what fit_scenario returned.
    minima : how many of the lowest are marked, with their place in the list from 1; a cross stands
        for one that is not resolved or lies at the edge.
    unit : of time, for the labels; by default that of the scan, which scans of scenarios have.
    zoom : the place of a minimum, from 1, around which ZOOM steps of the grid are shown each way; 0
        for all of the landscape.

    Returns
    -------
    Axes with f1 up and f2 across. A grid with more cells than pixels shows the least of each."""
    if not isinstance(scan, FourierScan):
        raise TypeError(f"scan_landscape: got {scan!r}; expected what fourier_scan returns")
    count = int(_number(minima, "minima"))
    axis = axes_or_new(ax, 1.25 * SINGLE_COLUMN, SINGLE_COLUMN)
    harmonics = ((2 * scan.order + 1) ** 2 - 1) // 2
    freedom = max(scan.points - 2 * harmonics - 1, 1)
    unit = unit or scan.unit
    rows, columns = _around(scan, int(_number(zoom, "zoom")))
    f1, f2, values = _least(
        scan.f1[rows], scan.f2[columns], scan.chi_square[rows, columns] / freedom
    )
    mesh = axis.pcolormesh(f2, f1, values, norm=LogNorm(), rasterized=True, shading="nearest")
    per = f" (1/{unit})" if unit else ""
    axis.set(xlabel=f"$f_2${per}", ylabel=f"$f_1${per}")
    axis.figure.colorbar(mesh, ax=axis, label=r"$\chi^2$ per degree of freedom")
    for k, m in enumerate(scan.minima[:count], 1):
        sound = m.resolved and m.converged and not m.at_edge
        x, y = m.f2, m.f1
        if zoom and not (f2[0] <= x <= f2[-1] and f1[0] <= y <= f1[-1]):
            continue
        marker = {"marker": "o" if sound else "x", "markerfacecolor": "none"}
        axis.plot(x, y, color=VERMILLION, markersize=6.0, linestyle="None",
                  markeredgewidth=1.0, gid=f"minimum-{k}", **marker)  # fmt: skip
        # neighbours have their numbers on different sides
        side = {"ha": "left", "va": "bottom"} if k % 2 else {"ha": "right", "va": "top"}
        offset = (4, 4) if k % 2 else (-4, -4)
        axis.annotate(str(k), (x, y), offset, textcoords="offset points", color=VERMILLION,
                      fontsize=8.0, path_effects=HALO, **side)  # fmt: skip
    axis.tick_params(direction="out", top=False, right=False)
    return axis


def _around(scan: FourierScan, place: int) -> tuple[slice, slice]:
    """Rows and columns near a minimum."""
    if place == 0:
        return slice(None), slice(None)
    if not 1 <= place <= len(scan.minima):
        raise ValueError(
            f"zoom: got {place}; expected 0, or the place of a minimum, 1 to {len(scan.minima)}"
        )
    at = scan.minima[place - 1]

    def near(f: np.ndarray, centre: float) -> slice:
        k = int(np.argmin(np.abs(f - centre)))
        return slice(max(k - ZOOM, 0), k + ZOOM + 1)

    return near(scan.f1, at.f1), near(scan.f2, at.f2)


def _least(f1: np.ndarray, f2: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, ...]:
    """No more than PIXELS cells each way: the least of each block."""
    for axis, f in ((0, f1), (1, f2)):
        step = -(-len(f) // PIXELS)
        starts = np.arange(0, len(f), step)
        values = np.minimum.reduceat(values, starts, axis=axis)
        if axis == 0:
            f1 = np.add.reduceat(f1, starts) / np.diff(np.append(starts, len(f1)))
        else:
            f2 = np.add.reduceat(f2, starts) / np.diff(np.append(starts, len(f2)))
    return f1, f2, values
