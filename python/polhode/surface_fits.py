# SPDX-License-Identifier: MIT
"""Light curves of tumbling bodies that are no ellipsoids: convex bodies of facets, given meshes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _core
from polhode._core import FacetShape, _number
from polhode._observed import column, loss_of, one_of, whole
from polhode.light_fits import (
    MOMENTS,
    BrightEllipsoid,
    LightCurve,
    LightSearchResult,
    LightSolution,
    curve_parts,
    light_parts,
    search_result,
    wanted_periods,
)
from polhode.residual_functions import ResidualFunction
from polhode.spin_fits import SpinState

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._observed import Loss
    from polhode.light_fits import Periods

    Array = NDArray[np.float64]


def _checked(body: Any) -> None:
    if not isinstance(body.spin, SpinState):
        raise TypeError(f"spin: got {body.spin!r}; expected SpinState")
    single, multiple = (float(_number(weight, "law")) for weight in body.law)
    object.__setattr__(body, "law", (single, multiple))


@dataclass(frozen=True, eq=False)
class BrightConvex:
    """A tumbling convex body that scatters light, by the areas of facets on fixed normals.

    Attributes
    ----------
    spin : SpinState; body axes are those of the facets, and principal.
    degree, rows : of the series of areas, 1 to 40, and of the 8 rows^2 normals.
    coefficients : ((degree + 1)^2,), c_lm at l^2 + l + m: an area is w exp(sum of c_lm Y_lm(n)),
        w the solid angle of its normal n. Y_lm is sqrt(4 pi) times the real orthonormal harmonic,
        so that Y_00 is 1.
    law : weights of the laws of Lommel and Seeliger, and of Lambert.

    Fluxes (`model_fluxes`, fits) are those of patches: each facet stands for a small range of
    normals, so that its light fades smoothly at the terminator. The plain sum over `normals` and
    `areas` differs by 0.1 to 2.5 %.
    """

    spin: SpinState
    degree: int
    rows: int
    coefficients: Any
    law: tuple[float, float] = (1.0, 0.0)

    def __post_init__(self) -> None:
        _checked(self)
        object.__setattr__(self, "degree", whole(self.degree, "degree"))
        object.__setattr__(self, "rows", whole(self.rows, "rows"))
        object.__setattr__(self, "coefficients", column(self.coefficients, "coefficients"))

    @property
    def normals(self) -> Array:
        """(M, 3), outward, along the body axes; M = 8 rows^2."""
        return _core._convex_facets(self._parts())[0]

    @property
    def areas(self) -> Array:
        """(M,), in the unit in which the ellipsoid of the start has b = 1."""
        return _core._convex_facets(self._parts())[1]

    @property
    def mesh(self) -> FacetShape:
        """The body itself (Minkowski's problem), its centre of mass in the origin. DomainError (a
        ValueError) where the areas are far from those of a closed body. Half a second for 512
        facets."""
        return _core._convex_mesh(self._parts())

    def _parts(self) -> tuple[Any, ...]:
        return self.spin._parts(), self.degree, self.rows, self.coefficients, self.law

    @classmethod
    def _of(cls, parts: Sequence[Any]) -> BrightConvex:
        spin, degree, rows, coefficients, law = parts
        return cls(SpinState._of(spin), degree, rows, coefficients, law)


@dataclass(frozen=True, eq=False)
class BrightMesh:
    """A tumbling body of known shape that scatters light; facets shade each other.

    Attributes
    ----------
    spin : SpinState; body axes are those of the mesh.
    shape : FacetShape, in any unit.
    law : weights of the laws of Lommel and Seeliger, and of Lambert.
    """

    spin: SpinState
    shape: FacetShape
    law: tuple[float, float] = (1.0, 0.0)

    def __post_init__(self) -> None:
        _checked(self)
        if not isinstance(self.shape, FacetShape):
            raise TypeError(f"shape: got {self.shape!r}; expected FacetShape")

    @classmethod
    def homogeneous(
        cls, q: Any, w: Any, shape: FacetShape, t0: float = 0.0,
        law: tuple[float, float] = (1.0, 0.0),
    ) -> BrightMesh:  # fmt: skip
        """With the inertia of an even filling about the centre of mass; the mesh must be closed."""
        return cls(SpinState(q, w, _core._homogeneous_inertia(shape), t0), shape, law)

    @property
    def mesh(self) -> FacetShape:
        """The shape."""
        return self.shape

    def _parts(self) -> tuple[Any, ...]:
        return self.spin._parts(), self.shape, self.law

    @classmethod
    def _of(cls, parts: Sequence[Any]) -> BrightMesh:
        spin, shape, law = parts
        return cls(SpinState._of(spin), shape, law)


def surface_of(parts: Sequence[Any]) -> BrightConvex | BrightMesh:
    return BrightConvex._of(parts) if len(parts) == 5 else BrightMesh._of(parts)


def _convex_problem(
    start: Any, curves: Any, body: Any, degree: Any, rows: Any, moments: Any, multiple: Any,
    errors: dict[str, Any], loss: Any, iterations: Any,
) -> Any:  # fmt: skip
    if not isinstance(start, BrightEllipsoid):
        raise TypeError(f"fit_convex: got {start!r}; expected BrightEllipsoid")
    if body is not None and not isinstance(body, BrightConvex):
        raise TypeError(f"body: got {body!r}; expected BrightConvex or None")
    kind, scale = loss_of(loss)
    return _core._convex_problem(
        curve_parts(curves), start._parts(), () if body is None else body._parts(),
        whole(degree, "degree", 0), whole(rows, "rows"), one_of(moments, "moments", MOMENTS),
        bool(multiple), [float(_number(x, name)) for name, x in errors.items()], kind, scale,
        whole(iterations, "most_iterations"),
    )  # fmt: skip


def fit_convex(
    start: BrightEllipsoid,
    curves: LightCurve | Iterable[LightCurve],
    *,
    body: BrightConvex | None = None,
    degree: int = 6,
    rows: int = 8,
    moments: str = "fit",
    multiple: bool = False,
    roughness_error: float = 3.0,
    moments_error: float = 0.1,
    closure_error: float = 1e-3,
    axes_error: float = 1e-2,
    loss: Loss = "squared",
    most_iterations: int = 100,
) -> LightSolution:
    """A convex body and its spin state from light curves, from an ellipsoid that fits them.

    Parameters
    ----------
    start : what fit_light or search_light came to, of every pair of periods its best: the ellipsoid
        is wrong about real bodies, and an alias can suit it better.
    curves : LightCurve, one or several, with vectors.
    body : where the unknowns begin, such as what an earlier fit came to; its degree and rows are
        taken. None: the ellipsoid of the start. Regularisation is about the start either way.
    degree, rows : of the areas of facets, see BrightConvex; 6 and 8 suit some 350 points, 3 and 4
        some 80.
    moments : "fit", unknowns Ixx/Izz and Iyy/Izz about those of the start, to moments_error;
        "start", as they are; "shape", those of an even filling of the body, from round to round:
        these need rows of about 12, and where they do not come to rest the fit has not converged.
    multiple : whether the weight of Lambert's law is unknown, that of Lommel and Seeliger being 1.
    roughness_error : of l (l + 1) times the coefficients of degree l, about those of the start;
        smaller ones give smoother bodies.
    closure_error, axes_error : of the sum of areas times normals, and of the products of their
        tensor, over the whole area.
    loss : as in fit_spin.

    Returns
    -------
    LightSolution
        `body` is a BrightConvex. Unknowns: turn_x, turn_y, turn_z, w_x, w_y, w_z, then those asked
        for, then c_l_m. Of what did not converge too: `.converged` says so. Converged is nearer to
        the least than a thousandth of a standard error. Errors are under this regularisation.

    DomainError (a ValueError) for light curves that are not sound, errors that are not above 0,
    more coefficients than facets, fewer points than unknowns. Releases the GIL; a second for 350
    points.
    """
    errors = {
        "roughness_error": roughness_error, "moments_error": moments_error,
        "closure_error": closure_error, "axes_error": axes_error,
    }  # fmt: skip
    found = _convex_problem(
        start, curves, body, degree, rows, moments, multiple, errors, loss, most_iterations
    ).fit()
    return LightSolution(**light_parts(found, BrightConvex._of(found["body"])))


class ConvexResiduals(ResidualFunction):
    """Residuals of light curves as a function of the unknowns of a tumbling convex body.

    Parameters as of fit_convex: start, curves, body, degree, rows, moments, multiple, the four
    errors, loss. Turns are about the attitude of `body`, a solution of fit_convex, say, or of the
    start; with body=found.body the function begins at what was found.

    Regularisation is among the residuals, after those of data: three of closure, three of the
    products of the area tensor, one of roughness for each c_l_m, and of unknown moments two about
    those of the start. So `log_likelihood` is of the light alone, and `log_posterior` has them as
    priors: draws are bodies as smooth as roughness_error says, no others. moments="shape": those of
    an even filling of the body at every x, a tenth of a second each for 512 facets; residuals are
    NaN where the areas are those of no body.

    Factors of sessions are the best ones at every x, and the derivatives know it.
    """

    def __init__(
        self,
        start: BrightEllipsoid,
        curves: LightCurve | Iterable[LightCurve],
        *,
        body: BrightConvex | None = None,
        degree: int = 6,
        rows: int = 8,
        moments: str = "fit",
        multiple: bool = False,
        roughness_error: float = 3.0,
        moments_error: float = 0.1,
        closure_error: float = 1e-3,
        axes_error: float = 1e-2,
        loss: Loss = "squared",
    ) -> None:
        errors = {
            "roughness_error": roughness_error, "moments_error": moments_error,
            "closure_error": closure_error, "axes_error": axes_error,
        }  # fmt: skip
        problem = _convex_problem(
            start, curves, body, degree, rows, moments, multiple, errors, loss, 1
        )
        super().__init__(problem.residuals())

    def state(self, x: ArrayLike) -> BrightConvex:
        """The body at x."""
        return BrightConvex._of(self._compiled.state(x))


def _mesh_problem(
    start: Any, curves: Any, moments: Any, multiple: Any, loss: Any, iterations: Any
) -> Any:
    if not isinstance(start, BrightMesh):
        raise TypeError(f"fit_mesh: got {start!r}; expected BrightMesh")
    kind, scale = loss_of(loss)
    return _core._mesh_problem(
        curve_parts(curves), start._parts(), one_of(moments, "moments", ("start", "fit")),
        bool(multiple), kind, scale, whole(iterations, "most_iterations"),
    )  # fmt: skip


def fit_mesh(
    start: BrightMesh,
    curves: LightCurve | Iterable[LightCurve],
    *,
    moments: str = "start",
    multiple: bool = False,
    loss: Loss = "squared",
    most_iterations: int = 100,
) -> LightSolution:
    """The spin state of a tumbling body of known shape from light curves, from one start.

    Parameters
    ----------
    start : BrightMesh near the answer: phases at the ends of the data within a quarter of a turn.
    curves : LightCurve, one or several, with vectors.
    moments : "start", as they are, or "fit", unknowns Ixx/Izz and Iyy/Izz: the axes of the mesh
        must be principal then.
    multiple, loss : as in fit_convex.

    Returns
    -------
    LightSolution
        `body` is a BrightMesh. Unknowns: turn_x, turn_y, turn_z, w_x, w_y, w_z, then those asked
        for. `.converged` says whether it is a solution: nearer to the least than one standard
        error, as facets bend the light where they pass a terminator. At the edge of a shadow
        brightness jumps by a facet: fits of coarse meshes may stall there.

    DomainError (a ValueError) for light curves that are not sound, a start that no body has, fewer
    points than unknowns. Releases the GIL.
    """
    found = _mesh_problem(start, curves, moments, multiple, loss, most_iterations).fit()
    return LightSolution(**light_parts(found, BrightMesh._of(found["body"])))


def search_mesh(
    body: BrightMesh,
    curves: LightCurve | Iterable[LightCurve],
    periods: Iterable[Periods],
    *,
    starts: int = 1000,
    within: float = 1.5,
    threads: int = 1,
    seed: int = 0,
    tries: int = 60,
    short_iterations: int = 6,
    finalists: int = 4,
    moments: str = "start",
    multiple: bool = False,
    loss: Loss = "squared",
    most_iterations: int = 60,
) -> LightSearchResult:
    """All spin states of a tumbling body of known shape that light curves allow, from many starts.

    Parameters
    ----------
    body : BrightMesh whose shape, law and inertia are known; its attitude, rate and t0 are not
        looked at. With its moments a pair of periods leaves a phase of the polhode and an attitude
        to be found, on either side of the axis of circulation.
    curves : LightCurve, one or several, with vectors.
    periods : (mode, P_phi, P_psi), mode "SAM" or "LAM": FourierScan.periods lists them. Those that
        the body cannot have are left out, and a note says how many.
    starts : in all, taken by the pairs of periods in turn.
    within : chi-square, or the sum under a robust loss, over the lowest, up to which solutions are
        reported.
    threads : the bits of the result do not depend on it.
    seed : of starts.
    tries : attitudes of a start, of which the best is taken, by some 60 points.
    short_iterations : of each start.
    finalists : of each pair of periods that are fitted to the end, with most_iterations.
    moments : "start", as they are, or "fit", of finalists. multiple, loss : as in fit_mesh.

    Returns
    -------
    LightSearchResult
        Bodies of solutions are BrightMesh. Seen and lit from fixed directions, a body has the same
        light after a half turn about the bisector of Sun and observer: two poles, where an
        ellipsoid has four.

    DomainError (a ValueError) as fit_mesh, and without periods. Ctrl-C ends it between two
    attitudes. Releases the GIL.
    """
    if not isinstance(body, BrightMesh):
        raise TypeError(f"search_mesh: got {body!r}; expected BrightMesh")
    wanted = wanted_periods(periods)
    kind, scale = loss_of(loss)
    found = _core._search_mesh(
        curve_parts(curves), body._parts(), wanted, whole(starts, "starts"), whole(tries, "tries"),
        whole(short_iterations, "short_iterations"), whole(finalists, "finalists"),
        float(_number(within, "within")), one_of(moments, "moments", ("start", "fit")),
        bool(multiple), kind, scale, whole(most_iterations, "most_iterations"),
        whole(seed, "seed", 0), whole(threads, "threads"),
    )  # fmt: skip
    return search_result(found, wanted, [BrightMesh._of(parts) for parts in found["bodies"]])


class MeshResiduals(ResidualFunction):
    """Residuals of light curves as a function of the spin state of a body of known shape.

    Parameters as of fit_mesh: start, curves, moments, multiple, loss. Turns are about the attitude
    of the start, which is a solution where the function goes to polhode.posterior.

    Derivatives are exact between the directions at which a facet passes a terminator, where they
    have a step, or the edge of a shadow, where the residuals have one: optimisers come to rest
    beside the least, as fit_mesh does, and samplers refuse some more steps. Factors of sessions are
    the best ones at every x, and the derivatives know it.
    """

    def __init__(
        self,
        start: BrightMesh,
        curves: LightCurve | Iterable[LightCurve],
        *,
        moments: str = "start",
        multiple: bool = False,
        loss: Loss = "squared",
    ) -> None:
        super().__init__(
            _mesh_problem(start, curves, moments, multiple, loss, 1).residuals()
        )

    def state(self, x: ArrayLike) -> BrightMesh:
        """The body at x."""
        return BrightMesh._of(self._compiled.state(x))
