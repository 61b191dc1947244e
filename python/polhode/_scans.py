# SPDX-License-Identifier: MIT
"""Fourier scans of light curves over pairs of frequencies: which two periods a tumbler shows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from polhode import _core
from polhode._arguments import one_of, whole
from polhode._core import _number
from polhode._light_bodies import LightCurve, curve_parts

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class ScanMinimum(NamedTuple):
    """A minimum of chi-square, refined: frequencies in turns per unit of time, with errors as
    sigmas are given. `resolved`: the harmonics are told apart there; `at_edge`: the least may lie
    beyond the grid."""

    f1: float
    f2: float
    sigma_f1: float
    sigma_f2: float
    chi_square: float
    degrees_of_freedom: int
    converged: bool
    resolved: bool
    at_edge: bool


class PeriodLabel(NamedTuple):
    """Which periods a pair of frequencies may be: f1 is |j f_phi + k f_psi| / over for (j, k, over)
    = first, f2 the same of second. `of_ellipsoid`: a body with three planes of symmetry shows
    both."""

    mode: str
    precession_period: float
    rotation_period: float
    first: tuple[int, int, int]
    second: tuple[int, int, int]
    of_ellipsoid: bool


@dataclass(frozen=True, eq=False)
class FourierScan:
    """Chi-square of two-dimensional Fourier series by two frequencies, and its minima.

    Made by fourier_scan, and by fit_scenario of light curves; figures.scan_landscape draws it.

    Attributes
    ----------
    f1, f2 : (M,), (N,), turns per unit of time.
    chi_square : (M, N); of a file with fit.scan.sessions = "separate" the sum over sessions.
    minima : ScanMinimum by chi-square, the lowest first.
    order : of the series. points : how many there are. unit : of time, empty if none is known.
    """

    f1: Array
    f2: Array
    chi_square: Array
    minima: list[ScanMinimum]
    order: int
    points: int
    _compiled: Any = None
    unit: str = ""

    def periods(self, pairs: int = 5, labels: int = 20) -> list[tuple[str, float, float]]:
        """(mode, P_phi, P_psi) that the lowest minima may be of an ellipsoid, for search_light:
        of `pairs` of them, each with the most likely `labels`. Minima that are not resolved or lie
        at the edge are left out."""
        return self._compiled.periods(whole(pairs, "pairs"), whole(labels, "labels"))

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        if self._compiled is None:
            return FourierScan, (self.f1, self.f2, self.chi_square, self.minima, self.order,
                                 self.points, None, self.unit)  # fmt: skip
        return scan_of, (self._compiled, self.order, self.points, self.unit)

    def to_xarray(self) -> Any:
        """The landscape as an xarray.DataArray along f1 and f2."""
        from polhode._tables import imported

        return imported("xarray").DataArray(
            self.chi_square, {"f1": self.f1, "f2": self.f2}, ("f1", "f2"), "chi_square",
            {"order": self.order, "points": self.points},
        )  # fmt: skip

    def __repr__(self) -> str:
        lines = [
            f"  f1 {m.f1:.6g}, f2 {m.f2:.6g}: chi-square {m.chi_square:.5g}"
            for m in self.minima[:5]
        ]
        size = " x ".join(str(n) for n in self.chi_square.shape)
        head = f"<FourierScan: {size} pairs at order {self.order}, {len(self.minima)} minima"
        return "\n".join([head, *lines]) + ">"


@dataclass(frozen=True)
class ScanAdvice:
    """What the times of light curves say of a scan; made by scan_advice.

    Attributes
    ----------
    least, most, step : of a grid of frequencies, turns per unit of time.
    time_base : from the first point to the last. typical_gap : from one to the next.
    aliases : (frequency, height): a line at f0 shows at f0 +- frequency, too.
    """

    least: float
    most: float
    step: float
    time_base: float
    typical_gap: float
    aliases: list[tuple[float, float]]


def scan_advice(curves: LightCurve | Iterable[LightCurve], order: int = 3) -> ScanAdvice:
    """How fine a grid of frequencies must be, and which ones the points can show."""
    found = _core._scan_advice(curve_parts(curves), whole(order, "order"))
    return ScanAdvice(**found)


def fourier_scan(
    curves: LightCurve | Iterable[LightCurve],
    f1: Sequence[float] | None = None,
    f2: Sequence[float] | None = None,
    *,
    order: int = 3,
    quantity: str = "flux",
    minima: int = 20,
    threads: int = 1,
) -> FourierScan:
    """Chi-square of two-dimensional Fourier series of light curves, and its minima.

    Parameters
    ----------
    curves : LightCurve, one or several; vectors are not looked at.
    f1, f2 : (least, most) or (least, most, step), turns per unit of time. None: what scan_advice
        says of f1, and f2 as f1.
    order : of the harmonics j f1 + k f2, 1 to 9.
    quantity : "flux", or "log_flux", whose factors of sessions are exact.
    minima : how many are refined, the lowest.
    threads : the bits of the result do not depend on it.

    DomainError (a ValueError) for light curves that are not sound, grids that do not rise, no more
    points than the series has unknowns. Ctrl-C ends it. Releases the GIL. (Kaasalainen 2001;
    Pravec et al. 2005)
    """
    parts, n = curve_parts(curves), whole(order, "order")
    advice = _core._scan_advice(parts, n)
    first = _grid(f1, "f1", (advice["least"], advice["most"], advice["step"]))
    second = first if f2 is None else _grid(f2, "f2", first)
    found = _core._fourier_scan(
        parts, first, second, n, one_of(quantity, "quantity", ("flux", "log_flux")) == "log_flux",
        whole(minima, "minima"), whole(threads, "threads"),
    )  # fmt: skip
    return scan_of(found, n, sum(len(table) for *_, table in parts))


def scan_of(found: Any, order: Any, points: Any, unit: str = "") -> FourierScan:
    minima = [ScanMinimum(**m) for m in found.minima]
    return FourierScan(found.f1, found.f2, found.chi_square, minima, order, points, found, unit)


class LikelyPeriods(NamedTuple):
    """Periods that a whole Fourier series speaks for: score is the mean of ln s over the power of
    its lines, below 0, s the share that each has in the light of ellipsoids."""

    mode: str
    precession_period: float
    rotation_period: float
    score: float


def likely_periods(
    curves: LightCurve | Iterable[LightCurve], f1: float, f2: float, *, order: int = 3
) -> list[LikelyPeriods]:
    """Which periods of precession and rotation all lines of a Fourier series speak for.

    Parameters
    ----------
    curves : LightCurve, one or several; vectors are not looked at.
    f1, f2 : where a scan has a minimum, turns per unit of time.
    order : of the harmonics j f1 + k f2, 1 to 9.

    Returns
    -------
    list of LikelyPeriods
        The most likely first; one[:3] is what search_light takes. FourierScan.periods has those of
        several minima.

    ValueError for frequencies that are not above 0, light curves that are not sound, no more points
    than the series has unknowns.
    """
    first, second = float(_number(f1, "f1")), float(_number(f2, "f2"))
    for name, f in (("f1", first), ("f2", second)):
        if not 0.0 < f < np.inf:
            raise ValueError(f"{name}: got {f!r}; expected a frequency above 0")
    found = _core._likely_periods(curve_parts(curves), first, second, whole(order, "order"))
    return [LikelyPeriods(*one) for one in found]


def _grid(
    given: Any, name: str, otherwise: tuple[float, float, float]
) -> tuple[float, float, float]:
    if given is None:
        return otherwise
    numbers = [float(_number(x, name)) for x in given]
    if len(numbers) not in (2, 3):
        raise ValueError(f"{name}: got {given!r}; expected (least, most) or (least, most, step)")
    least, most, step = [*numbers, otherwise[2]][:3]
    return least, most, step


def period_labels(f1: float, f2: float) -> list[PeriodLabel]:
    """Which periods of precession and rotation a tumbler may have that shows two frequencies: those
    of ellipsoids first, then by how strong such lines are expected to be.

    ValueError for frequencies that are not positive.
    """
    first, second = float(_number(f1, "f1")), float(_number(f2, "f2"))
    return [PeriodLabel(*label) for label in _core._period_labels(first, second)]
