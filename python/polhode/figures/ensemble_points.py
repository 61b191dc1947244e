# SPDX-License-Identifier: MIT
"""Members of an ensemble as points, each with the colour of a number or the look of a regime."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from polhode._core import _number, _numbers
from polhode.figures.ensemble_data import EnsembleData
from polhode.figures.style import legend_above, regime_look, series

MODES = {1.0: ("SAM", "short_axis"), -1.0: ("LAM", "long_axis"), 0.0: ("others", "separatrix")}
"""Numbers of the column mode: what they are called, and the regime whose look they have."""
MANY = 5000
"""Points above which a picture of vectors would be large."""


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
