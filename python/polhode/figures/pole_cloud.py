# SPDX-License-Identifier: MIT
"""Where the members of an ensemble point: directions on the sky, on an equal-area map."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter
from numpy.typing import NDArray

from polhode.charts import attitude_matrix
from polhode.figures.columns import radians_in
from polhode.figures.ensemble_data import EnsembleData, Source, draw_points, read_ensemble
from polhode.figures.style import SINGLE_COLUMN, axes_or_new, styled

POLES = (("pole_lon", "pole_lat"), ("pole_ra", "pole_dec"))
QUATERNIONS = (("Qw", "Qx", "Qy", "Qz"), ("qw", "qx", "qy", "qz"))


@styled
def pole_cloud(
    source: Source,
    of: str = "pole",
    ax: Axes | None = None,
    *,
    value: str | None = None,
    limits: tuple[float, float] | None = None,
    size: float | None = None,
) -> Axes:
    """A direction of each member on the sky, in Mollweide's projection, which keeps areas.

    Parameters
    ----------
    source : EnsembleResults of keep="final" (or "rows": every row is a point), its file, or columns
        by name.
    of : "pole" is the angular momentum, the columns of the group `pole`; "axis1", "axis2" or
        "axis3" a body axis, from the groups of these names or from the attitude, `q_inertial` or
        `q`; any other name stands for the vector NAME_x, NAME_y, NAME_z, or NAME1, NAME2, NAME3
        ("W" of the group `omega_inertial`).
    ax : Axes with the projection "mollweide", or None for a new figure.
    value : a column that colours the points, as in figures.outcomes. limits, size : as there.

    Where an event stops members, their last rows are at different times, which the column t has.
    Longitude, or right ascension, grows from 0 on the left to 360 degrees on the right. ValueError
    for a direction whose columns are not there, TypeError for other Axes."""
    data = read_ensemble(source, "pole_cloud")
    longitude, latitude = _direction(data, of)
    if value is not None:
        data.require((value,), "final", "rows")
    axis = axes_or_new(ax, 1.5 * SINGLE_COLUMN, 0.8 * SINGLE_COLUMN, projection="mollweide")
    if axis.name != "mollweide":
        raise TypeError('pole_cloud: got plain Axes; expected a projection "mollweide"')
    x = np.mod(longitude, 2.0 * np.pi) - np.pi
    below = {"orientation": "horizontal", "shrink": 0.6, "aspect": 30.0}
    draw_points(axis, data, x, latitude, value, limits, size, **below)
    axis.grid(True)
    set_sky_ticks(axis)
    return axis


def set_sky_ticks(axis: Axes) -> None:
    """Longitude from 0 on the left to 360 degrees, latitude, every 30 and 60 degrees."""
    axis.xaxis.set_major_locator(FixedLocator(np.radians([-120.0, -60.0, 0.0, 60.0, 120.0])))
    axis.xaxis.set_major_formatter(FuncFormatter(_longitude))
    axis.yaxis.set_major_locator(FixedLocator(np.radians([-60.0, -30.0, 0.0, 30.0, 60.0])))
    axis.yaxis.set_major_formatter(FuncFormatter(lambda at, _: _degrees(np.degrees(at))))


def _longitude(at: float, _: int) -> str:
    return _degrees(np.degrees(at) + 180.0)


def _degrees(number: float) -> str:
    return rf"${number:.0f}^\circ$"


def _direction(
    data: EnsembleData, of: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Longitude and latitude in radians."""
    has = data.columns
    if of == "pole":
        for names in POLES:
            if all(name in has for name in names):
                radians = radians_in(data.units.get(names[0], "rad"))
                return has[names[0]] * (radians or 1.0), has[names[1]] * (radians or 1.0)
        raise ValueError(
            f"pole_cloud: no columns of the group pole{data.other_keep('final', 'rows')}; expected "
            f'it in [output] columns, or of="axis3"; there are: {", ".join(has)}'
        )
    vector = _vector(data, of)
    x, y, z = vector
    return np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))


def _vector(data: EnsembleData, of: str) -> NDArray[np.float64]:
    """(3, N)"""
    has = data.columns
    for ends in (("_x", "_y", "_z"), ("1", "2", "3")):
        if all(of + end in has for end in ends):
            return np.stack([has[of + end] for end in ends])
    if of in ("axis1", "axis2", "axis3"):
        for names in QUATERNIONS:
            if all(name in has for name in names):
                q = np.stack([has[name] for name in names], axis=-1)
                return attitude_matrix(q)[..., int(of[-1]) - 1, :].T
    raise ValueError(
        f'pole_cloud: no direction "{of}"{data.other_keep("final", "rows")}; expected columns '
        f'{of}_x, {of}_y, {of}_z, or of="pole" or "axis1" to "axis3" with their columns; there '
        f'are: {", ".join(has)}'
    )
