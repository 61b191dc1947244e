# SPDX-License-Identifier: MIT
"""numpy.testing.assert_allclose without the 1e-7 that it adds, unasked, to every atol."""

from __future__ import annotations

import budgets
import numpy.testing
from numpy.typing import ArrayLike


def assert_allclose(
    actual: ArrayLike,
    desired: ArrayLike,
    *,
    rtol: float | None = None,
    atol: float | None = None,
    err_msg: str = "",
) -> None:
    """|actual - desired| <= atol + rtol |desired|; given neither: rtol of a formula in doubles."""
    if rtol is None and atol is None:
        rtol = budgets.numpy_formula
    numpy.testing.assert_allclose(
        actual, desired, rtol=rtol or 0.0, atol=atol or 0.0, err_msg=err_msg
    )
