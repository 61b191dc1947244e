# SPDX-License-Identifier: MIT
"""Attitudes, directions and rates that were seen, and the spin state that they are of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _core
from polhode._arguments import column, loss_of, of_shape, prior_rows, rows, some_of, whole
from polhode._core import _number, _numbers
from polhode._residual_functions import ResidualFunction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._arguments import Loss
    from polhode._core import Body, FreeRotation

    Array = NDArray[np.float64]

# Fewer say nothing of errors.
_LEAST_FREEDOM = 0.5
UNKNOWNS = ("attitude", "rate", "moments", "products")


@dataclass(frozen=True, eq=False)
class SpinState:
    """Attitude, rate and inertia at a time, in body axes F of your choice.

    Attributes
    ----------
    q : (4,), body axes F to inertial axes; a SciPy Rotation will do.
    w : (3,), the angular velocity along F, rad per unit of time.
    inertia : (3, 3), the tensor in F; made of that, of three moments about the axes F, or of a Body
        and its axes. Only ratios act. inertia[0][1] is minus the integral of x y dm.
    t0 : when.
    """

    q: Any
    w: Any
    inertia: Any
    t0: float = 0.0

    def __post_init__(self) -> None:
        body = self.inertia
        moments = isinstance(body, _core.Body)
        tensor = _tensor_of(body) if moments else np.array(_numbers(body, "inertia"), dtype=float)
        if tensor.shape == (3,):
            tensor = np.diag(tensor)
        for name, value in (
            ("q", of_shape(quaternions(self.q), "q", (4,))),
            ("w", of_shape(self.w, "w", (3,))),
            ("inertia", of_shape(tensor, "inertia", (3, 3))),
            ("t0", float(_number(self.t0, "t0"))),
        ):
            object.__setattr__(self, name, value)

    @property
    def body(self) -> Body:
        """With its principal moments and axes; those of a diagonal tensor keep their order."""
        I = self.inertia
        if np.array_equal(I, np.diag(np.diag(I))):
            return _core.Body(*np.diag(I))
        return _core.Body.from_tensor(I)

    @property
    def free_rotation(self) -> FreeRotation:
        """The motion from this state on, exact at any time; its states are along principal axes."""
        body = self.body
        w = _core.attitude_matrix(body.q_FB) @ self.w
        q = _product(self.q, body.q_FB)
        return _core.FreeRotation(body, _core.rotor_state(body, q, w), self.t0)

    def _parts(self) -> tuple[Any, ...]:
        return (self.t0, self.q, self.w, self.inertia)

    @classmethod
    def _of(cls, parts: Sequence[Any]) -> SpinState:
        t0, q, w, inertia = parts
        return cls(q, w, inertia, t0)


def _tensor_of(body: Any) -> Array:
    R = np.asarray(_core.attitude_matrix(body.q_FB))
    return R.T @ np.diag(body.moments) @ R  # v_B = R v_F


def quaternions(q: Any) -> Any:
    """Scalar first; of a SciPy Rotation, too."""
    return np.roll(q.as_quat(), 1, axis=-1) if hasattr(q, "as_quat") else q


def _product(a: Any, b: Any) -> Array:
    """Of quaternions."""
    (w, *u), (v, *x) = np.asarray(a), np.asarray(b)
    return np.concatenate([[w * v - np.dot(u, x)], w * np.array(x) + v * np.array(u)
                           + np.cross(u, x)])  # fmt: skip


class Snapshots:
    """What was seen of the attitude and the rate of a body at some times. Immutable.

    Parameters
    ----------
    attitudes : (times (N,), quaternions (N, 4), sigma): body axes F to inertial axes. sigma in
        radians about the body axes: a number, (3,), (N, 3), or covariances (N, 3, 3).
    directions : (times (N,), axes of the body (3,) or (N, 3), where they pointed (N, 3), sigma):
        along F and along inertial axes; sigma a number or (N,), radians, of each of two angles.
    rates : (times (N,), angular velocities (N, 3) along F, sigma): sigma as of attitudes, in rad
        per unit of time.

    TypeError and ValueError for what has another shape; a fit says what is wrong with a number.
    """

    def __init__(
        self,
        attitudes: Sequence[Any] | None = None,
        directions: Sequence[Any] | None = None,
        rates: Sequence[Any] | None = None,
    ) -> None:
        self._attitudes, self._directions = np.empty((0, 14)), np.empty((0, 8))
        self._rates = np.empty((0, 13))
        if attitudes is not None:
            t, q, sigma = _parts_of(attitudes, "attitudes", "(times, quaternions, sigma)")
            times = column(t, "attitudes: times")
            seen = rows(quaternions(q), "attitudes: quaternions", len(times), 4)
            covariances = _covariances(sigma, "attitudes: sigma", len(times))
            self._attitudes = np.column_stack([times, seen, covariances])
        if directions is not None:
            said = "(times, axes, directions, sigma)"
            t, axes, seen, sigma = _parts_of(directions, "directions", said)
            times = column(t, "directions: times")
            n = len(times)
            errors = np.array(_numbers(sigma, "directions: sigma"), dtype=float)
            if errors.shape not in ((), (n,)):
                raise ValueError(
                    f"directions: sigma: got shape {errors.shape}; expected () or ({n},)"
                )
            self._directions = np.column_stack([
                times, rows(axes, "directions: axes", n, 3),
                rows(seen, "directions: directions", n, 3), np.broadcast_to(errors, (n,)),
            ])  # fmt: skip
        if rates is not None:
            t, w, sigma = _parts_of(rates, "rates", "(times, rates, sigma)")
            times = column(t, "rates: times")
            seen = rows(w, "rates: rates", len(times), 3)
            covariances = _covariances(sigma, "rates: sigma", len(times))
            self._rates = np.column_stack([times, seen, covariances])

    @property
    def size(self) -> int:
        """How many numbers they are: three of an attitude or a rate, two of a direction."""
        return 3 * len(self._attitudes) + 2 * len(self._directions) + 3 * len(self._rates)

    def __repr__(self) -> str:
        return (
            f"<Snapshots: {len(self._attitudes)} attitudes, {len(self._directions)} directions, "
            f"{len(self._rates)} rates>"
        )

    def _tables(self) -> tuple[Array, Array, Array]:
        return self._attitudes, self._directions, self._rates


def _parts_of(given: Any, name: str, expected: str) -> Any:
    wanted = expected.count(",") + 1
    if not isinstance(given, (tuple, list)) or len(given) != wanted:
        raise ValueError(f"{name}: expected {expected}")
    return given


def _covariances(sigma: Any, name: str, n: int) -> Array:
    """(n, 9)"""
    errors = np.array(_numbers(sigma, name), dtype=float)
    if errors.shape == (n, 3, 3):
        return errors.reshape(n, 9)
    if errors.shape not in ((), (3,), (n, 3)):
        raise ValueError(
            f"{name}: got shape {errors.shape}; expected (), (3,), ({n}, 3) or ({n}, 3, 3)"
        )
    squares = np.broadcast_to(errors, (n, 3)) ** 2
    return (squares[:, :, None] * np.eye(3)).reshape(n, 9)


@dataclass(frozen=True, eq=False)
class FitSolution:
    """What a fit found: values of unknowns with their covariance, and how it ended.

    Attributes
    ----------
    names : of the unknowns; turns are about the attitude that was found, so that they are 0.
    values : (P,).
    covariance : (P, P), of errors of data as they were given, or as the fit scaled them.
    residuals : of data and priors, in standard errors as given.
    chi_square, degrees_of_freedom : of the data.
    cost : the sum that was minimised: of the data under the loss, and of priors.
    converged : whether this is a solution; `sentence` says what happened.
    bound : unknowns that are on a bound.
    notes : combinations that the data do not determine, observations that come twice, and moments
        that stay at their start, with infinite variances, where no wobble is seen.
    """

    names: tuple[str, ...]
    values: Array
    covariance: Array
    residuals: Array
    chi_square: float
    degrees_of_freedom: float
    cost: float
    converged: bool
    sentence: str
    iterations: int
    bound: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def errors(self) -> Array:
        """(P,): standard errors, infinite where nothing is known."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlations(self) -> Array:
        """(P, P)"""
        errors = self.errors
        with np.errstate(invalid="ignore"):
            return self.covariance / np.outer(errors, errors)

    @property
    def error_scale(self) -> float:
        """By which errors would be as large as residuals: sqrt(chi_square / degrees_of_freedom);
        NaN where the data leave no degrees of freedom."""
        freedom = self.degrees_of_freedom
        return float(np.sqrt(self.chi_square / freedom)) if freedom > _LEAST_FREEDOM else np.nan

    def _head(self) -> str:
        kind = type(self).__name__
        n = f"chi-square {self.chi_square:.4g} on {self.degrees_of_freedom:.4g}"
        return f"<{kind}: {self.sentence}; {n}"

    def __repr__(self) -> str:
        width = max(map(len, self.names))
        lines = [
            f"  {name:<{width}}  {value:.8g} +- {error:.3g}"
            for name, value, error in zip(self.names, self.values, self.errors)
        ]
        return "\n".join([self._head(), *lines]) + ">"


