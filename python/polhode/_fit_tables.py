# SPDX-License-Identifier: MIT
"""Tables of what a fit leaves: residuals of observations, and attitudes predicted from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _tables
from polhode._columns import Columns

if TYPE_CHECKING:
    import pandas
    import xarray
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class FitResiduals(Columns):
    """Residuals of a solution, a row for each observation, named and with the units of the files of
    `polhode fit --residuals`. `notes` say which tables there are."""

    def __init__(self, groups: Any, table: Array, notes: Any = ()) -> None:
        super().__init__(groups, table)
        self._notes = list(notes)

    @property
    def notes(self) -> list[str]:
        """Which tables there are, and what the columns mean."""
        return list(self._notes)

    def to_xarray(self) -> xarray.Dataset:
        """Along t; units are attributes of the variables."""
        notes = {"notes": "\n".join(self._notes)}
        return _tables.to_xarray(dict(self), notes, self._units)

    def to_pandas(self) -> pandas.DataFrame:
        """With index t; units and notes in .attrs."""
        notes = {"notes": "\n".join(self._notes)}
        return _tables.to_pandas(dict(self), notes, self._units)

    def __repr__(self) -> str:
        columns = ", ".join(n if u == "1" else f"{n} [{u}]" for n, u in self._units.items())
        return f"<FitResiduals: {len(self._table)} rows of {columns}>"


class FitPredictions(FitResiduals):
    """What a solution says of the attitude at other times, a row for each, named and with the units
    of the files of `polhode fit --predict`: t, qw to qz (body axes to inertial axes), the rate w_x
    to w_z along the body axes, errors about these, and correlations. Scaled ones are NaN without
    degrees of freedom. Errors are of first order: beyond a radian the attitude is not known."""

    @property
    def q(self) -> Array:
        """(N, 4)"""
        return np.stack([self[f"q{k}"] for k in "wxyz"], axis=1)

    @property
    def covariance(self) -> Array:
        """(N, 3, 3) of the rotation vector about the body axes, in squares of the unit of angles,
        with errors as they were given."""
        return self._covariance("")

    @property
    def scaled_covariance(self) -> Array:
        """The same with scaled errors."""
        return self._covariance("scaled_")

    def _covariance(self, which: str) -> Array:
        errors = np.stack([self[f"{which}error_{k}"] for k in "xyz"], axis=1)
        r = np.broadcast_to(np.eye(3), (len(errors), 3, 3)).copy()
        for i, j in ((0, 1), (0, 2), (1, 2)):
            r[:, i, j] = r[:, j, i] = self[f"{which}r_{'xyz'[i]}{'xyz'[j]}"]
        return r * errors[:, :, None] * errors[:, None, :]

    def __repr__(self) -> str:
        return super().__repr__().replace("<FitResiduals", "<FitPredictions", 1)
