# SPDX-License-Identifier: MIT
"""Coordinates without bounds for unknowns that have some: one to one, with their volume."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from polhode.residual_functions import ResidualFunction

    Array = NDArray[np.float64]

# A start on a bound is put as far inside it: of the room between bounds, of 1 where one is open.
INSIDE = 1e-3


class Unbounded:
    """Free coordinates u of unknowns x.

    An unknown between two bounds is low + (high - low) / (1 + exp(-u)), one above its bound is
    low + exp(u). Ratios of moments X, Y with X + Y >= 1, |X - Y| <= 1 are X = 1 - s + w,
    Y = s + w with 0 < s < 1 and w > 0 (docs/design/0046-fit.md): these are bounded so.
    """

    def __init__(self, of: ResidualFunction) -> None:
        self._low, self._high = of.bounds
        self._triangle = of._compiled.triangle
        n = len(self._low)
        self._linear, self._shift = np.eye(n), np.zeros(n)  # x = linear y + shift
        if self._triangle is not None:
            i, k = self._triangle
            self._linear[i, i], self._linear[i, k], self._shift[i] = -1.0, 1.0, 1.0
            self._linear[k, i], self._linear[k, k] = 1.0, 1.0
            self._low[i], self._high[i] = 0.0, 1.0
            self._low[k], self._high[k] = 0.0, np.inf
        self._both = np.isfinite(self._low) & np.isfinite(self._high)
        self._one = np.isfinite(self._low) & ~self._both

    def inside(self, x: Array) -> Array:
        """x, off its bounds."""
        y = self._bounded(x)
        room = np.where(self._both, self._high - self._low, 1.0)
        has = self._both | self._one
        low = np.where(has, self._low + INSIDE * room, -np.inf)
        high = np.where(self._both, self._high - INSIDE * room, np.inf)
        kept = np.clip(y, low, high)
        return np.array(x, float) if np.array_equal(kept, y) else self._linear @ kept + self._shift

    def free(self, x: Array) -> Array:
        y = self._bounded(x)
        u = y.copy()
        b, o = self._both, self._one
        part = (y[b] - self._low[b]) / (self._high[b] - self._low[b])
        u[b] = np.log(part / (1.0 - part))
        u[o] = np.log(y[o] - self._low[o])
        return u

    def unknowns(self, u: Array) -> Array:
        y = np.array(u, float)
        b, o = self._both, self._one
        y[b] = self._low[b] + (self._high[b] - self._low[b]) * _logistic(u[b])
        y[o] = self._low[o] + np.exp(u[o])
        return self._linear @ y + self._shift

    def slopes(self, u: Array) -> Array:
        """(P, P): dx/du."""
        return self._linear * self._stretch(u)

    def log_volume(self, u: Array) -> tuple[float, Array]:
        """log |det dx/du| but for a constant, and its derivatives by u."""
        b, o = self._both, self._one
        value = float(np.sum(-np.logaddexp(0.0, u[b]) - np.logaddexp(0.0, -u[b])) + np.sum(u[o]))
        gradient = np.zeros(len(u))
        gradient[b] = 1.0 - 2.0 * _logistic(u[b])
        gradient[o] = 1.0
        return value, gradient

    def _stretch(self, u: Array) -> Array:
        k = np.ones(len(u))
        b, o = self._both, self._one
        s = _logistic(u[b])
        k[b] = (self._high[b] - self._low[b]) * s * (1.0 - s)
        k[o] = np.exp(u[o])
        return k

    def _bounded(self, x: Array) -> Array:
        if self._triangle is None:
            return np.array(x, float)
        return np.linalg.solve(self._linear, np.array(x, float) - self._shift)


def _logistic(u: Array) -> Array:
    return 0.5 * (1.0 + np.tanh(0.5 * u))
