# SPDX-License-Identifier: MIT
"""A start without free wobble: the axis goes where the torques take it, and nothing else."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _core
from polhode._core import _numbers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]
    Method = _core.Adaptive | _core.Collocation | _core.Splitting | _core.VariationOfConstants

# Half a run tells the wobble from what stands still in the body: the window is 0 at three periods.
_LEAST_PERIODS = 6
_ROUNDS = 16
# Rows: a rotation of 6, a wobble of 64 at least; no more than memory takes without notice.
_ROWS_PER_TURN = 6
_ROWS_PER_WOBBLE = 64
_MOST_ROWS = 1 << 18
# A round that takes away less than this part of the wobble is the last one.
_GAIN = 0.5
# What a wobble that goes away has fallen to, and rad that are too few to ask about.
_REMOVED = 0.1
_SMALL = 1e-8
# An amplitude that has fallen below this part of the first one shows no rate of its own.
_FAINT = 1e-3


@dataclass(frozen=True, eq=False)
class FreeWobble:
    """The free wobble of a start, and the start without it. Made by `without_free_wobble`.

    `state`: RotorState with the attitude and the spin about the axis as they were. `removed`, rad:
    largest angle between axis and momentum in the wobble that was taken away. `left`, rad: of what
    either half of the last run still shows. `period`: of the wobble, as the body sees it. `axis`:
    1 or 3, the principal axis that the body turns about.
    """

    state: _core.RotorState
    removed: float
    left: float
    period: float
    axis: int


@dataclass(frozen=True)
class _Mode:
    """The free wobble near a principal axis: p = scale_i g_i + i scale_j g_j turns at `rate`.

    p is scaled so that |p|^2 = |2 I_k T - G^2|, which the free motion keeps: the ellipse of (g_i,
    g_j) becomes a circle. [SA (24)]
    """

    axis: int  # k, from 0; i and j follow it
    scale: Array
    rate: float

    @property
    def others(self) -> list[int]:
        return [(self.axis + 1) % 3, (self.axis + 2) % 3]

    def angle(self, amplitude: complex, g: Array) -> float:
        """Largest angle between axis and momentum."""
        return math.atan2(abs(amplitude) / self.scale.min(), abs(g[self.axis]))


def _mode(body: _core.Body, state: _core.RotorState) -> _Mode:
    moments = np.asarray(body.moments)
    free = _core.FreeRotation(body, state)
    w = np.asarray(state.g) / moments
    short = free.regime == _core.Regime.short_axis
    if free.regime == _core.Regime.steady:
        short = int(np.argmax(np.abs(w))) == 2
    axis = 2 if short else 0
    if not math.isfinite(free.polhode_period) or w[axis] == 0:
        raise ValueError(
            f"without_free_wobble: got omega_B = {w.tolist()} of moments {moments.tolist()}; "
            "expected rotation near an axis of the largest or smallest moment that no other axis "
            "shares"
        )
    i, j = (axis + 1) % 3, (axis + 2) % 3
    scale = np.sqrt(np.abs(moments[axis] - moments[[i, j]]) / moments[[i, j]])
    sense = math.copysign(1.0, w[axis]) * (1.0 if axis == 2 else -1.0)
    return _Mode(axis, scale, sense * 2 * math.pi / free.polhode_period)


def _offsets(span: float, turns: float, periods: int) -> Array:
    """Times in the middle of equal parts of the span: every turn is resolved, or else neither it
    nor its half looks slow."""
    rows = max(_ROWS_PER_WOBBLE * periods, math.ceil(_ROWS_PER_TURN * turns))
    if rows > _MOST_ROWS:
        counts = np.arange(_MOST_ROWS, _MOST_ROWS + 256)
        phases = np.outer([1.0, 2.0], turns / counts)
        rows = int(counts[np.argmax(np.abs(phases - np.round(phases)).min(axis=0))])
    return (np.arange(rows) + 0.5) * (span / rows)


def _amplitude(t: Array, p: Any, rate: float) -> complex:
    """Of exp(i rate t) in p: a mean with the window sin^4, whose side lobes fall as f^-5."""
    window = np.sin(np.pi * (np.arange(len(t)) + 0.5) / len(t)) ** 4
    return complex((window * p * np.exp(-1j * rate * t)).sum() / window.sum())


def _halves(t: Array, p: Any, rate: float) -> tuple[complex, complex]:
    half = len(t) // 2
    return _amplitude(t[:half], p[:half], rate), _amplitude(t[half:], p[half:], rate)


def _seen_rate(t: Array, p: Any, rate: float) -> float:
    """The rate of the wobble under the torques: how far its phase falls behind that of `rate`."""
    first, second = _halves(t, p, rate)
    if not abs(abs(first) - abs(second)) < 0.1 * abs(first):  # none, or not one line alone
        return rate
    return rate + float(np.angle(second / first)) / (t[len(t) // 2] - t[0])


def without_free_wobble(
    system: _core.System,
    initial: _core.RotorState,
    start: float = 0.0,
    method: Method | None = None,
    *,
    periods: int = 6,
    damper_rate: ArrayLike = (0.0, 0.0, 0.0),
) -> FreeWobble:
    """The start from which the body does not wobble but for what the torques make of it.

    A body whose axis is somewhere near its forced path circles it at the rate of the free motion.
    The wobble in a run is what turns at this rate in sqrt(I_i |I_k - I_i|) omega_i, i = the two
    axes other than k, that of the rotation; it is taken away from the start, and again from
    what is left, until that does not fall. The attitude and the spin about the axis stay.

    Parameters
    ----------
    system : System.
    initial : one RotorState at `start`, near rotation about an axis of the largest or smallest
        moment: its free motion is that of the short or the long axis.
    start : in the unit of time of the system.
    method : of the runs. None: that of a Problem without one.
    periods : length of the runs, in free wobbles as the body sees them, 6 or more: the more, the
        better it is told from what the torques do at nearly the same rate.
    damper_rate : (3,), as in Problem.

    Returns
    -------
    FreeWobble

    Raises
    ------
    ValueError
        For rotation about the middle axis or none, for an axis with a moment that another one
        shares, and where the wobble does not go away: something in the body answers at its rate, or
        damps it within the run.

    Runs the system for `periods` wobbles a few times. [SA (24)]
    """
    start, periods = float(_numbers(start, "start")), _whole_periods(periods)
    how = {} if method is None else {"method": method}
    mode = _mode(system.body, initial)
    q, g = np.array(initial.q), np.array(initial.g)
    span = periods * 2 * math.pi / abs(mode.rate)
    turns = span * abs(g[mode.axis]) / system.body.moments[mode.axis] / (2 * math.pi)
    offsets = _offsets(span, turns, periods)

    amplitudes: list[complex] = []
    kept, left, rate = g, 0.0, mode.rate
    for _ in range(_ROUNDS):
        problem = _core.Problem(
            system, _core.RotorState(q, g), start, start + span, **how, damper_rate=damper_rate
        )
        p = _circle(problem, start + offsets, mode)
        # The rate depends on the amplitude.
        if not amplitudes or abs(amplitudes[-1]) > _FAINT * abs(amplitudes[0]):
            rate = _seen_rate(offsets, p, rate)
        amplitude = _amplitude(offsets, p, rate)
        if amplitudes and abs(amplitude) > _GAIN * abs(amplitudes[-1]):
            break
        amplitudes.append(amplitude)
        # A torque at the rate of the wobble leaves one that grows, and is 0 in the mean alone.
        kept, left = g.copy(), max(map(abs, _halves(offsets, p, rate)))
        g[mode.others] -= np.array([amplitude.real, amplitude.imag]) / mode.scale

    first, last = mode.angle(amplitudes[0], kept), mode.angle(left, kept)
    if last > max(_REMOVED * first, _SMALL):
        raise ValueError(
            f"without_free_wobble: a wobble of {first:.3g} rad with a period of "
            f"{2 * math.pi / abs(rate):.6g} does not go away: {last:.3g} rad are left; torques or "
            "damping turn the body at that rate: expected a free wobble, or more periods"
        )
    removed = mode.angle(sum(amplitudes[:-1], 0j), kept)
    return FreeWobble(
        _core.RotorState(q, kept), removed, last, 2 * math.pi / abs(rate), mode.axis + 1
    )


def _whole_periods(periods: int) -> int:
    number = float(_numbers(periods, "periods"))
    if not number >= _LEAST_PERIODS or not number.is_integer():
        raise ValueError(
            f"without_free_wobble: got periods = {periods}; expected a whole number, "
            f"{_LEAST_PERIODS} or more"
        )
    return int(number)


def _circle(problem: _core.Problem, times: Array, mode: _Mode) -> Any:
    """p of the run at the times (N,), which must all be reached."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        run = _core.integrate(problem, times, dense=False)
    if len(run.t) < len(times):
        raise ValueError(
            f"without_free_wobble: the run to t = {problem.stop:.6g} ended early: {run.outcome}"
        )
    g = run.g[:, mode.others] * mode.scale
    return g[:, 0] + 1j * g[:, 1]
