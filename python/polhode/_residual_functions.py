# SPDX-License-Identifier: MIT
"""Residuals of fits as functions of the unknowns, with exact derivatives, for other optimisers and
for samplers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from polhode._core import _numbers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

Own = TypeVar("Own", bound="ResidualFunction")


class ResidualFunction:
    """What SpinResiduals and LightResiduals have in common; made by them.

    Unknowns are arrays x (P,) in the order of `names`. Residuals are in standard errors, those of
    data first and those of priors after them; a robust loss is part of them, so that the sum of
    their squares is what a fit minimises. Derivatives are exact (dual numbers), never differences.

    They pickle, for other processes, as what they were made of: arrays, or a scenario and where it
    begins. Copies are the function itself, which does not change.
    """

    # (function, arguments) that make it again
    _inputs: tuple[Any, tuple[Any, ...]] | None = None

    def __new__(cls, *arguments: Any, **keywords: Any) -> ResidualFunction:
        made = object.__new__(cls)
        made._inputs = (_made, (cls, arguments, keywords))
        return made

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        if self._inputs is None:
            raise TypeError(f"{type(self).__name__}: this one was not made of arrays or a scenario "
                            "and cannot be pickled")  # fmt: skip
        return self._inputs

    def __copy__(self) -> ResidualFunction:
        return self

    def __deepcopy__(self, memo: object) -> ResidualFunction:
        return self

    def __init__(self, compiled: Any) -> None:
        self._compiled = compiled
        unknowns = compiled.unknowns
        self._names = tuple(name for name, *_ in unknowns)
        self._start, self._low, self._high = np.array([row[1:] for row in unknowns]).T.copy()
        self._last: tuple[bytes, Any, Any] | None = None

    @classmethod
    def _of(cls: type[Own], compiled: Any) -> Own:
        made = object.__new__(cls)
        ResidualFunction.__init__(made, compiled)
        return made

    @property
    def names(self) -> tuple[str, ...]:
        """Of the unknowns."""
        return self._names

    @property
    def start(self) -> Array:
        """(P,): the unknowns at the start."""
        return self._start.copy()

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Least and most values (P,), as scipy.optimize.least_squares takes them. Ratios of moments
        have none here; where they are those of no body, there are no residuals."""
        return self._low.copy(), self._high.copy()

    @property
    def size(self) -> int:
        """How many residuals there are, those of priors included."""
        return self._compiled.size

    @property
    def data(self) -> int:
        """How many of them are of data."""
        return self._compiled.data

    def residuals(self, x: ArrayLike) -> Array:
        """(size,) at x; NaN where they have no value."""
        found = self._at(x, False)
        return np.full(self.size, np.nan) if found is None else found[0]

    def jacobian(self, x: ArrayLike) -> Array:
        """(size, P): the derivatives of the residuals at x; NaN where they have no value."""
        found = self._at(x, True)
        return np.full((self.size, len(self.names)), np.nan) if found is None else found[1]

    def log_likelihood(self, x: ArrayLike) -> float:
        """-1/2 of the sum of squares of the residuals of data: the logarithm of the likelihood but
        for a constant. -inf where they have no value."""
        found = self._at(x, False)
        return -np.inf if found is None else -0.5 * _square(found[0][: self.data])

    def log_likelihood_gradient(self, x: ArrayLike) -> Array:
        """(P,): its derivatives."""
        r, J = self.residuals_and_jacobian(x)
        return -(J[: self.data].T @ r[: self.data])

    def log_posterior(self, x: ArrayLike) -> float:
        """The same of all residuals, with the prior of an attitude that all rotations are alike:
        the logarithm of its density by the rotation vector is 2 log(sin(a / 2) / (a / 2)), a its
        length. -inf where they have no value and beyond half a turn."""
        found = self._at(x, False)
        if found is None:
            return -np.inf
        return self._log_uniform(np.asarray(x, float))[0] - 0.5 * _square(found[0])

    def log_posterior_gradient(self, x: ArrayLike) -> Array:
        """(P,): its derivatives."""
        return self.log_posterior_and_gradient(x)[1]

    def log_posterior_and_gradient(self, x: ArrayLike) -> tuple[float, Array]:
        """Both at once; -inf and NaN where there is no value."""
        r, J = self.residuals_and_jacobian(x)
        value, by = self._log_uniform(np.asarray(x, float))
        value -= 0.5 * _square(r)
        return (-np.inf if np.isnan(value) else value), by - J.T @ r

    def residuals_and_jacobian(self, x: ArrayLike) -> tuple[Array, Array]:
        """Both at once; NaN where they have no value."""
        found = self._at(x, True)
        if found is None:
            n, p = self.size, len(self.names)
            return np.full(n, np.nan), np.full((n, p), np.nan)
        return found

    def covariance(self, x: ArrayLike) -> Array:
        """(P, P): Laplace's, (J^T J)^-1 at x. ValueError where the residuals do not determine all
        of the unknowns."""
        J = self.jacobian(x)
        scales = np.sqrt(np.sum(J * J, axis=0))
        if not np.all(np.isfinite(J)) or not np.all(scales > 0.0):
            raise ValueError(_undetermined(self.names, scales))
        _, s, V = np.linalg.svd(J / scales, full_matrices=False)
        if s[-1] <= _NOTHING * s[0]:
            raise ValueError(_undetermined(self.names, 1.0 - np.abs(V[-1])))
        root = (V.T / s) / scales[:, None]
        return root @ root.T

    def _at(self, x: ArrayLike, derivatives: bool) -> Any:
        """Residuals and perhaps derivatives; of the last x once."""
        x = np.ascontiguousarray(_numbers(x, "x"))
        key = x.tobytes()
        last = self._last
        if derivatives and last is not None and last[0] == key:
            return last[1]
        found = self._compiled.at(x, derivatives)
        if derivatives:
            self._last = (key, found, None)
        return found

    def _log_uniform(self, x: Array) -> tuple[float, Array]:
        """Of the turn, the first three unknowns where the attitude is one."""
        gradient = np.zeros(len(x))
        if not self.names or self.names[0] != "turn_x":
            return 0.0, gradient
        a = float(np.sqrt(x[:3] @ x[:3]))
        if a >= np.pi:
            return -np.inf, gradient
        if a < _SMALL:
            gradient[:3] = -x[:3] / 6.0
            return -a * a / 12.0, gradient
        gradient[:3] = (1.0 / np.tan(0.5 * a) - 2.0 / a) / a * x[:3]
        return 2.0 * float(np.log(np.sin(0.5 * a) / (0.5 * a))), gradient


def _made(cls: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> ResidualFunction:
    return cls(*arguments, **keywords)


# Singular values below this part of the largest are rounding.
_NOTHING = 1e-12
# Angles whose fourth power is nothing beside 1.
_SMALL = 1e-4


def _square(r: Array) -> float:
    return float(r @ r)


def _undetermined(names: tuple[str, ...], least: Array) -> str:
    name = names[int(np.argmin(np.nan_to_num(least)))]
    return (
        f"covariance: the residuals do not determine all unknowns, such as {name}; expected more "
        "data, a prior, or fewer unknowns"
    )
