# SPDX-License-Identifier: MIT
"""Draws from the posterior of a fit, by Hamiltonian Monte Carlo with exact gradients; needs mici
and arviz-stats (`pip install polhode[sample]`)."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode._arguments import whole
from polhode._columns import Columns
from polhode._core import _number
from polhode._notebook import html_rows
from polhode._residual_functions import ResidualFunction
from polhode._tables import imported

if TYPE_CHECKING:
    import xarray
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

# Vehtari et al. (2021): above or below these chains have not mixed, or are too short.
LARGEST_RHAT = 1.01
SMALLEST_ESS = 400.0
TAILS = (0.05, 0.95)
# Fewer draws a chain have no halves to compare.
LEAST_DRAWS = 4
# A start on a bound is put as far inside it: of the room between bounds, of 1 where one is open.
INSIDE = 1e-3


class Posterior(Columns):
    """Draws of the unknowns: `draws["w_x"]` is a column (chains * draws,).

    Made by polhode.fit.posterior and the method sample of solutions; figures.corner_plot draws it.

    In the order of the chains; units are those of the residual function: radians, rad per unit of
    time.
    """

    def __init__(
        self, names: tuple[str, ...], draws: Array, log_density: Array, divergences: Any,
        laplace: Array,
    ) -> None:  # fmt: skip
        chains, count, n = draws.shape
        table = draws.reshape(chains * count, n)
        table.flags.writeable = False
        units = ["rad" if name.startswith("turn_") else "rad/time" if name.startswith("w_") else "1"
                 for name in names]  # fmt: skip
        super().__init__([(name, [(name, unit)]) for name, unit in zip(names, units)], table)
        self._draws, self._log_density = draws, log_density
        self._divergences, self._laplace = divergences, laplace
        self._names = names

    @property
    def draws(self) -> Array:
        """(chains, draws, P)"""
        return self._draws

    @property
    def log_density(self) -> Array:
        """(chains, draws): log_posterior of each."""
        return self._log_density

    @property
    def divergences(self) -> int:
        """Trajectories that left the posterior: where there are some, a part of it may be too
        narrow to be seen."""
        return self._divergences

    @property
    def mean(self) -> Array:
        """(P,)"""
        return self._table.mean(axis=0)

    @property
    def covariance(self) -> Array:
        """(P, P) of the draws."""
        return np.atleast_2d(np.cov(self._table, rowvar=False))

    @property
    def laplace_covariance(self) -> Array:
        """(P, P): what the fit says, for comparison."""
        return self._laplace

    @property
    def rhat(self) -> Array:
        """(P,): split R-hat by ranks; above 1.01 the chains do not agree. (Vehtari et al. 2021)"""
        return self._of_each(_statistics().rhat)

    @property
    def ess(self) -> Array:
        """(P,): effective sample size, the lesser of that of the bulk and that of the tails."""
        ess = _statistics().ess
        bulk = self._of_each(lambda x, **axes: ess(x, method="bulk", **axes))
        return np.minimum(
            bulk, self._of_each(lambda x, **axes: ess(x, method="tail", prob=TAILS, **axes))
        )

    @property
    def converged(self) -> bool:
        """Whether every R-hat is at most 1.01, every effective size at least 400 and no trajectory
        has diverged."""
        return not self.diagnosis

    @property
    def diagnosis(self) -> list[str]:
        """What is wrong with the draws, a sentence each; empty where nothing is."""
        found = []
        for name, rhat, ess in zip(self._names, self.rhat, self.ess):
            if not rhat <= LARGEST_RHAT:
                found.append(f"{name}: R-hat {rhat:.3f}, above {LARGEST_RHAT}: more draws or a "
                             "longer warm_up; chains may be in different modes")  # fmt: skip
            elif not ess >= SMALLEST_ESS:
                found.append(f"{name}: effective sample size {ess:.0f}, below {SMALLEST_ESS:.0f}: "
                             "more draws")  # fmt: skip
        if self._divergences:
            found.append(f"{self._divergences} trajectories diverged: a higher target of accepted "
                         "steps (accept=0.95)")  # fmt: skip
        return found

    def quantiles(self, *q: float) -> Array:
        """(len(q), P); by default those of the median and of 1 sigma, 0.16, 0.5 and 0.84."""
        return np.quantile(self._table, q or (0.16, 0.5, 0.84), axis=0)

    def to_xarray(self) -> xarray.Dataset:
        """Along chain and draw, as ArviZ takes them."""
        made = imported("xarray").Dataset(
            {name: (("chain", "draw"), self._draws[..., k], {"units": self._units[name]})
             for k, name in enumerate(self._names)},
            attrs={"divergences": self._divergences},
        )  # fmt: skip
        return made.assign(lp=(("chain", "draw"), self._log_density))

    def _of_each(self, statistic: Callable[..., Any]) -> Array:
        axes = {"chain_axis": 0, "draw_axis": 1}
        return np.array([
            float(statistic(self._draws[..., k], **axes)) for k in range(len(self._names))
        ])

    def _cells(self) -> list[tuple[str, ...]]:
        errors = np.sqrt(np.diag(self.covariance))
        rows = zip(self._names, self.mean, errors, self.rhat, self.ess)
        return [
            (name, f"{m:.7g} +- {e:.3g}", f"R-hat {r:.3f}", f"ESS {n:.0f}")
            for name, m, e, r, n in rows
        ]

    def __repr__(self) -> str:
        chains, count, _ = self._draws.shape
        lines = ["  " + "  ".join(cells) for cells in self._cells()]
        notes = [f"  {text}" for text in self.diagnosis]
        return "\n".join([f"<Posterior: {chains} chains of {count} draws", *lines, *notes]) + ">"

    def _repr_html_(self) -> str:
        chains, count, _ = self._draws.shape
        table = html_rows(f"Posterior: {chains} chains of {count} draws", self._cells())
        return table + "".join(f"<p>{text}</p>" for text in self.diagnosis)


def posterior(
    of: ResidualFunction,
    *,
    draws: int = 1000,
    chains: int = 4,
    warm_up: int = 300,
    threads: int = 1,
    seed: int = 0,
    accept: float = 0.8,
) -> Posterior:
    """Draws from the posterior density of the unknowns of a fit, exp(of.log_posterior(x)).

    Parameters
    ----------
    of : SpinResiduals or LightResiduals, whose start is a solution;
        the method sample of a solution makes it.
    draws : of each chain, after warm_up draws that find the length of steps.
    chains : independent ones, started from Laplace's approximation, twice as wide.
    threads : chains at a time; the draws do not depend on it.
    seed : of the draws.
    accept : mean acceptance that steps are chosen for; higher means shorter.

    Returns
    -------
    Posterior
        With R-hat and effective sample sizes, and a RuntimeWarning that says what they tell where
        the draws have not converged.

    The prior is that of the residuals, flat within bounds and the triangle of moments otherwise,
    all attitudes alike. One solution is explored: images and aliases are others, each with a
    posterior of its own. Coordinates in which the posterior is nearly a ball (bounds taken away,
    Laplace's covariance) need no metric to be found.

    ImportError without mici and arviz-stats; ValueError where the data and priors do not determine
    all of the unknowns: a prior makes it proper. Ctrl-C ends it.
    """
    if not isinstance(of, ResidualFunction):
        raise TypeError(f"posterior: got {of!r}; expected SpinResiduals or another "
                        "ResidualFunction")  # fmt: skip
    _sampler_packages()
    count, number = whole(draws, "draws", LEAST_DRAWS), whole(chains, "chains")
    target = float(_number(accept, "accept"))
    if not 0.0 < target < 1.0:
        raise ValueError(f"accept: got {accept!r}; expected a number between 0 and 1")
    before = whole(warm_up, "warm_up")
    ball = _Ball(of)
    seeds = np.random.SeedSequence(whole(seed, "seed", 0)).spawn(number)

    def chain(seed_of: Any) -> Any:
        return _chain(ball, np.random.default_rng(seed_of), count, before, target)

    if whole(threads, "threads") == 1:
        found = [chain(one) for one in seeds]
    else:
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor(min(threads, number)) as pool:
            found = list(pool.map(chain, seeds))
    x = np.array([[ball.unknowns(z) for z in positions] for positions, _, _ in found])
    log_density = np.array([density for _, density, _ in found])
    made = Posterior(
        of.names, x, log_density, sum(diverged for *_, diverged in found), ball.laplace
    )
    if not made.converged:
        warnings.warn(
            "posterior: the draws have not converged: " + "; ".join(made.diagnosis),
            RuntimeWarning, stacklevel=2,
        )  # fmt: skip
    return made


def _sampler_packages() -> tuple[Any, Any]:
    try:
        return imported("mici"), _statistics()
    except ImportError as error:
        raise ImportError(
            f"posterior needs mici and arviz-stats: pip install polhode[sample] ({error})"
        ) from None


def _statistics() -> Any:
    return imported("arviz_stats.base").array_stats


class _Ball:
    """Coordinates z in which the posterior is nearly that of independent normal numbers."""

    def __init__(self, of: ResidualFunction) -> None:
        self._of = of
        self._free = Unbounded(of)
        x = self._free.inside(of.start)
        self.laplace = of.covariance(x)
        self._center = self._free.free(x)
        slope = self._free.slopes(self._center)  # dx/du
        inverse = np.linalg.inv(slope)
        self._root = np.linalg.cholesky(inverse @ self.laplace @ inverse.T)
        self.size = len(x)

    def unknowns(self, z: Array) -> Array:
        return self._free.unknowns(self._center + self._root @ z)

    def log_density(self, z: Array) -> float:
        u = self._center + self._root @ z
        return self._of.log_posterior(self._free.unknowns(u)) + self._free.log_volume(u)[0]

    def gradient_and_value(self, z: Array) -> tuple[Array, float]:
        """Of the density of z."""
        u = self._center + self._root @ z
        value, by_x = self._of.log_posterior_and_gradient(self._free.unknowns(u))
        volume, by_u = self._free.log_volume(u)
        return self._root.T @ (self._free.slopes(u).T @ by_x + by_u), value + volume


def _chain(ball: _Ball, rng: Any, draws: int, warm_up: int, accept: float) -> Any:
    """(positions, log densities by the unknowns, how many diverged)"""
    import mici

    def cost(z: Array) -> float:
        value = -ball.log_density(z)
        return value if np.isfinite(value) else np.inf

    def slope(z: Array) -> tuple[Array, float]:
        found, value = ball.gradient_and_value(z)
        if np.isfinite(value) and np.all(np.isfinite(found)):
            return -found, -value
        return np.zeros(len(z)), np.inf

    system = mici.systems.EuclideanMetricSystem(cost, grad_neg_log_dens=slope)
    integrator = mici.integrators.LeapfrogIntegrator(system)
    sampler = mici.samplers.DynamicMultinomialHMC(system, integrator, rng)
    start = _finite_start(ball, rng)
    final, traces, statistics = sampler.sample_chains(
        warm_up, draws, [start], display_progress=False,
        adapters=[mici.adapters.DualAveragingStepSizeAdapter(accept)],
        trace_funcs=[lambda state: {"z": state.pos}],
    )  # fmt: skip
    stepped = np.asarray(statistics["n_step"][0])
    if np.any(stepped < 0):  # mici keeps what there was before Ctrl-C
        raise KeyboardInterrupt
    positions = np.asarray(traces["z"][0])
    densities = [ball._of.log_posterior(ball.unknowns(z)) for z in positions]
    return positions, densities, int(np.count_nonzero(statistics["diverging"][0]))


def _finite_start(ball: _Ball, rng: Any) -> Array:
    """Twice as far as Laplace's approximation goes, or nearer where that is nowhere."""
    z = rng.standard_normal(ball.size)
    for spread in (2.0, 1.0, 0.5, 0.1, 0.0):
        if np.isfinite(ball.log_density(spread * z)):
            return spread * z
    raise ValueError("posterior: the start of the residuals has no finite density")


class Unbounded:
    """Free coordinates u of unknowns x that have bounds: one to one, with their volume.

    An unknown between two bounds is low + (high - low) / (1 + exp(-u)), one above its bound is
    low + exp(u). Ratios of moments X, Y with X + Y >= 1, |X - Y| <= 1 are X = 1 - s + w,
    Y = s + w with 0 < s < 1 and w > 0 (docs/design/0046-fit.md): these are bounded so.
    """

    def __init__(self, of: ResidualFunction) -> None:
        self._low, self._high = of.bounds
        self._triangle = of._compiled.triangle
        n = len(self._low)
        self._linear, self._shift = np.eye(n), np.zeros(n)  # x = linear y + shift
        if self._triangle is not None:
            i, k = self._triangle
            self._linear[i, i], self._linear[i, k], self._shift[i] = -1.0, 1.0, 1.0
            self._linear[k, i], self._linear[k, k] = 1.0, 1.0
            self._low[i], self._high[i] = 0.0, 1.0
            self._low[k], self._high[k] = 0.0, np.inf
        self._both = np.isfinite(self._low) & np.isfinite(self._high)
        self._one = np.isfinite(self._low) & ~self._both

    def inside(self, x: Array) -> Array:
        """x, off its bounds."""
        y = self._bounded(x)
        room = np.where(self._both, self._high - self._low, 1.0)
        has = self._both | self._one
        low = np.where(has, self._low + INSIDE * room, -np.inf)
        high = np.where(self._both, self._high - INSIDE * room, np.inf)
        kept = np.clip(y, low, high)
        return np.array(x, float) if np.array_equal(kept, y) else self._linear @ kept + self._shift

    def free(self, x: Array) -> Array:
        y = self._bounded(x)
        u = y.copy()
        b, o = self._both, self._one
        part = (y[b] - self._low[b]) / (self._high[b] - self._low[b])
        u[b] = np.log(part / (1.0 - part))
        u[o] = np.log(y[o] - self._low[o])
        return u

    def unknowns(self, u: Array) -> Array:
        y = np.array(u, float)
        b, o = self._both, self._one
        y[b] = self._low[b] + (self._high[b] - self._low[b]) * _logistic(u[b])
        y[o] = self._low[o] + np.exp(u[o])
        return self._linear @ y + self._shift

    def slopes(self, u: Array) -> Array:
        """(P, P): dx/du."""
        return self._linear * self._stretch(u)

    def log_volume(self, u: Array) -> tuple[float, Array]:
        """log |det dx/du| but for a constant, and its derivatives by u."""
        b, o = self._both, self._one
        value = float(np.sum(-np.logaddexp(0.0, u[b]) - np.logaddexp(0.0, -u[b])) + np.sum(u[o]))
        gradient = np.zeros(len(u))
        gradient[b] = 1.0 - 2.0 * _logistic(u[b])
        gradient[o] = 1.0
        return value, gradient

    def _stretch(self, u: Array) -> Array:
        k = np.ones(len(u))
        b, o = self._both, self._one
        s = _logistic(u[b])
        k[b] = (self._high[b] - self._low[b]) * s * (1.0 - s)
        k[o] = np.exp(u[o])
        return k

    def _bounded(self, x: Array) -> Array:
        if self._triangle is None:
            return np.array(x, float)
        return np.linalg.solve(self._linear, np.array(x, float) - self._shift)


def _logistic(u: Array) -> Array:
    return 0.5 * (1.0 + np.tanh(0.5 * u))
