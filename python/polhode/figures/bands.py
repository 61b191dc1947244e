# SPDX-License-Identifier: MIT
"""Curves that go up and down faster than a picture can show: bands between least and largest value.

A line that swings SWINGS times in BIN points of the paper fills the panel. Of such a curve each bin
of time shows the range of its values, and a line their mean."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from polhode.figures.style import Look, faded

Numbers = NDArray[np.float64]
BIN = 4.0
"""Points of the paper for one bin: about four widths of a line."""
SWINGS = 1.5
"""A curve is too dense when half of its bins have more swings, there and back, than this."""
DRIFT = 0.25
"""Turns from bin to bin above which an angle goes round; below it swings."""
FAR_STEP = 0.25
"""Turns from row to row above which rows do not say which way an angle went."""
ROUNDING = 1e-12
"""Relative size of swings that are those of rounding: a constant is a line."""
OPACITY, PALE_OPACITY = 0.24, 0.13


def bin_count(ax: Axes) -> int:
    """How many bins the width of Axes has."""
    inches = ax.get_position().width * ax.get_figure().get_size_inches()[0]
    return max(8, round(72.0 * inches / BIN))


@dataclass(frozen=True)
class Bins:
    """Rows by bins of time; bins without rows are left out."""

    t: Numbers
    """Middle of each bin; the first and the last reach to the ends of the run."""
    first: NDArray[np.intp]
    """First row of each bin."""
    kept: NDArray[np.intp]
    """Number of each bin, counted with those left out."""
    place: Numbers
    """Time of each row, in bins since the start."""
    weights: Numbers
    """The time that each row stands for."""

    @staticmethod
    def of(t: Numbers, count: int) -> Bins:
        place = count * ((t - t[0]) / (t[-1] - t[0]))  # a run may go back in time
        number = np.minimum(place.astype(np.intp), count - 1)
        kept, first = np.unique(number, return_index=True)
        middle = t[0] + (t[-1] - t[0]) * (kept + 0.5) / count
        middle[0], middle[-1] = t[0], t[-1]
        return Bins(middle, first, kept, place, np.abs(np.gradient(t)))

    def least(self, values: Numbers) -> Numbers:
        return np.fmin.reduceat(values, self.first)

    def largest(self, values: Numbers) -> Numbers:
        return np.fmax.reduceat(values, self.first)

    def mean(self, values: Numbers) -> Numbers:
        """Over time, falling off to the middles of the neighbours: of what swings in a bin, a mean
        with sharp ends would leave a beat. NaN where there is no value."""
        there = np.isfinite(values)
        left = np.floor(self.place - 0.5).astype(np.intp)
        share = self.place - 0.5 - left

        def total(of: Numbers) -> Numbers:
            parts = (np.bincount(left + k + 1, weight * of[there], self.kept[-1] + 3)
                     for k, weight in ((0, 1.0 - share), (1, share)))  # fmt: skip
            return np.asarray(sum(parts))[self.kept + 1]

        left, share = left[there], share[there]
        time = total(self.weights)
        whole = total(self.weights * values)
        return np.divide(whole, time, out=np.full(time.size, np.nan), where=time > 0.0)

    def swings(self, values: Numbers) -> float:
        """How often, in half of the bins or more, values go there and back between the least and
        the largest of their bin."""
        steps = np.abs(np.diff(values, append=np.nan))
        path = np.add.reduceat(np.where(np.isfinite(steps), steps, 0.0), self.first)
        size = self.largest(values) - self.least(values)
        paths = np.divide(path, size, out=np.zeros(path.size), where=size > 0.0)
        return 0.5 * float(np.median(paths))


@dataclass(frozen=True)
class Band:
    """A curve too dense to draw: in each bin its least and largest value, and the mean.

    goes_round: of an angle that turns within every bin, so that its mean says nothing. (How often
    it turned is not said: rows may be more than a turn apart.)"""

    t: Numbers
    low: Numbers
    high: Numbers
    mean: Numbers
    goes_round: bool = False
    edge: float = 0.0
    """Of a wrapped angle: where its range begins."""


def band(t: Numbers, values: Numbers, count: int, turn: float | None = None) -> Band | None:
    """The band of a curve over so many bins; None for one that can be drawn as it is.

    turn: a full turn of an angle that is wrapped, in its unit."""
    finite = values[np.isfinite(values)]
    if t.size < 4 * count or t[-1] == t[0] or finite.size < 2:
        return None
    if np.ptp(finite) <= ROUNDING * np.max(np.abs(finite)):
        return None
    bins = Bins.of(t, count)
    if turn is None:
        return of_swings(bins, values)
    found = band_of_angle(bins, values, finite, count, turn)
    begins = 0.0 if np.min(finite) >= 0.0 else -0.5 * turn
    return None if found is None else replace(found, edge=begins)


def band_of_angle(
    bins: Bins, values: Numbers, finite: Numbers, count: int, turn: float
) -> Band | None:
    along = np.full(values.size, np.nan)
    along[np.isfinite(values)] = np.unwrap(finite, period=turn)
    if np.nanquantile(np.abs(np.diff(along)), 0.9) > FAR_STEP * turn:
        size = bins.largest(values) - bins.least(values)
        full = np.median(size) > (1.0 - FAR_STEP) * turn
        return everywhere(bins, finite) if full else of_swings(bins, values)
    drift = np.diff(bins.mean(along))
    if np.median(np.abs(drift)) > DRIFT * turn:
        return everywhere(bins, finite) if np.nansum(np.abs(drift)) > turn * count else None
    return of_swings(bins, along)


def of_swings(bins: Bins, values: Numbers) -> Band | None:
    if not bins.swings(values) > SWINGS:
        return None
    low, high = bins.least(values), bins.largest(values)
    return Band(bins.t, low, high, np.clip(bins.mean(values), low, high))


def everywhere(bins: Bins, finite: Numbers) -> Band:
    whole = np.ones_like(bins.t)
    return Band(bins.t, np.min(finite) * whole, np.max(finite) * whole, np.nan * whole, True)


def draw_band(ax: Axes, curve: Band, look: Look, label: str, gid: str, turn: float | None) -> None:
    """The band pale, its mean as a line; of an angle that goes round a paler one alone."""
    if curve.goes_round:
        color, said = faded(look.color, PALE_OPACITY), f"{label} goes round"
        ax.fill_between(curve.t, curve.low, curve.high, color=color, linewidth=0.0, label=said,
                        gid=gid, zorder=0.5)  # fmt: skip
        return
    t, low, high, mean = wrapped(curve, turn)
    ax.fill_between(t, low, high, color=look.color, alpha=OPACITY, linewidth=0.0,
                    gid=f"{gid}-band", zorder=1.5)  # fmt: skip
    ax.plot(t, mean, **look.line, label=label, gid=gid)


def wrapped(curve: Band, turn: float | None) -> tuple[Numbers, ...]:
    """Time, both edges and mean as they are drawn: those of a wrapped angle once for each turn that
    they reach into, with NaN between."""
    if turn is None or np.isnan(curve.low).all():
        return curve.t, curve.low, curve.high, curve.mean
    least, largest, edge = np.nanmin(curve.low), np.nanmax(curve.high), curve.edge
    parts = []
    for k in range(int((least - edge) // turn), int((largest - edge) // turn) + 1):
        low, high, mean = (x - k * turn for x in (curve.low, curve.high, curve.mean))
        inside = (high >= edge) & (low <= edge + turn)
        within = (mean >= edge) & (mean <= edge + turn)
        edges = (np.where(inside, np.clip(x, edge, edge + turn), np.nan) for x in (low, high))
        part = np.stack([curve.t, *edges, np.where(within, mean, np.nan)])
        parts += [part, np.full((4, 1), np.nan)]
    return tuple(np.concatenate(parts[:-1], axis=1))


def drawn_as_band(
    ax: Axes,
    t: Numbers,
    values: Numbers,
    look: Look,
    turn: float | None,
    label: str,
    gid: str,
) -> bool:
    """Draws the band of a curve that as a line would fill the Axes; False for any other curve."""
    found = band(t, values, bin_count(ax), turn)
    if found is not None:
        draw_band(ax, found, look, label, gid, turn)
    return found is not None


def legends(panels: Iterable[Axes], **keywords: Any) -> None:
    """A legend on the right of each panel that has labels; the first one with bands says what they
    are."""
    said = False
    for ax in panels:
        if not ax.get_legend_handles_labels()[1]:
            continue
        banded = any(str(c.get_gid()).endswith("-band") for c in ax.collections)
        title = "bands: least to\nlargest; lines:\nmeans" if banded and not said else None
        said = said or banded
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), title=title, title_fontsize=6.0,
                  alignment="left", **keywords)  # fmt: skip
