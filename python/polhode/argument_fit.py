# SPDX-License-Identifier: MIT
"""Terms of given arguments, as theories of Moon and Earth have them, fitted by least squares."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode._core import _numbers
from polhode.harmonics import legendre_columns, powers_of_time

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

# How much larger an error of the rows may be in a coefficient than in that of its term alone.
_LARGEST_GROWTH = 2.0


@dataclass(frozen=True, eq=False)
class ArgumentFit:
    """y = sum_k polynomial[k] t^k + sum_j ((cosine[j] + cosine_change[j] t) cos(m_j.a)
    + (sine[j] + sine_change[j] t) sin(m_j.a)), a = at_epoch + rates t.

    Made by `argument_fit`. Coefficients belong to the arguments' own phases, as those of published
    tables do. `multiples` (J, A) are as given; changes are 0 where none were asked for; `rms` is
    the root mean square of what is left. Fitted to K series, polynomial (degree + 1, K), the
    coefficients (J, K) and rms (K,) have one more axis, that of the series.
    """

    polynomial: Array
    at_epoch: Array
    rates: Array
    multiples: NDArray[np.int64]
    cosine: Array
    sine: Array
    cosine_change: Array
    sine_change: Array
    rms: Any

    @property
    def periods(self) -> Array:
        """(J,): of each term, not negative."""
        return 2 * np.pi / np.abs(self.multiples @ self.rates)

    def at(self, t: ArrayLike) -> Array:
        """The fitted curve at times (N,): (N,) or (N, K)."""
        times = _numbers(t, "t")[..., None]
        angle = (self.at_epoch + self.rates * times) @ self.multiples.T
        drift = times ** np.arange(len(self.polynomial)) @ self.polynomial
        c, s = np.cos(angle), np.sin(angle)
        return (
            drift
            + c @ self.cosine
            + s @ self.sine
            + (times * c) @ self.cosine_change
            + (times * s) @ self.sine_change
        )


def argument_fit(
    t: ArrayLike,
    y: ArrayLike,
    at_epoch: ArrayLike,
    rates: ArrayLike,
    multiples: ArrayLike,
    degree: int = 1,
    *,
    changes: bool | Sequence[bool] = False,
) -> ArgumentFit:
    """Least squares of a polynomial of t and of cosines and sines of combinations of arguments.

    Parameters
    ----------
    t : (N,), times in any order, counted from the epoch of the arguments.
    y : (N,) or (N, K): one series, or several at the same times. Angles must be unwrapped:
        `numpy.unwrap`.
    at_epoch : (A,), rad: the arguments at t = 0.
    rates : (A,), rad per unit of t. `nutation_theory(...)` has both for Delaunay's arguments, per
        second.
    multiples : (J, A), whole numbers: of the arguments in each term.
    degree : of the polynomial: 0 is a mean, 1 a mean and a rate.
    changes : whether the coefficients of a term grow with t, too: True, or one bool per term.

    ValueError for shapes that do not fit, multiples that are not whole, terms that do not turn, too
    few rows, numbers that are not finite, and terms that the rows do not tell apart: an error of
    the rows may be twice as large in a coefficient as it would be without the other terms.
    """
    times, series = _series(t, y)
    epoch, n, m = _arguments(at_epoch, rates, multiples)
    growing = _growing(changes, len(m))
    degree = operator.index(degree)
    if degree < 0:
        raise ValueError(f"argument_fit: got degree {degree}; expected 0, 1, 2, ...")
    unknowns = degree + 1 + 2 * len(m) + 2 * int(np.count_nonzero(growing))
    if len(times) < unknowns:
        raise ValueError(f"argument_fit: {len(times)} rows are fewer than the {unknowns} unknowns")

    # In x = (t - middle)/half, from -1 to 1, powers of the time stay apart.
    low, high = times.min(), times.max()
    middle, half = (low + high) / 2, (high - low) / 2 or 1.0
    x = (times - middle) / half
    angle = (epoch + n * times[:, None]) @ m.T
    waves = [np.cos(angle), np.sin(angle)]
    columns = np.hstack(
        [legendre_columns(x, degree), *waves, *(x[:, None] * w[:, growing] for w in waves)]
    )
    _require_apart(columns, degree + 1, m, high - low)
    linear = np.linalg.lstsq(columns, series, rcond=None)[0]
    rms = np.sqrt(np.mean((series - columns @ linear) ** 2, axis=0))
    fit = _in_time(linear, degree, growing, middle, half)
    if np.ndim(y) == 1:
        fit, rms = [part[:, 0] for part in fit], float(rms[0])
    power, cosine, sine, cosine_change, sine_change = fit
    return ArgumentFit(power, epoch, n, m, cosine, sine, cosine_change, sine_change, rms)


def _series(t: ArrayLike, y: ArrayLike) -> tuple[Array, Array]:
    times, series = _numbers(t, "t"), _numbers(y, "y")
    if times.ndim != 1 or series.ndim not in (1, 2) or len(series) != len(times):
        raise ValueError(f"argument_fit: got t of shape {times.shape} and y of {series.shape}; "
                         "expected (N,) and (N,) or (N, K)")  # fmt: skip
    if not np.all(np.isfinite(times)) or not np.all(np.isfinite(series)):
        raise ValueError("argument_fit: t and y must be finite")
    return times, series.reshape(len(times), -1 if series.size else 1)


def _arguments(
    at_epoch: ArrayLike, rates: ArrayLike, multiples: ArrayLike
) -> tuple[Array, Array, NDArray[np.int64]]:
    epoch, n = _numbers(at_epoch, "at_epoch"), _numbers(rates, "rates")
    given = _numbers(multiples, "multiples")
    if epoch.ndim != 1 or n.shape != epoch.shape:
        raise ValueError(f"argument_fit: got at_epoch of shape {epoch.shape} and rates of "
                         f"{n.shape}; expected (A,) both")  # fmt: skip
    if not np.all(np.isfinite(epoch)) or not np.all(np.isfinite(n)):
        raise ValueError("argument_fit: at_epoch and rates must be finite")
    if given.ndim != 2 or given.shape[1] != len(n):
        raise ValueError(f"argument_fit: got multiples of shape {given.shape}; expected "
                         f"(J, {len(n)}), a row a term")  # fmt: skip
    if not np.all(np.isfinite(given)) or np.any(given != np.rint(given)):
        raise ValueError("argument_fit: multiples must be whole numbers")
    m = given.astype(np.int64)
    for row in m[(m @ n) == 0.0]:
        raise ValueError(f"argument_fit: the term {row.tolist()} does not turn; the mean has it")
    return epoch, n, m


def _growing(changes: bool | Sequence[bool], terms: int) -> NDArray[np.bool_]:
    growing = np.asarray(changes, dtype=bool)
    if growing.shape not in ((), (terms,)):
        raise ValueError(f"argument_fit: got changes {changes}; expected a bool, or one per term")
    return np.broadcast_to(growing, (terms,))


def _require_apart(columns: Array, powers: int, m: NDArray[np.int64], span: float) -> None:
    """ValueError that names the two terms that are most alike, where errors would grow."""
    if len(m) == 0:
        return
    size = np.linalg.norm(columns, axis=0)
    _, s, vt = np.linalg.svd(columns / np.where(size > 0, size, 1.0), full_matrices=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        growth = np.sqrt(np.sum((vt / s[:, None]) ** 2, axis=0))[powers:]
    if np.all(growth <= _LARGEST_GROWTH):
        return
    share = vt[-1, powers : powers + 2 * len(m)].reshape(2, len(m))
    first, *others = np.argsort(np.sum(share**2, axis=0))[::-1]
    other = f"the term {m[others[0]].tolist()}" if others else "the polynomial"
    raise ValueError(
        f"argument_fit: the rows do not tell apart the term {m[first].tolist()} and {other}, or "
        f"their changes: their span is {span:g}; expected a longer one, more rows or fewer terms"
    )


def _in_time(
    linear: Array, degree: int, growing: NDArray[np.bool_], middle: float, half: float
) -> list[Array]:
    """From powers of x to powers of t."""
    J, K = len(growing), linear.shape[1]
    parts = [powers_of_time(linear[: degree + 1], middle, half)]
    changes = []
    rest = linear[degree + 1 + 2 * J :]
    of_growing = np.split(rest, 2)
    for i in range(2):
        change = np.zeros((J, K))
        change[growing] = of_growing[i] / half
        parts.append(linear[degree + 1 + i * J : degree + 1 + (i + 1) * J] - middle * change)
        changes.append(change)
    return [*parts, *changes]
