# SPDX-License-Identifier: MIT
"""Light curves, and the tumbling bodies that they are of: ellipsoids, convex bodies, meshes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _core
from polhode._arguments import column, loss_of, of_shape, rows, whole
from polhode._core import FacetShape, _number
from polhode._spin_fits import SpinState

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._arguments import Loss

    Array = NDArray[np.float64]


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
class ConvexShape:
    """A convex body by the areas of facets on fixed normals.

    Attributes
    ----------
    degree, rows : of the series of areas, 1 to 40, and of the 8 rows^2 normals.
    coefficients : ((degree + 1)^2,), c_lm at l^2 + l + m: an area is w exp(sum of c_lm Y_lm(n)),
        w the solid angle of its normal n. Y_lm is sqrt(4 pi) times the real orthonormal harmonic,
        so that Y_00 is 1.

    Fluxes (`model_fluxes`, fits) are those of patches: each facet stands for a small range of
    normals, so that its light fades smoothly at the terminator. The plain sum over `normals` and
    `areas` differs by 0.1 to 2.5 %.
    """

    degree: int
    rows: int
    coefficients: Any

    def __post_init__(self) -> None:
        object.__setattr__(self, "degree", whole(self.degree, "degree", 0))
        object.__setattr__(self, "rows", whole(self.rows, "rows"))
        object.__setattr__(self, "coefficients", column(self.coefficients, "coefficients"))

    @classmethod
    def of(cls, axes: ArrayLike, degree: int = 6, rows: int = 8) -> ConvexShape:
        """The facets of an ellipsoid with semi-axes (3,), in units of the second. ValueError for
        more coefficients than facets."""
        size, count = whole(degree, "degree", 0), whole(rows, "rows")
        return cls(*_core._facets_like(of_shape(axes, "axes", (3,)), size, count))

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
        return self.degree, self.rows, self.coefficients


@dataclass(frozen=True, eq=False)
class LightModel:
    """A tumbling body that scatters light.

    Attributes
    ----------
    spin : SpinState; body axes are those of the shape. Its inertia is what a fit with
        moments="start" or "fit" reads; with moments="shape" it is that of an even filling.
    shape : (3,), semi-axes a, b, c of an ellipsoid, of which only ratios act; a ConvexShape, whose
        axes are principal; or the FacetShape of a known body, whose facets shade each other.
    law : weights of the laws of Lommel and Seeliger, and of Lambert.
    """

    spin: SpinState
    shape: Any
    law: tuple[float, float] = (1.0, 0.0)

    def __post_init__(self) -> None:
        if not isinstance(self.spin, SpinState):
            raise TypeError(f"spin: got {self.spin!r}; expected SpinState")
        single, multiple = (float(_number(weight, "law")) for weight in self.law)
        object.__setattr__(self, "law", (single, multiple))
        if not isinstance(self.shape, (ConvexShape, FacetShape)):
            object.__setattr__(self, "shape", of_shape(self.shape, "shape", (3,)))

    @classmethod
    def homogeneous(
        cls, q: ArrayLike, w: ArrayLike, shape: Any, t0: float = 0.0,
        law: tuple[float, float] = (1.0, 0.0),
    ) -> LightModel:  # fmt: skip
        """With the inertia of an even filling about the centre of mass, of an ellipsoid or of a
        closed mesh; a ConvexShape is made a mesh first."""
        if isinstance(shape, (ConvexShape, FacetShape)):
            mesh = shape.mesh if isinstance(shape, ConvexShape) else shape
            return cls(SpinState(q, w, _core._homogeneous_inertia(mesh), t0), shape, law)
        a, b, c = (x * x for x in of_shape(shape, "shape", (3,)))
        return cls(SpinState(q, w, [b + c, c + a, a + b], t0), shape, law)

    def convex(self, degree: int = 6, rows: int = 8) -> LightModel:
        """An ellipsoid as facets (ConvexShape.of), from which fits of convex bodies begin."""
        if self.kind != "ellipsoid":
            raise TypeError(f"convex: got a body of kind {self.kind}; expected an ellipsoid")
        return LightModel(self.spin, ConvexShape.of(self.shape, degree, rows), self.law)

    @property
    def kind(self) -> str:
        """"ellipsoid", "convex" or "mesh"."""
        kinds = {ConvexShape: "convex", FacetShape: "mesh"}
        return kinds.get(type(self.shape), "ellipsoid")

    @property
    def mesh(self) -> FacetShape:
        """Of a convex body or a mesh."""
        if self.kind == "ellipsoid":
            raise TypeError("mesh: got an ellipsoid; expected a convex body or a mesh")
        return self.shape.mesh if self.kind == "convex" else self.shape

    def _parts(self) -> tuple[Any, ...]:
        shape = self.shape._parts() if self.kind == "convex" else self.shape
        return self.spin._parts(), shape, self.law

    @classmethod
    def _of(cls, parts: Sequence[Any]) -> LightModel:
        spin, shape, law = parts
        return cls(
            SpinState._of(spin), ConvexShape(*shape) if isinstance(shape, tuple) else shape, law
        )


def model_of(body: Any, function: str) -> LightModel:
    if not isinstance(body, LightModel):
        raise TypeError(f"{function}: got {body!r}; expected LightModel")
    return body


def model_fluxes(
    body: LightModel, curves: LightCurve | Iterable[LightCurve], loss: Loss = "squared"
) -> list[Array]:
    """Fluxes of a body at the points of each light curve, with the best factor of each session
    under a loss, as in fit_spin."""
    parts = model_of(body, "model_fluxes")._parts()
    return _core._model_fluxes(parts, curve_parts(curves), loss_of(loss))
