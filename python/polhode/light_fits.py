# SPDX-License-Identifier: MIT
"""Fits of light curves of tumbling ellipsoids: from one start, from many, session by session."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _core
from polhode._arguments import loss_of, one_of, whole
from polhode._core import _number
from polhode.light_bodies import (
    ConvexModel,
    EllipsoidModel,
    LightCurve,
    MeshModel,
    curve_parts,
    model_fluxes,
)
from polhode.residual_functions import ResidualFunction
from polhode.spin_fits import FitSolution, common_parts

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._arguments import Loss

    Array = NDArray[np.float64]

# (mode, P_phi, P_psi)
Periods = tuple[str, float, float]
MOMENTS = ("shape", "start", "fit")
# A standard deviation over the median of sizes: 1 / Phi^-1(3/4).
_OF_NORMAL = 1.482602218505602


@dataclass(frozen=True, eq=False, repr=False)
class LightSolution(FitSolution):
    """A spin state and shape that light curves are of; made by fit_light, fit_convex, fit_mesh,
    search_light and search_mesh.

    Attributes
    ----------
    body : EllipsoidModel, a = 1; a ConvexModel or MeshModel of fits of these.
    factors : of each session, flux over model.
    mode : "SAM", "LAM", or another regime.
    precession_period, rotation_period : of the long axis about the momentum, and about the long
        axis; 0 where the regime has none.
    pole : (3,), direction of the angular momentum, inertial.
    loss : (kind, scale) of that which was minimised; factors are the best ones under it.
    points : of all light curves; residuals begin with theirs.
    """

    body: EllipsoidModel | ConvexModel | MeshModel
    factors: Array
    mode: str
    precession_period: float
    rotation_period: float
    pole: Array
    loss: tuple[str, float]
    points: int

    @property
    def error_scale(self) -> float:
        """By which errors would be as large as residuals: as that of every fit, and under a robust
        loss by the median of their sizes; NaN where the data leave no degrees of freedom."""
        by_squares = super().error_scale
        if self.loss[0] == "squared" or not np.isfinite(by_squares):
            return by_squares
        sizes = np.sort(np.abs(self.residuals[: self.points]))
        spread = _OF_NORMAL * sizes[self.points // 2]
        return float(spread * np.sqrt(self.points / self.degrees_of_freedom))

    def model(self, curves: LightCurve | Iterable[LightCurve]) -> list[Array]:
        """Fluxes of the model at the points of each session, under the loss of the fit; see
        model_fluxes."""
        return model_fluxes(self.body, curves, self.loss)

    def _rank(self) -> str:
        """What solutions are ranked by."""
        if hasattr(self.body, "coefficients"):
            return f"cost {self.cost:.5g} with chi-square {self.chi_square:.5g}"
        if self.loss[0] == "squared":
            return f"chi-square {self.chi_square:.5g}"
        return f"loss {self.cost:.5g}"

    def _head(self) -> str:
        periods = f"{self.mode}, P_phi {self.precession_period:.6g}, "
        return f"{super()._head()}; {periods}P_psi {self.rotation_period:.6g}"


@dataclass(frozen=True, eq=False, repr=False)
class FoundLight(LightSolution):
    """One of the solutions of search_light.

    Attributes
    ----------
    starts : how many of those that were fitted to the end, with all unknowns, came to it.
    beside : what it is beside an earlier solution that it resembles: "first" (of its kind),
        "image" (the same light by symmetry), "alias", "other-mode" or "other-pole".
    of : the place of that solution. relation : the same in words.
    """

    starts: int
    beside: str
    of: int
    relation: str


@dataclass(frozen=True, eq=False)
class LightSearchResult:
    """What search_light found.

    Attributes
    ----------
    solutions : FoundLight by what was minimised: chi-square, or the sum under a robust loss; all
        converged.
    periods : what was looked for. chi_square_of_periods : the lowest of it that each pair came to.
    starts, finalists, converged : how many had a body, were fitted to the end, and converged.
    notes : what to know of it.
    """

    solutions: list[FoundLight]
    periods: list[tuple[str, float, float]]
    chi_square_of_periods: Array
    starts: int
    finalists: int
    converged: int
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        head = f"<LightSearchResult: {len(self.solutions)} solutions of {self.starts} starts"
        return listed(head, self.solutions)


def listed(head: str, solutions: Sequence[FoundLight]) -> str:
    """A line for each, below a head."""
    lines = [
        f"  {k}: {s._rank()}, {s.mode}, P_phi {s.precession_period:.6g}, "
        f"P_psi {s.rotation_period:.6g}" + (f"; {s.relation}" if s.relation else "")
        for k, s in enumerate(solutions)
    ]
    return "\n".join([head, *lines]) + ">"


def light_parts(found: Mapping[str, Any], body: Any = None) -> dict[str, Any]:
    mode, precession, rotation = found["periods"]
    return {
        **common_parts(found), "body": body or EllipsoidModel._of(found["body"]),
        "factors": found["factors"], "mode": mode, "precession_period": precession,
        "rotation_period": rotation, "pole": found["pole"], "loss": found["loss"],
        "points": found["points"],
    }  # fmt: skip


def found_light(found: Mapping[str, Any], body: Any = None) -> FoundLight:
    return FoundLight(
        **light_parts(found, body), starts=found["starts"], beside=found["beside"], of=found["of"],
        relation=found["relation"],
    )  # fmt: skip


def wanted_periods(periods: Iterable[Periods]) -> list[Periods]:
    return [
        (one_of(mode, "periods", ("SAM", "LAM")), float(_number(phi, "periods")),
         float(_number(psi, "periods")))
        for mode, phi, psi in periods
    ]  # fmt: skip


def search_result(
    found: Mapping[str, Any], wanted: list[Periods], bodies: Sequence[Any] | None = None
) -> LightSearchResult:
    solutions = found["solutions"]
    all_bodies = bodies or [None] * len(solutions)
    return LightSearchResult(
        [found_light(one, body) for one, body in zip(solutions, all_bodies)], wanted,
        found["chi_square_of_periods"], found["starts"], found["finalists"], found["converged"],
        found["notes"],
    )  # fmt: skip


def _light_problem(
    start: Any, curves: Any, shape: Any, moments: Any, multiple: Any, loss: Any, iterations: Any
) -> Any:
    if not isinstance(start, EllipsoidModel):
        raise TypeError(f"fit_light: got {start!r}; expected EllipsoidModel")
    kind, scale = loss_of(loss)
    return _core._light_problem(
        curve_parts(curves), start._parts(), bool(shape), one_of(moments, "moments", MOMENTS),
        bool(multiple), kind, scale, whole(iterations, "most_iterations"),
    )  # fmt: skip


def fit_light(
    start: EllipsoidModel,
    curves: LightCurve | Iterable[LightCurve],
    *,
    shape: bool = True,
    moments: str = "shape",
    multiple: bool = False,
    loss: Loss = "squared",
    most_iterations: int = 200,
) -> LightSolution:
    """The spin state and shape of a tumbling ellipsoid from light curves, from one start.

    Parameters
    ----------
    start : near the answer: phases at the ends of the data within a quarter of a turn.
    curves : LightCurve, one or several, with vectors.
    shape : whether b/a and c/b are unknown.
    moments : "shape", those of an even filling; "start", as they are; "fit", unknowns Ixx/Izz and
        Iyy/Izz.
    multiple : whether the weight of Lambert's law is unknown, that of Lommel and Seeliger being 1.
    loss : as in fit_spin.

    Returns
    -------
    LightSolution
        Of what did not converge too: `.converged` says so. Unknowns: turn_x, turn_y, turn_z, w_x,
        w_y, w_z, b/a, c/b, then those asked for.

    DomainError (a ValueError) for light curves that are not sound, a start that no body has, fewer
    points than unknowns. Exact derivatives. Releases the GIL.
    """
    problem = _light_problem(start, curves, shape, moments, multiple, loss, most_iterations)
    return LightSolution(**light_parts(problem.fit()))


class LightResiduals(ResidualFunction):
    """Residuals of light curves as a function of the unknowns of a tumbling ellipsoid.

    Parameters as of fit_light: start, curves, shape, moments, multiple, loss. Factors of sessions
    are the best ones under the loss at every x, and the derivatives know it (variable projection):
    the likelihood is the profile over factors.
    """

    def __init__(
        self,
        start: EllipsoidModel,
        curves: LightCurve | Iterable[LightCurve],
        *,
        shape: bool = True,
        moments: str = "shape",
        multiple: bool = False,
        loss: Loss = "squared",
    ) -> None:
        problem = _light_problem(start, curves, shape, moments, multiple, loss, 1)
        super().__init__(problem.residuals())

    def state(self, x: ArrayLike) -> EllipsoidModel:
        """The body at x."""
        return EllipsoidModel._of(self._compiled.state(x))


def search_light(
    curves: LightCurve | Iterable[LightCurve],
    periods: Iterable[Periods],
    *,
    starts: int = 1000,
    within: float = 1.5,
    threads: int = 1,
    seed: int = 0,
    tries: int = 30,
    short_iterations: int = 8,
    finalists: int = 4,
    shape: bool = True,
    moments: str = "shape",
    multiple: bool = False,
    lambert: float = 0.0,
    loss: Loss = "squared",
    most_iterations: int = 60,
) -> LightSearchResult:
    """All spin states and shapes of a tumbling ellipsoid that light curves allow, from many starts.

    Parameters
    ----------
    curves : LightCurve, one or several, with vectors.
    periods : (mode, P_phi, P_psi), mode "SAM" or "LAM": FourierScan.periods lists them.
    starts : at first, in all, taken by the pairs of periods in turn; pairs near the lowest get
        more.
    within : chi-square, or the sum under a robust loss, over the lowest, up to which solutions are
        reported.
    threads : the bits of the result do not depend on it.
    seed : of starts.
    tries : attitudes of a start, of which the best is taken. short_iterations : of each start.
    finalists : of each pair of periods that are fitted to the end, with most_iterations; near the
        lowest they may go on for four times as many.
    shape, moments, multiple, loss : as in fit_light; lambert is the weight of Lambert's law.

    Returns
    -------
    LightSearchResult
        The lowest chi-square or loss is no proof: images, aliases and the other mode are listed
        beside it.

    DomainError (a ValueError) as fit_light, and without periods. Some milliseconds a start. Ctrl-C
    ends it between two starts. Releases the GIL.
    """
    wanted = wanted_periods(periods)
    kind, scale = loss_of(loss)
    found = _core._search_light(
        curve_parts(curves), wanted, whole(starts, "starts"), whole(tries, "tries"),
        whole(short_iterations, "short_iterations"), whole(finalists, "finalists"),
        float(_number(within, "within")), bool(shape), one_of(moments, "moments", MOMENTS),
        bool(multiple), float(_number(lambert, "lambert")), kind, scale,
        whole(most_iterations, "most_iterations"), whole(seed, "seed", 0),
        whole(threads, "threads"),
    )  # fmt: skip
    return search_result(found, wanted)


@dataclass(frozen=True)
class JoinedSession:
    """What a session came to when it joined those before it.

    Attributes
    ----------
    session : its place among the curves.
    distance : of its middle from that of those before it; 0 of the first.
    counts : fits that were begun, one for each count of turns and solution; for the first session,
        one for each start.
    converged : of them. solutions : within the limit, of all sessions so far. cost : of the lowest.
    """

    session: int
    distance: float
    counts: int
    converged: int
    solutions: int
    cost: float


@dataclass(frozen=True, eq=False)
class LightExtensionResult:
    """What extend_light found.

    Attributes
    ----------
    solutions : FoundLight of all sessions, by what was minimised; all converged.
    joined : JoinedSession in the order in which they joined.
    failure : why there are no solutions; else empty. notes : what to know of it.
    """

    solutions: list[FoundLight]
    joined: list[JoinedSession]
    failure: str
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        counted = f"{len(self.solutions)} solutions of {len(self.joined)} sessions"
        said = f": {self.failure}" if self.failure else ""
        return listed(f"<LightExtensionResult: {counted}{said}", self.solutions)


def extend_light(
    curves: Iterable[LightCurve],
    starts: EllipsoidModel | Iterable[EllipsoidModel],
    *,
    first: int = 0,
    within: float = 1.5,
    threads: int = 1,
    shape: bool = True,
    moments: str = "shape",
    multiple: bool = False,
    loss: Loss = "squared",
    most_counts: int = 5000,
    most_iterations: int = 200,
) -> LightExtensionResult:
    """Solutions of one session of light curves, to all sessions, which join one by one.

    Each solution is fitted with every count of turns until the next session that three of its
    errors leave; what is within the limit goes on to the session after it.

    Parameters
    ----------
    curves : LightCurve, the sessions, with vectors.
    starts : EllipsoidModel, one or several, near what the session `first` has: bodies of the
        solutions of search_light.
    first : the place of that session.
    within : chi-square, or the sum under a robust loss, over the lowest, up to which solutions go
        on and are reported.
    threads : the bits of the result do not depend on it.
    shape, moments, multiple, loss : as in fit_light.
    most_counts : of turns, for one solution and session; where there are more, `failure` says so.
    most_iterations : of each fit; near the limit it may go on for five times as many.

    Returns
    -------
    LightExtensionResult

    DomainError (a ValueError) as fit_light, and without starts. A fit for each count of turns and
    solution, some milliseconds for each 100 points. Ctrl-C ends it between two fits. Releases the
    GIL.
    """
    bodies = [starts] if isinstance(starts, EllipsoidModel) else list(starts)
    for body in bodies:
        if not isinstance(body, EllipsoidModel):
            raise TypeError(f"extend_light: starts: got {body!r}; expected EllipsoidModel")
    found = _core._extend_light(
        curve_parts(curves), [body._parts() for body in bodies], whole(first, "first", 0),
        float(_number(within, "within")), bool(shape), one_of(moments, "moments", MOMENTS),
        bool(multiple), *loss_of(loss), whole(most_counts, "most_counts"),
        whole(most_iterations, "most_iterations"), whole(threads, "threads"),
    )  # fmt: skip
    return LightExtensionResult(
        [found_light(one) for one in found["solutions"]],
        [JoinedSession(*one) for one in found["joined"]], found["failure"], found["notes"],
    )  # fmt: skip
