# SPDX-License-Identifier: MIT
"""Polynomials of a time from -1 to 1, for fits. NumPy's module of them is imported when one is
made: it takes 5 ms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


def legendre_columns(x: Array, degree: int) -> Array:
    """(N, degree + 1): the Legendre polynomials at times (N,)."""
    from numpy.polynomial import legendre

    return legendre.legvander(x, degree)


def powers_of_time(coefficients: Array, middle: float, half: float) -> Array:
    """(degree + 1, K): sums of Legendre polynomials of x = (t - middle)/half in powers of t."""
    from numpy.polynomial import Polynomial, legendre

    x = Polynomial([-middle / half, 1 / half])
    power = np.zeros_like(coefficients)
    for k, of_one in enumerate(coefficients.T):
        in_t = Polynomial(legendre.leg2poly(of_one))(x).coef
        power[: len(in_t), k] = in_t
    return power
