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
from polhode._light_bodies import LightCurve, LightModel, curve_parts, model_fluxes, model_of
from polhode._residual_functions import ResidualFunction
from polhode._spin_fits import FitSolution, common_parts

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._arguments import Loss

    Array = NDArray[np.float64]

# (mode, P_phi, P_psi)
Periods = tuple[str, float, float]
MOMENTS = ("shape", "start", "fit")
_ERRORS = ("roughness_error", "moments_error", "closure_error", "axes_error")
# A standard deviation over the median of sizes: 1 / Phi^-1(3/4).
_OF_NORMAL = 1.482602218505602


@dataclass(frozen=True, eq=False, repr=False)
class LightSolution(FitSolution):
    """A spin state and shape that light curves are of; made by fit_light and search_light.

    Attributes
    ----------
    body : LightModel; of an ellipsoid a = 1.
    factors : of each session, flux over model.
    mode : "SAM", "LAM", or another regime.
    precession_period, rotation_period : of the long axis about the momentum, and about the long
        axis; 0 where the regime has none.
    pole : (3,), direction of the angular momentum, inertial.
    loss : (kind, scale) of that which was minimised; factors are the best ones under it.
    points : of all light curves; residuals begin with theirs.
    """

    body: LightModel
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
        if self.body.kind == "convex":
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
    surfaces, surfaces_converged : fits of the `surface`, and how many converged.
    failure : why there are no solutions; else empty. notes : what to know of it.
    """

    solutions: list[FoundLight]
    periods: list[tuple[str, float, float]]
    chi_square_of_periods: Array
    starts: int
    finalists: int
    converged: int
    notes: tuple[str, ...]
    surfaces: int = 0
    surfaces_converged: int = 0
    failure: str = ""

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


def light_parts(found: Mapping[str, Any]) -> dict[str, Any]:
    mode, precession, rotation = found["periods"]
    return {
        **common_parts(found), "body": LightModel._of(found["body"]),
        "factors": found["factors"], "mode": mode, "precession_period": precession,
        "rotation_period": rotation, "pole": found["pole"], "loss": found["loss"],
        "points": found["points"],
    }  # fmt: skip


def found_light(found: Mapping[str, Any]) -> FoundLight:
    return FoundLight(
        **light_parts(found), starts=found["starts"], beside=found["beside"], of=found["of"],
        relation=found["relation"],
    )  # fmt: skip


def _unknowns(bodies: Sequence[LightModel], shape: Any, moments: Any, multiple: Any) -> Any:
    """For the core; moments that are None are those of the kind of the first body."""
    usual = {"ellipsoid": "shape", "convex": "fit", "mesh": "start"}
    kind = bodies[0].kind if bodies else "ellipsoid"
    return bool(shape), one_of(moments or usual[kind], "moments", MOMENTS), bool(multiple)


def _surface(
    surface: Any, shape: Any, moments: Any, multiple: Any, errors: Sequence[Any], iterations: Any
) -> tuple[Any, ...]:
    """For the core."""
    if isinstance(surface, tuple) and len(surface) == 2:
        parts = tuple(whole(n, f"surface: {name}", 0)
                      for n, name in zip(surface, ("degree", "rows"), strict=True))  # fmt: skip
        unknowns = bool(shape), one_of(moments or "fit", "moments", MOMENTS), bool(multiple)
    else:
        body = model_of(surface, "search_light: surface")
        parts, unknowns = body._parts(), _unknowns([body], False, moments, multiple)
    most = whole(100 if iterations is None else iterations, "most_iterations")
    return parts, unknowns, _regularisation(errors, None), most


def _regularisation(errors: Sequence[Any], about: Any) -> tuple[Any, ...]:
    usual = None if about is None else model_of(about, "about")._parts()
    return (*(float(_number(x, name)) for name, x in zip(_ERRORS, errors)), usual)


def _problem(
    start: Any, curves: Any, shape: Any, moments: Any, multiple: Any, loss: Any, iterations: Any,
    errors: Sequence[Any], about: Any,
) -> Any:  # fmt: skip
    body = model_of(start, "fit_light")
    return _core._light_problem(
        curve_parts(curves), body._parts(), _unknowns([body], shape, moments, multiple),
        loss_of(loss), whole(iterations, "most_iterations"),
        _regularisation(errors, about),
    )  # fmt: skip


def fit_light(
    start: LightModel,
    curves: LightCurve | Iterable[LightCurve],
    *,
    shape: bool = True,
    moments: str | None = None,
    multiple: bool = False,
    about: LightModel | None = None,
    roughness_error: float = 3.0,
    moments_error: float = 0.1,
    closure_error: float = 1e-3,
    axes_error: float = 1e-2,
    loss: Loss = "squared",
    most_iterations: int = 200,
) -> LightSolution:
    """The spin state and shape of a tumbling body from light curves, from one start.

    Parameters
    ----------
    start : LightModel near the answer: phases at the ends of the data within a quarter of a turn.
        Begin a convex body with the best ellipsoid of every pair of periods,
        `solution.body.convex(degree, rows)`: real bodies are not ellipsoids, and an alias can fit
        an ellipsoid better.
        Degree 6 and rows 8 suit about 350 points, 3 and 4 about 80.
    curves : LightCurve, one or several, with vectors.
    shape : whether b/a and c/b, or the coefficients of facets are unknown; a mesh is known.
    moments : "shape", those of an even filling; "start", as they are; "fit", unknowns Ixx/Izz and
        Iyy/Izz, of a convex body about the usual ones, to moments_error. None: "shape" of an
        ellipsoid, "fit" of a convex body, "start" of a mesh. "shape" of a convex body goes from
        round to round, needs rows of about 12, and has not converged where they do not come to
        rest. Axes of a mesh must be principal with "fit"; it has no "shape".
    multiple : whether the weight of Lambert's law is unknown, that of Lommel and Seeliger being 1.
    about : the ellipsoid or convex body whose coefficients and moments are the usual ones of a
        convex body, so that a fit can go on from another one. None: the start.
    roughness_error : of l (l + 1) times what coefficients of degree l are off the usual ones;
        smaller ones give smoother bodies.
    closure_error, axes_error : of the sum of areas times normals, and of the products of their
        tensor, over the whole area.
    loss : as in fit_spin.

    Returns
    -------
    LightSolution
        Of what did not converge too: `.converged` says so. Unknowns: turn_x, turn_y, turn_z, w_x,
        w_y, w_z; b/a and c/b; moments and the weight that are asked for; c_l_m. Converged is nearer
        to the least than a thousandth of a standard error, of a mesh than one, as its facets bend
        the light where they pass a terminator. At the edge of a shadow brightness jumps by a facet:
        fits of coarse meshes may stall there. Errors of convex bodies are under their
        regularisation.

    DomainError (a ValueError) for light curves that are not sound, a start that no body has, errors
    that are not above 0, fewer points than unknowns. Exact derivatives. Releases the GIL; a second
    for a convex body and 350 points.
    """
    errors = roughness_error, moments_error, closure_error, axes_error
    problem = _problem(
        start, curves, shape, moments, multiple, loss, most_iterations, errors, about
    )
    return LightSolution(**light_parts(problem.fit()))


class LightResiduals(ResidualFunction):
    """Residuals of light curves as a function of the unknowns of a tumbling body.

    Parameters as of fit_light: start, curves, shape, moments, multiple, about, the four errors,
    loss. Turns are about the attitude of the start. Factors of sessions are the best ones under the
    loss at every x, and the derivatives know it (variable projection): the likelihood is the
    profile over factors.

    Regularisation of a convex body is among the residuals, after those of data: three of closure,
    three of the products of the area tensor, one of roughness for each c_l_m, and of unknown
    moments two about the usual ones. So `log_likelihood` is only of the light, and `log_posterior`
    has them as priors: roughness_error decides how smooth the drawn bodies are.
    moments="shape": those of an even filling of the body at every x, a tenth of a second each for
    512 facets; residuals are NaN where the areas are those of no body.

    Of a mesh derivatives are exact between the directions at which a facet passes a terminator,
    where they have a step, or the edge of a shadow, where the residuals have one: optimisers come
    to rest next to the minimum, as fit_light does, and samplers reject more steps.
    """

    def __init__(
        self,
        start: LightModel,
        curves: LightCurve | Iterable[LightCurve],
        *,
        shape: bool = True,
        moments: str | None = None,
        multiple: bool = False,
        about: LightModel | None = None,
        roughness_error: float = 3.0,
        moments_error: float = 0.1,
        closure_error: float = 1e-3,
        axes_error: float = 1e-2,
        loss: Loss = "squared",
    ) -> None:
        errors = roughness_error, moments_error, closure_error, axes_error
        problem = _problem(start, curves, shape, moments, multiple, loss, 1, errors, about)
        super().__init__(problem.residuals())

    def state(self, x: ArrayLike) -> LightModel:
        """The body at x."""
        return LightModel._of(self._compiled.state(x))


def search_light(
    curves: LightCurve | Iterable[LightCurve],
    periods: Iterable[Periods],
    *,
    body: LightModel | None = None,
    surface: LightModel | tuple[int, int] | None = None,
    starts: int = 1000,
    within: float = 1.5,
    threads: int = 1,
    seed: int = 0,
    tries: int | None = None,
    short_iterations: int | None = None,
    finalists: int = 4,
    shape: bool = True,
    moments: str | None = None,
    multiple: bool = False,
    lambert: float = 0.0,
    roughness_error: float = 3.0,
    moments_error: float = 0.1,
    closure_error: float = 1e-3,
    axes_error: float = 1e-2,
    loss: Loss = "squared",
    most_iterations: int | None = None,
) -> LightSearchResult:
    """All spin states of a tumbler that light curves allow, from many starts: with the shape of an
    ellipsoid, of a convex body, or of a body that is known.

    Parameters
    ----------
    curves : LightCurve, one or several, with vectors.
    periods : (mode, P_phi, P_psi), mode "SAM" or "LAM": FourierScan.periods lists them. Those that
        a known body cannot have are left out and counted in a note.
    body : LightModel whose shape, law and inertia are known, such as that of a mesh; its attitude,
        rate and t0 are ignored. With its moments a pair of periods leaves a phase of the
        polhode and an attitude to be found, on either side of the axis of circulation. None: an
        ellipsoid.
    surface : fitted after the ellipsoids, and becomes the solutions: (degree, rows) of convex
        bodies, or the LightModel of a mesh, whose shape, law and inertia are known. It is fitted
        from the best ellipsoid of every pair of periods, also beyond the limit, and from images of
        bodies within the limit; a mesh is also searched for as `body` is. None: ellipsoids are
        the solutions.
    starts : in all, taken by the pairs of periods in turn; of ellipsoids, pairs near the lowest get
        more.
    within : chi-square, or the sum under a robust loss, over the lowest, up to which solutions are
        reported.
    threads : the bits of the result do not depend on it.
    seed : of starts.
    tries : attitudes of a start, of which the best is taken; of a known body by about 60 points.
        short_iterations : of each start. None: 30 and 8 of ellipsoids, 60 and 6 of a known body.
    finalists : of each pair of periods that are fitted to the end, with most_iterations (None: 60,
        of the surface 100); ellipsoids near the lowest may go on for four times as many.
    shape, moments, multiple, loss : as in fit_light; of a known body the shape stays, and moments
        are unknown only of finalists. Moments of a convex surface are "fit" by default; its
        ellipsoids use "shape" unless "fit" is given. lambert is the weight of Lambert's law of
        ellipsoids. The four errors are of convex bodies, as in fit_light.

    Returns
    -------
    LightSearchResult
        The lowest chi-square or loss is no proof: images, aliases and the other mode are listed
        beside it. Seen and lit from fixed directions, a mesh has the same light after a half turn
        about the bisector of Sun and observer: two poles, where an ellipsoid has four.

    DomainError (a ValueError) as fit_light, and without periods. Some milliseconds a start. Ctrl-C
    ends it between two attitudes. Releases the GIL.
    """
    wanted = [
        (one_of(mode, "periods", ("SAM", "LAM")), float(_number(phi, "periods")),
         float(_number(psi, "periods")))
        for mode, phi, psi in periods
    ]  # fmt: skip
    known = [] if body is None else [model_of(body, "search_light")]
    usual_tries, usual_iterations = (60, 6) if known else (30, 8)
    errors = roughness_error, moments_error, closure_error, axes_error
    unknowns, follows = _unknowns(known, shape, moments, multiple), None
    if surface is not None:
        follows = _surface(surface, shape, moments, multiple, errors, most_iterations)
        unknowns = (True, "fit" if moments == "fit" else "shape", bool(multiple))
    found = _core._search_light(
        curve_parts(curves), wanted, known[0]._parts() if known else None, follows,
        whole(starts, "starts"),
        whole(usual_tries if tries is None else tries, "tries"),
        whole(usual_iterations if short_iterations is None else short_iterations,
              "short_iterations"),
        whole(finalists, "finalists"), float(_number(within, "within")),
        unknowns, float(_number(lambert, "lambert")), loss_of(loss),
        whole(60 if most_iterations is None else most_iterations, "most_iterations"),
        whole(seed, "seed", 0), whole(threads, "threads"),
    )  # fmt: skip
    return LightSearchResult(
        [found_light(one) for one in found["solutions"]], wanted, found["chi_square_of_periods"],
        found["starts"], found["finalists"], found["converged"], found["notes"],
        found["surfaces"], found["surfaces_converged"], found["failure"],
    )  # fmt: skip


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
    starts: LightModel | Iterable[LightModel],
    *,
    first: int = 0,
    within: float = 1.5,
    threads: int = 1,
    shape: bool = True,
    moments: str | None = None,
    multiple: bool = False,
    about: LightModel | None = None,
    roughness_error: float = 3.0,
    moments_error: float = 0.1,
    closure_error: float = 1e-3,
    axes_error: float = 1e-2,
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
    starts : LightModel, one or several of one kind, near what the session `first` has: bodies of
        the solutions of search_light. A convex body is regularised about its start, if not `about`
        another body.
    first : the place of that session.
    within : chi-square, or the sum under a robust loss, over the lowest, up to which solutions go
        on and are reported.
    threads : the bits of the result do not depend on it.
    shape, moments, multiple, about, roughness_error, moments_error, closure_error, axes_error, loss
        : as in fit_light.
    most_counts : of turns, for one solution and session; where there are more, `failure` says so.
    most_iterations : of each fit; near the limit it may go on for five times as many.

    Returns
    -------
    LightExtensionResult

    DomainError (a ValueError) as fit_light, and without starts. A fit for each count of turns and
    solution, some milliseconds for each 100 points. Ctrl-C ends it between two fits. Releases the
    GIL.
    """
    bodies = [starts] if isinstance(starts, LightModel) else list(starts)
    given = [model_of(body, "extend_light: starts")._parts() for body in bodies]
    errors = roughness_error, moments_error, closure_error, axes_error
    found = _core._extend_light(
        curve_parts(curves), given, whole(first, "first", 0), float(_number(within, "within")),
        _unknowns(bodies, shape, moments, multiple), loss_of(loss),
        whole(most_counts, "most_counts"), whole(most_iterations, "most_iterations"),
        whole(threads, "threads"), _regularisation(errors, about),
    )  # fmt: skip
    return LightExtensionResult(
        [found_light(one) for one in found["solutions"]],
        [JoinedSession(*one) for one in found["joined"]], found["failure"], found["notes"],
    )  # fmt: skip
