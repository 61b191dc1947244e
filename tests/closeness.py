# SPDX-License-Identifier: MIT
"""Comparisons that see: numpy.testing.assert_allclose without the 1e-7 that it adds, unasked, to
every atol, and without its NaN equal to NaN; max and min that keep a NaN."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

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
    """|actual - desired| <= atol + rtol |desired|, and no NaN; given neither: rtol of a formula in
    doubles."""
    if rtol is None and atol is None:
        rtol = budgets.numpy_formula
    numpy.testing.assert_allclose(
        actual, desired, rtol=rtol or 0.0, atol=atol or 0.0, err_msg=err_msg, equal_nan=False
    )


def largest(*values: Any) -> Any:
    """max(...), of values or of one iterable, but NaN if one of them is: max(0.0, nan) is 0.0."""
    return _kept(max, values)


def smallest(*values: Any) -> Any:
    """min(...), of values or of one iterable, but NaN if one of them is."""
    return _kept(min, values)


def _kept(choice: Any, values: tuple[Any, ...]) -> Any:
    (first, *more) = values
    numbers = list(first) if not more and isinstance(first, Iterable) else list(values)
    return next((x for x in numbers if x != x), choice(numbers))  # x != x: NaN of any type
