# SPDX-License-Identifier: MIT
"""A drift and terms of given periods or given arguments, fitted by least squares."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode._core import _numbers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

_MOST_CORRECTIONS = 50
# Smaller corrections of a period, as a part of the turns in the span, change nothing.
_CONVERGED = 1e-12
# Singular values below this part of the largest belong to terms that the rows do not tell apart.
_INDISTINCT = 1e-9
# How much larger an error of the rows may be in a coefficient than in that of the term alone.
_LARGEST_GROWTH = 2.0


@dataclass(frozen=True, eq=False)
class HarmonicFit:
    """y = sum_k polynomial[k] t^k + sum_j (cosine[j] cos(2 pi t/P_j) + sine[j] sin(2 pi t/P_j)).

    Made by `harmonic_fit`. `polynomial[1]` is the rate at t = 0; `periods` are as given, or as
    adjusted; `rms` is the root mean square of what is left. Fitted to K series, polynomial
    (degree + 1, K), cosine and sine (J, K) and rms (K,) have one more axis, that of the series.
    """

    polynomial: Array
    periods: Array
    cosine: Array
    sine: Array
    rms: Any

    @property
    def amplitude(self) -> Array:
        """(J,) or (J, K): of each term, not negative."""
        return np.hypot(self.cosine, self.sine)

    @property
    def phase(self) -> Array:
        """(J,) or (J, K): rad; the term is amplitude cos(2 pi t/P - phase)."""
        return np.arctan2(self.sine, self.cosine)

    def at(self, t: ArrayLike) -> Array:
        """The fitted curve at times (N,): (N,) or (N, K)."""
        times = _numbers(t, "t")[..., None]
        angle = 2 * np.pi * times / self.periods
        drift = times ** np.arange(len(self.polynomial)) @ self.polynomial
        return drift + np.cos(angle) @ self.cosine + np.sin(angle) @ self.sine


def harmonic_fit(
    t: ArrayLike,
    y: ArrayLike,
    periods: ArrayLike,
    degree: int = 1,
    *,
    adjust: bool | Sequence[bool] = False,
) -> HarmonicFit:
    """Least squares of a polynomial of t and a cosine and a sine of each period.

    Parameters
    ----------
    t : (N,), times in any order, evenly spaced or not.
    y : (N,) or (N, K): one series, or several at the same times. Angles must be unwrapped:
        `numpy.unwrap`.
    periods : (J,), in the unit of t.
    degree : of the polynomial: 0 is a mean, 1 a mean and a rate.
    adjust : whether the periods are corrected, too: True, or one bool per period. The given ones
        must be good enough to count the turns: right within half a turn over the span. All series
        share them.

    ValueError for shapes that do not fit, too few rows, numbers that are not finite, terms that
    the rows do not tell apart, and corrections of periods that do not come to an end. Terms are
    apart where an error of the rows is at most twice as large in their amplitudes as it would be
    without the other terms: two periods need a span of half their beat (all of it is safe), a
    period together with a mean and a rate nearly a turn.
    """
    times, series = _series("harmonic_fit", t, y)
    P = _periods(periods)
    free = _adjusted(adjust, P)
    degree = operator.index(degree)
    if degree < 0:
        raise ValueError(f"harmonic_fit: got degree {degree}; expected 0, 1, 2, ...")
    if len(times) < degree + 1 + 2 * len(P) + np.count_nonzero(free):
        raise ValueError(f"harmonic_fit: {len(times)} rows are fewer than the unknowns")

    # In x = (t - middle)/half, from -1 to 1, Legendre's polynomials stay apart.
    low, high = times.min(), times.max()
    middle, half = (low + high) / 2, (high - low) / 2 or 1.0
    x, rates = (times - middle) / half, 2 * np.pi * half / P
    for _ in range(_MOST_CORRECTIONS):
        columns = _columns(x, rates, degree)
        linear = _solved(columns, series, P, high - low)
        if not free.any():
            break
        change = _correction(x, rates, free, columns, series, linear)
        if np.abs(change).max() <= _CONVERGED * rates.max():
            break
        rates[free] += change
        if not np.all(rates > 0):
            raise _endless(P)
    else:
        raise _endless(P)
    _require_apart(columns, np.where(free, 2 * np.pi * half / rates, P), high - low)
    rms = np.sqrt(np.mean((series - columns @ linear) ** 2, axis=0))
    fit = _in_time(linear, rates, middle, half, rms)
    return fit if np.ndim(y) == 2 else _only(fit)


def _series(function: str, t: ArrayLike, y: ArrayLike) -> tuple[Array, Array]:
    times, series = _numbers(t, "t"), _numbers(y, "y")
    if times.ndim != 1 or series.ndim not in (1, 2) or len(series) != len(times):
        raise ValueError(f"{function}: got t of shape {times.shape} and y of {series.shape}; "
                         "expected (N,) and (N,) or (N, K)")  # fmt: skip
    if not np.all(np.isfinite(times)) or not np.all(np.isfinite(series)):
        raise ValueError(f"{function}: t and y must be finite")
    return times, series.reshape(len(times), -1 if series.size else 1)


def _periods(periods: ArrayLike) -> Array:
    P = _numbers(periods, "periods")
    if P.ndim != 1 or not np.all((P > 0) & np.isfinite(P)):
        raise ValueError(f"harmonic_fit: got periods {periods}; expected positive numbers (J,)")
    return P


def _adjusted(adjust: bool | Sequence[bool], P: Array) -> NDArray[np.bool_]:
    free = np.asarray(adjust, dtype=bool)
    if free.shape not in ((), P.shape):
        raise ValueError(f"harmonic_fit: got adjust {adjust}; expected a bool, or one per period")
    return np.broadcast_to(free, P.shape)


def _columns(x: Array, rates: Array, degree: int) -> Array:
    angle = x[:, None] * rates
    return np.hstack([_legendre_columns(x, degree), np.cos(angle), np.sin(angle)])


def _solved(columns: Array, series: Array, P: Array, span: float) -> Array:
    linear, _, rank, _ = np.linalg.lstsq(columns, series, rcond=_INDISTINCT)
    if rank < columns.shape[1]:
        raise _indistinct(columns, P, span)
    return linear


def _require_apart(columns: Array, P: Array, span: float) -> None:
    """ValueError where an error of the rows would grow beyond measure in an amplitude."""
    size = np.linalg.norm(columns, axis=0)
    _, s, vt = np.linalg.svd(columns / size, full_matrices=False)
    growth = np.sqrt(np.sum((vt / s[:, None]) ** 2, axis=0))
    if np.any(growth[len(size) - 2 * len(P) :] > _LARGEST_GROWTH):
        raise _indistinct(columns, P, span)


def _indistinct(columns: Array, P: Array, span: float) -> ValueError:
    """Names the two terms that are most alike in these rows, and what would tell them apart."""
    J = len(P)
    size = np.linalg.norm(columns, axis=0)
    _, _, vt = np.linalg.svd(columns / np.where(size > 0, size, 1.0), full_matrices=False)
    share = vt[-1] ** 2  # of each column in the combination that vanishes, nearly
    of_terms = share[-2 * J : -J] + share[-J:] if J else np.empty(0)
    terms = np.argsort(of_terms)[::-1]
    start = "harmonic_fit: the rows do not tell apart"
    if J == 0 or of_terms[terms[0]] < 0.01:
        return ValueError(f"{start} the powers of the polynomial: their span is {span:g}; expected "
                          "more times, or a smaller degree")  # fmt: skip
    alike = "at these times they are alike; expected denser or uneven times, or fewer terms"
    first = P[terms[0]]
    if J == 1 or of_terms[terms[1]] < 0.1 * of_terms[terms[0]]:
        start += f" the period {float(first)!r} and the polynomial: "
        enough = 1.5 * first
        return ValueError(start + (alike if span > enough else f"their span is {span:g}; expected "
                                  f"a span of {enough:g}, or fewer terms"))  # fmt: skip
    first, second = P[np.sort(terms[:2])]
    pair = f"the periods {float(first)!r} and {float(second)!r}"
    turns = abs(1.0 / first - 1.0 / second)
    if turns * span > 1.0:
        return ValueError(f"{start} {pair}: {alike}")
    if turns == 0.0:
        return ValueError(f"{start} {pair}: expected one of them")
    return ValueError(f"{start} {pair}: their span is {span:g}; expected a span of their beat, "
                      f"{1.0 / turns:g}, or one of the two")  # fmt: skip


def _correction(
    x: Array, rates: Array, free: Array, columns: Array, series: Array, linear: Array
) -> Array:
    """A Gauss-Newton step of the free rates, what the linear unknowns take up projected out."""
    J = len(rates)
    a, b = linear[-2 * J : -J][free], linear[-J:][free]
    angle = x[:, None] * rates[free]
    sines, cosines = x[:, None] * np.sin(angle), x[:, None] * np.cos(angle)
    q, _ = np.linalg.qr(columns)
    slopes = np.vstack([b[:, k] * cosines - a[:, k] * sines for k in range(series.shape[1])])
    slopes = np.vstack([s - q @ (q.T @ s) for s in np.split(slopes, series.shape[1])])
    left = (series - columns @ linear).T.ravel()
    change, _, rank, _ = np.linalg.lstsq(slopes, left, rcond=None)
    if rank < slopes.shape[1]:
        raise ValueError(
            "harmonic_fit: the rows do not say which way a period changes: its term is absent, or "
            "that of another; expected adjust=False for it"
        )
    return change


def _endless(P: Array) -> ValueError:
    return ValueError(f"harmonic_fit: the corrections of the periods {P.tolist()} do not come to "
                      "an end; start nearer to them")  # fmt: skip


def _in_time(linear: Array, rates: Array, middle: float, half: float, rms: Array) -> HarmonicFit:
    """From polynomials and angles of x to powers and angles of t."""
    J = len(rates)
    degree = len(linear) - 2 * J - 1
    power = _powers_of_time(linear[: degree + 1], middle, half)
    a, b = linear[degree + 1 : degree + 1 + J], linear[degree + 1 + J :]
    turn = (rates * middle / half)[:, None]
    cosine, sine = a * np.cos(turn) - b * np.sin(turn), a * np.sin(turn) + b * np.cos(turn)
    return HarmonicFit(power, 2 * np.pi * half / rates, cosine, sine, rms)


def _only(fit: HarmonicFit) -> HarmonicFit:
    return HarmonicFit(fit.polynomial[:, 0], fit.periods, fit.cosine[:, 0], fit.sine[:, 0],
                       float(fit.rms[0]))  # fmt: skip


# NumPy imports its module of polynomials when one is made: it takes 5 ms.
def _legendre_columns(x: Array, degree: int) -> Array:
    """(N, degree + 1): the Legendre polynomials at x (N,), from -1 to 1."""
    from numpy.polynomial import legendre

    return legendre.legvander(x, degree)


def _powers_of_time(coefficients: Array, middle: float, half: float) -> Array:
    """(degree + 1, K): sums of Legendre polynomials of x = (t - middle)/half in powers of t."""
    from numpy.polynomial import Polynomial, legendre

    x = Polynomial([-middle / half, 1 / half])
    power = np.zeros_like(coefficients)
    for k, of_one in enumerate(coefficients.T):
        in_t = Polynomial(legendre.leg2poly(of_one))(x).coef
        power[: len(in_t), k] = in_t
    return power


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
    times, series = _series("argument_fit", t, y)
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
        [_legendre_columns(x, degree), *waves, *(x[:, None] * w[:, growing] for w in waves)]
    )
    _require_terms_apart(columns, degree + 1, m, high - low)
    linear = np.linalg.lstsq(columns, series, rcond=None)[0]
    rms = np.sqrt(np.mean((series - columns @ linear) ** 2, axis=0))
    fit = _terms_in_time(linear, degree, growing, middle, half)
    if np.ndim(y) == 1:
        fit, rms = [part[:, 0] for part in fit], float(rms[0])
    power, cosine, sine, cosine_change, sine_change = fit
    return ArgumentFit(power, epoch, n, m, cosine, sine, cosine_change, sine_change, rms)


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


def _require_terms_apart(columns: Array, powers: int, m: NDArray[np.int64], span: float) -> None:
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


def _terms_in_time(
    linear: Array, degree: int, growing: NDArray[np.bool_], middle: float, half: float
) -> list[Array]:
    """From powers of x to powers of t."""
    J, K = len(growing), linear.shape[1]
    parts = [_powers_of_time(linear[: degree + 1], middle, half)]
    changes = []
    rest = linear[degree + 1 + 2 * J :]
    of_growing = np.split(rest, 2)
    for i in range(2):
        change = np.zeros((J, K))
        change[growing] = of_growing[i] / half
        parts.append(linear[degree + 1 + i * J : degree + 1 + (i + 1) * J] - middle * change)
        changes.append(change)
    return [*parts, *changes]
