# SPDX-License-Identifier: MIT
"""Fits of light curves of tumbling bodies that are no ellipsoids: convex bodies, given meshes."""

from __future__ import annotations

from collections.abc import Iterable
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
)
from polhode.light_fits import (
    MOMENTS,
    LightSearchResult,
    LightSolution,
    light_parts,
    search_result,
    wanted_periods,
)
from polhode.residual_functions import ResidualFunction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._arguments import Loss
    from polhode.light_fits import Periods

    Array = NDArray[np.float64]


def _convex_problem(
    start: Any, curves: Any, body: Any, degree: Any, rows: Any, moments: Any, multiple: Any,
    errors: dict[str, Any], loss: Any, iterations: Any,
) -> Any:  # fmt: skip
    if not isinstance(start, EllipsoidModel):
        raise TypeError(f"fit_convex: got {start!r}; expected EllipsoidModel")
    if body is not None and not isinstance(body, ConvexModel):
        raise TypeError(f"body: got {body!r}; expected ConvexModel or None")
    kind, scale = loss_of(loss)
    return _core._convex_problem(
        curve_parts(curves), start._parts(), () if body is None else body._parts(),
        whole(degree, "degree", 0), whole(rows, "rows"), one_of(moments, "moments", MOMENTS),
        bool(multiple), [float(_number(x, name)) for name, x in errors.items()], kind, scale,
        whole(iterations, "most_iterations"),
    )  # fmt: skip


def fit_convex(
    start: EllipsoidModel,
    curves: LightCurve | Iterable[LightCurve],
    *,
    body: ConvexModel | None = None,
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
    degree, rows : of the areas of facets, see ConvexModel; 6 and 8 suit some 350 points, 3 and 4
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
        `body` is a ConvexModel. Unknowns: turn_x, turn_y, turn_z, w_x, w_y, w_z, then those asked
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
    return LightSolution(**light_parts(found, ConvexModel._of(found["body"])))


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
        start: EllipsoidModel,
        curves: LightCurve | Iterable[LightCurve],
        *,
        body: ConvexModel | None = None,
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

    def state(self, x: ArrayLike) -> ConvexModel:
        """The body at x."""
        return ConvexModel._of(self._compiled.state(x))


def _mesh_problem(
    start: Any, curves: Any, moments: Any, multiple: Any, loss: Any, iterations: Any
) -> Any:
    if not isinstance(start, MeshModel):
        raise TypeError(f"fit_mesh: got {start!r}; expected MeshModel")
    kind, scale = loss_of(loss)
    return _core._mesh_problem(
        curve_parts(curves), start._parts(), one_of(moments, "moments", ("start", "fit")),
        bool(multiple), kind, scale, whole(iterations, "most_iterations"),
    )  # fmt: skip


def fit_mesh(
    start: MeshModel,
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
    start : MeshModel near the answer: phases at the ends of the data within a quarter of a turn.
    curves : LightCurve, one or several, with vectors.
    moments : "start", as they are, or "fit", unknowns Ixx/Izz and Iyy/Izz: the axes of the mesh
        must be principal then.
    multiple, loss : as in fit_convex.

    Returns
    -------
    LightSolution
        `body` is a MeshModel. Unknowns: turn_x, turn_y, turn_z, w_x, w_y, w_z, then those asked
        for. `.converged` says whether it is a solution: nearer to the least than one standard
        error, as facets bend the light where they pass a terminator. At the edge of a shadow
        brightness jumps by a facet: fits of coarse meshes may stall there.

    DomainError (a ValueError) for light curves that are not sound, a start that no body has, fewer
    points than unknowns. Releases the GIL.
    """
    found = _mesh_problem(start, curves, moments, multiple, loss, most_iterations).fit()
    return LightSolution(**light_parts(found, MeshModel._of(found["body"])))


def search_mesh(
    body: MeshModel,
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
    body : MeshModel whose shape, law and inertia are known; its attitude, rate and t0 are not
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
        Bodies of solutions are MeshModel. Seen and lit from fixed directions, a body has the same
        light after a half turn about the bisector of Sun and observer: two poles, where an
        ellipsoid has four.

    DomainError (a ValueError) as fit_mesh, and without periods. Ctrl-C ends it between two
    attitudes. Releases the GIL.
    """
    if not isinstance(body, MeshModel):
        raise TypeError(f"search_mesh: got {body!r}; expected MeshModel")
    wanted = wanted_periods(periods)
    kind, scale = loss_of(loss)
    found = _core._search_mesh(
        curve_parts(curves), body._parts(), wanted, whole(starts, "starts"), whole(tries, "tries"),
        whole(short_iterations, "short_iterations"), whole(finalists, "finalists"),
        float(_number(within, "within")), one_of(moments, "moments", ("start", "fit")),
        bool(multiple), kind, scale, whole(most_iterations, "most_iterations"),
        whole(seed, "seed", 0), whole(threads, "threads"),
    )  # fmt: skip
    return search_result(found, wanted, [MeshModel._of(parts) for parts in found["bodies"]])


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
        start: MeshModel,
        curves: LightCurve | Iterable[LightCurve],
        *,
        moments: str = "start",
        multiple: bool = False,
        loss: Loss = "squared",
    ) -> None:
        super().__init__(
            _mesh_problem(start, curves, moments, multiple, loss, 1).residuals()
        )

    def state(self, x: ArrayLike) -> MeshModel:
        """The body at x."""
        return MeshModel._of(self._compiled.state(x))
