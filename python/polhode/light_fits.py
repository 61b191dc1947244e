# SPDX-License-Identifier: MIT
"""Light curves of tumbling ellipsoids: fits from one start and from many."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _core
from polhode._core import _number
from polhode._observed import column, loss_of, of_shape, one_of, rows, whole
from polhode.residual_functions import ResidualFunction
from polhode.spin_fits import FitSolution, SpinState, common_parts

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._observed import Loss
    from polhode.surface_fits import BrightConvex, BrightMesh

    Array = NDArray[np.float64]

# (mode, P_phi, P_psi)
Periods = tuple[str, float, float]
MOMENTS = ("shape", "start", "fit")
# A standard deviation over the median of sizes: 1 / Phi^-1(3/4).
_OF_NORMAL = 1.482602218505602


class LightCurve:
    """How bright a body was during one session of observation. Immutable.

    Parameters
    ----------
    t : (N,), times at the body, free of light time, any unit.
    flux : (N,), at unit distances, any unit: the same in all sessions that are calibrated.
    sigma : standard errors of the fluxes: a number or (N,).
    to_sun, to_observer : (3,) or (N, 3), from the body, along inertial axes; any length.
    name : of the session.
    calibrated : whether fluxes can be compared with those of other calibrated sessions; else the
        session has a factor of its own.

    ValueError for shapes that do not fit; a fit says which point is wrong.
    """

    def __init__(
        self,
        t: ArrayLike,
        flux: ArrayLike,
        sigma: ArrayLike,
        to_sun: ArrayLike = (0.0, 0.0, 0.0),
        to_observer: ArrayLike = (0.0, 0.0, 0.0),
        *,
        name: str = "",
        calibrated: bool = False,
    ) -> None:
        times = column(t, "t")
        n = len(times)
        values = column(flux, "flux")
        if len(values) != n:
            raise ValueError(f"flux: got shape {values.shape}; expected ({n},), as t has")
        errors = np.array(_core._numbers(sigma, "sigma"), dtype=float)
        if errors.shape not in ((), (n,)):
            raise ValueError(f"sigma: got shape {errors.shape}; expected () or ({n},)")
        self._name, self._calibrated = str(name), bool(calibrated)
        self._table = np.column_stack([
            times, values, np.broadcast_to(errors, (n,)), rows(to_sun, "to_sun", n, 3),
            rows(to_observer, "to_observer", n, 3),
        ])  # fmt: skip
        self._table.flags.writeable = False

    name = property(lambda self: self._name, doc="Of the session.")
    calibrated = property(lambda self: self._calibrated, doc="Whether fluxes can be compared.")
    t = property(lambda self: self._table[:, 0], doc="(N,)")
    flux = property(lambda self: self._table[:, 1], doc="(N,)")
    sigma = property(lambda self: self._table[:, 2], doc="(N,)")
    to_sun = property(lambda self: self._table[:, 3:6], doc="(N, 3)")
    to_observer = property(lambda self: self._table[:, 6:9], doc="(N, 3)")

    def __len__(self) -> int:
        return len(self._table)

    def __repr__(self) -> str:
        kind = "calibrated" if self.calibrated else "relative"
        name = f" {self.name}:" if self.name else ""
        return f"<LightCurve:{name} {len(self)} points, {kind}>"

    def _parts(self) -> tuple[str, bool, Array]:
        return self._name, self._calibrated, self._table

    @classmethod
    def _of(cls, parts: Any) -> LightCurve:
        name, calibrated, table = parts
        return cls(*table.T[:3], table[:, 3:6], table[:, 6:9], name=name, calibrated=calibrated)


def curve_parts(curves: Any) -> list[tuple[str, bool, Array]]:
    given = [curves] if isinstance(curves, LightCurve) else list(curves)
    for curve in given:
        if not isinstance(curve, LightCurve):
            raise TypeError(f"curves: got {curve!r}; expected LightCurve, one or several")
    return [curve._parts() for curve in given]


@dataclass(frozen=True, eq=False)
class BrightEllipsoid:
    """A tumbling ellipsoid that scatters light.

    Attributes
    ----------
    spin : SpinState; body axes are those of the ellipsoid. Its inertia is what a fit with
        moments="start" or "fit" reads; with moments="shape" it is that of an even filling.
    axes : (3,), semi-axes a, b, c; only ratios act.
    law : weights of the laws of Lommel and Seeliger, and of Lambert.
    """

    spin: SpinState
    axes: Any
    law: tuple[float, float] = (1.0, 0.0)

    def __post_init__(self) -> None:
        if not isinstance(self.spin, SpinState):
            raise TypeError(f"spin: got {self.spin!r}; expected SpinState")
        object.__setattr__(self, "axes", of_shape(self.axes, "axes", (3,)))
        single, multiple = (float(_number(weight, "law")) for weight in self.law)
        object.__setattr__(self, "law", (single, multiple))

    @classmethod
    def homogeneous(
        cls,
        q: ArrayLike,
        w: ArrayLike,
        axes: ArrayLike,
        t0: float = 0.0,
        law: tuple[float, float] = (1.0, 0.0),
    ) -> BrightEllipsoid:
        """With the moments of an even filling."""
        a, b, c = (x * x for x in of_shape(axes, "axes", (3,)))
        return cls(SpinState(q, w, [b + c, c + a, a + b], t0), axes, law)

    def _parts(self) -> tuple[Any, ...]:
        return self.spin._parts(), self.axes, self.law

    @classmethod
    def _of(cls, parts: Sequence[Any]) -> BrightEllipsoid:
        spin, axes, law = parts
        return cls(SpinState._of(spin), axes, law)


@dataclass(frozen=True, eq=False, repr=False)
class LightSolution(FitSolution):
    """A spin state and shape that light curves are of; made by fit_light, fit_convex, fit_mesh,
    search_light and search_mesh.

    Attributes
    ----------
    body : BrightEllipsoid, a = 1; a BrightConvex or BrightMesh of fits of these.
    factors : of each session, flux over model.
    mode : "SAM", "LAM", or another regime.
    precession_period, rotation_period : of the long axis about the momentum, and about the long
        axis; 0 where the regime has none.
    pole : (3,), direction of the angular momentum, inertial.
    loss : (kind, scale) of that which was minimised; factors are the best ones under it.
    points : of all light curves; residuals begin with theirs.
    """

    body: BrightEllipsoid | BrightConvex | BrightMesh
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
        **common_parts(found), "body": body or BrightEllipsoid._of(found["body"]),
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
    if not isinstance(start, BrightEllipsoid):
        raise TypeError(f"fit_light: got {start!r}; expected BrightEllipsoid")
    kind, scale = loss_of(loss)
    return _core._light_problem(
        curve_parts(curves), start._parts(), bool(shape), one_of(moments, "moments", MOMENTS),
        bool(multiple), kind, scale, whole(iterations, "most_iterations"),
    )  # fmt: skip


def fit_light(
    start: BrightEllipsoid,
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
        start: BrightEllipsoid,
        curves: LightCurve | Iterable[LightCurve],
        *,
        shape: bool = True,
        moments: str = "shape",
        multiple: bool = False,
        loss: Loss = "squared",
    ) -> None:
        problem = _light_problem(start, curves, shape, moments, multiple, loss, 1)
        super().__init__(problem.residuals())

    def state(self, x: ArrayLike) -> BrightEllipsoid:
        """The body at x."""
        return BrightEllipsoid._of(self._compiled.state(x))


def model_fluxes(
    body: BrightEllipsoid | BrightConvex | BrightMesh,
    curves: LightCurve | Iterable[LightCurve],
    loss: Loss = "squared",
) -> list[Array]:
    """Fluxes of a body at the points of each light curve, with the best factor of each session
    under a loss, as in fit_spin."""
    from polhode.surface_fits import BrightConvex, BrightMesh

    models: dict[type, Any] = {
        BrightEllipsoid: _core._model_fluxes, BrightConvex: _core._convex_fluxes,
        BrightMesh: _core._mesh_fluxes,
    }  # fmt: skip
    for kind, fluxes in models.items():
        if isinstance(body, kind):
            return fluxes(body._parts(), curve_parts(curves), *loss_of(loss))
    raise TypeError(
        f"model_fluxes: got {body!r}; expected BrightEllipsoid, BrightConvex or BrightMesh"
    )


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
