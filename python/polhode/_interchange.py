# SPDX-License-Identifier: MIT
"""Attitudes for other people's packages."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from polhode._core import RotorState, _numbers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from scipy.spatial.transform import Rotation


def to_scipy(attitude: RotorState | ArrayLike) -> Rotation:
    """The scipy Rotation of states, or of quaternions (..., 4) as (w, x, y, z).

    It turns body components into those of the frame, as q does: ``to_scipy(s).apply(v_B)``. The
    way back needs no function: a Rotation is taken wherever a quaternion is expected.
    """
    try:
        from scipy.spatial.transform import Rotation
    except ImportError:
        raise ImportError("to_scipy needs SciPy: pip install scipy") from None
    q = attitude.q if isinstance(attitude, RotorState) else _numbers(attitude, "attitude")
    return Rotation.from_quat(np.roll(q, -1, axis=-1))