def common_parts(found: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of FitSolution of what the compiled function returned."""
    n = len(found["names"])
    return {
        **{key: found[key] for key in ("names", "values", "residuals", "chi_square",
                                       "degrees_of_freedom", "cost", "sentence", "iterations",
                                       "bound", "notes")},
        "covariance": np.asarray(found["covariance"]).reshape(n, n),
        "converged": found["end"] == "converged",
    }  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class SpinSolution(FitSolution):
    """The spin state that snapshots are of; made by fit_spin.

    Attributes
    ----------
    state : SpinState.
    error_factor : by which the errors of data were multiplied; those of priors never are.
    attitude_rms : rad about each axis, of attitudes; NaN without.
    """

    state: SpinState
    error_factor: float
    attitude_rms: float
    _problem: Any = None
    _found: Any = None
    _inputs: Any = None

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        """By what was fitted, which is fitted again: the compiled parts stay where they are."""
        return _fitted, (self._inputs,)

    def __copy__(self) -> SpinSolution:
        return self

    def __deepcopy__(self, memo: object) -> SpinSolution:
        return self

    def predicted(self, times: ArrayLike) -> tuple[Array, Array, Array]:
        """Quaternions (N, 4), rates (N, 3) and the covariance (N, 3, 3) of the rotation vector in
        body axes that the fit leaves, at times (N,)."""
        return self._problem.predicted(self._found, column(times, "times"))


def fit_spin(
    start: SpinState,
    seen: Snapshots,
    unknowns: str | Sequence[str] = ("attitude", "rate", "moments"),
    *,
    priors: Mapping[Any, Any] | None = None,
    attitude_prior: Sequence[Any] | None = None,
    loss: Loss = "squared",
    error_factor: float = 1.0,
    scales_errors: bool = False,
    most_iterations: int = 200,
) -> SpinSolution:
    """The spin state of a body in free rotation that was seen at some times, with its uncertainty.

    Parameters
    ----------
    start : where the search begins; what is not unknown stays.
    seen : Snapshots.
    unknowns : "attitude" (turn_x, turn_y, turn_z), "rate" (w_x, w_y, w_z), "moments" (Ixx/Izz,
        Iyy/Izz) and "products" (Ixy/Izz, Iyz/Izz, Ixz/Izz; Ixy is an element of the tensor, minus
        the integral of x y dm).
    priors : {"Ixx/Izz": (mean, sigma)}, or several at once {("w_x", "w_y"): (means, covariance)}.
    attitude_prior : (quaternion (4,), sigma), sigma as of Snapshots.
    loss : of a residual: "squared", "huber", "soft_l1" or "cauchy"; ("huber", 2.0) turns at 2
        standard errors.
    error_factor : the errors of data are multiplied by it.
    scales_errors : and by that which makes chi-square per degree of freedom 1.

    Returns
    -------
    SpinSolution
        Of what did not converge too: `.converged` says so.

    DomainError (a ValueError) for a start that no body has, errors that are not positive, fewer
    data than unknowns. Exact motion, exact derivatives; a few milliseconds. Releases the GIL.
    Solutions pickle as what was fitted, and are fitted again.
    """
    return _fitted((start, seen, unknowns, priors, attitude_prior, loss, error_factor,
                    scales_errors, most_iterations))  # fmt: skip


def _fitted(inputs: tuple[Any, ...]) -> SpinSolution:
    """Of the arguments of spin_problem."""
    problem = spin_problem(*inputs)
    found, compiled = problem.fit()
    return SpinSolution(
        **common_parts(found), state=SpinState._of(found["state"]),
        error_factor=found["error_factor"], attitude_rms=found["attitude_rms"],
        _problem=problem, _found=compiled, _inputs=inputs,
    )  # fmt: skip


def spin_problem(
    start: SpinState,
    seen: Snapshots,
    unknowns: Any,
    priors: Any,
    attitude_prior: Any,
    loss: Any,
    error_factor: Any = 1.0,
    scales_errors: bool = False,
    most_iterations: Any = 200,
) -> Any:
    for value, kind in ((start, SpinState), (seen, Snapshots)):
        if not isinstance(value, kind):
            raise TypeError(f"fit_spin: got {value!r}; expected {kind.__name__}")
    prior = None
    if attitude_prior is not None:
        q, sigma = _parts_of(attitude_prior, "attitude_prior", "(quaternion, sigma)")
        prior = np.concatenate([
            of_shape(quaternions(q), "attitude_prior", (4,)),
            _covariances(sigma, "attitude_prior", 1)[0],
        ])
    kind, scale = loss_of(loss)
    return _core._spin_problem(
        start._parts(), seen._tables(), some_of(unknowns, "unknowns", UNKNOWNS),
        prior_rows(priors), prior, kind, scale, float(_number(error_factor, "error_factor")),
        bool(scales_errors), whole(most_iterations, "most_iterations"),
    )  # fmt: skip


class SpinResiduals(ResidualFunction):
    """Residuals of snapshots as a function of the unknowns of a spin state, with derivatives.

    Parameters as of fit_spin: start, seen, unknowns, priors, attitude_prior, loss, error_factor.
    Turns are rotation vectors about the attitude of the start, along the body axes.

    scipy.optimize.least_squares(f.residuals, f.start, f.jacobian) minimises what fit_spin does;
    polhode.fit.posterior(f) samples. DomainError as fit_spin.
    """

    def __init__(
        self,
        start: SpinState,
        seen: Snapshots,
        unknowns: str | Sequence[str] = ("attitude", "rate", "moments"),
        *,
        priors: Mapping[Any, Any] | None = None,
        attitude_prior: Sequence[Any] | None = None,
        loss: Loss = "squared",
        error_factor: float = 1.0,
    ) -> None:
        problem = spin_problem(start, seen, unknowns, priors, attitude_prior, loss, error_factor)
        super().__init__(problem.residuals())

    def state(self, x: ArrayLike) -> SpinState:
        """The spin state at x."""
        return SpinState._of(self._compiled.state(x))
