# SPDX-License-Identifier: MIT
"""Fits of scenarios: from the files of what was observed to spin states with their errors."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode import _core
from polhode._arguments import column, whole
from polhode._fit_tables import FitPredictions, FitResiduals
from polhode._light_bodies import LightCurve, LightModel
from polhode._light_fits import FoundLight, LightResiduals, found_light
from polhode._notebook import html_rows
from polhode._posterior import Posterior, posterior
from polhode._scans import FourierScan, scan_of
from polhode._scenarios import Scenario, load
from polhode._spin_fits import SpinResiduals, SpinState
from polhode._tables import plotted

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from polhode._scenarios import Path

    Array = NDArray[np.float64]


@dataclass(frozen=True)
class FitNumber:
    """One unknown of a solution, in the units of the scenario: turns from the attitude of the start
    of the file, about the body axes. Scaled: with errors that make chi-square per degree of freedom
    1 (of light under a robust loss: with those of the spread of residuals), None without degrees of
    freedom; with priors the value moves, too."""

    unit: str
    start: float
    value: float
    error: float
    scaled_value: float | None = None
    scaled_error: float | None = None


class ScenarioSolution:
    """One of the solutions of FitResults. Everything is in the units of the scenario."""

    def __init__(self, results: FitResults, place: Any) -> None:
        self._results, self._place = results, place
        self._found: dict[str, Any] = results._report["solutions"][place]

    @property
    def unknowns(self) -> dict[str, FitNumber]:
        """FitNumber by name: `solution.unknowns["w_x"].value`."""
        return {
            name: FitNumber(**{
                key: np.inf if value is None else value for key, value in one.items()
            })
            for name, one in self._found["unknowns"].items()
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Of the unknowns, in the order of the covariance."""
        return tuple(self._found["unknowns"])

    @property
    def covariance(self) -> Array:
        """(P, P), with errors as they were given, in products of the units of the unknowns."""
        matrix = _matrix(self._found["covariance_core"])
        factors = self._factors(matrix)
        return matrix * np.outer(factors, factors)

    @property
    def scaled_covariance(self) -> Array | None:
        """The same with scaled errors: of data and priors together, as they weigh then. None
        without degrees of freedom."""
        found = self._results._compiled.scaled(self._place)
        if found is None:
            return None
        n = len(self.names)
        factors = self._factors(_matrix(self._found["covariance_core"]))
        return np.asarray(found["covariance"]).reshape(n, n) * np.outer(factors, factors)

    def _factors(self, matrix: Array) -> Array:
        """One of each unknown as the core has it, in its unit here."""
        units = self._results.scenario.units
        numbers = self.unknowns.values()
        return np.array([
            _factor(units, name, number.error, error)
            for name, number, error in zip(self.names, numbers, np.sqrt(np.diag(matrix)))
        ])

    @property
    def correlations(self) -> Array:
        """(P, P), NaN for what is not determined."""
        covariance = self.covariance
        errors = np.sqrt(np.diag(covariance))
        with np.errstate(invalid="ignore"):
            return covariance / np.outer(errors, errors)

    @property
    def chi_square(self) -> float:
        """Of the data, with errors as they were given."""
        return self._found["chi_square"]

    @property
    def degrees_of_freedom(self) -> float:
        """Numbers of data less the unknowns that they determine."""
        return self._found["degrees_of_freedom"]

    @property
    def error_factor(self) -> float | None:
        """That of scaled errors; None without degrees of freedom."""
        return self._found.get("error_factor")

    @property
    def converged(self) -> bool:
        """True: what did not converge is no solution."""
        return self._found.get("converged", True)

    @property
    def notes(self) -> list[str]:
        """Which combinations the data do not determine, and more to know."""
        return list(self._found.get("notes", ()))

    @property
    def report(self) -> dict[str, Any]:
        """All that `polhode fit --json` says of it."""
        return self._found

    @property
    def text(self) -> str:
        """The scenario file that begins at the solution: kind "rotation", which `polhode run`
        takes."""
        return self._results._compiled.solution_text(self._place)

    @property
    def scenario(self) -> Scenario:
        """The same as a Scenario, which runs."""
        return Scenario.from_text(self.text, self._results.scenario._file.path)

    @property
    def state(self) -> SpinState:
        """At t = 0 of the scenario, radians and its unit of time."""
        return SpinState._of(self._results._compiled.raw(self._place)["state"])

    @property
    def residuals(self) -> FitResiduals:
        """Columns by name; see FitResiduals."""
        return FitResiduals(*self._results._compiled.residuals(self._place))

    def predicted(self, times: ArrayLike | str | Sequence[str] | None = None) -> FitPredictions:
        """The attitude at other times, with the errors that the fit leaves: what `polhode fit
        --predict` writes.

        times : (N,) in the unit of time of the scenario, or dates, "2004-10-07T13:56:00 UTC". None:
            the rows of [time].

        DomainError (a ValueError) for what is no time, and without any."""
        words = [] if times is None else _words_of(times)
        if times is not None and not words:
            raise ValueError("times: got none; expected numbers or dates")
        return FitPredictions(*self._results._compiled.predicted(self._place, words))

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return _solution, (self._results, self._place)

    def __copy__(self) -> ScenarioSolution:
        return self

    def __deepcopy__(self, memo: object) -> ScenarioSolution:
        return self

    def residual_function(
        self, scaled: bool = False, epoch: float | None = None
    ) -> SpinResiduals | LightResiduals:
        """Residuals as a function of the unknowns, from this solution on, for other optimisers: in
        radians and the scenario's unit of time, turns about the attitude that was found.

        scaled : with errors of data that make chi-square per degree of freedom 1.
        epoch : when the attitude and the rate are those of the unknowns. None: midway between the
            first and the last observation, where they depend least on each other; 0 where the
            scenario has priors of them, which hold there. `f.state(x)` has it as t0.

        Numbers of torques are in the unit of the scenario, jumps in radians, its unit of time and
        that of moments; each call integrates the motion then, with derivatives some tens of
        microseconds a radian of rotation.

        It pickles as the scenario and where it begins: its files are read again."""
        at = None if epoch is None else float(_core._number(epoch, "epoch"))
        problem = self._results._compiled.problem(self._place, bool(scaled), at)
        file = self._results.scenario._file
        inputs = (file.text, os.path.abspath(file.path), _core._spin_problem_parts(problem))
        return _residuals(problem, inputs)

    def sample(
        self, scaled: bool = False, epoch: float | None = None, **keywords: Any
    ) -> Posterior:
        """Draws from the posterior about this solution: polhode.fit.posterior of residual_function(
        scaled, epoch), with its keywords. Needs the packages of `pip install polhode[sample]`."""
        return posterior(self.residual_function(scaled, epoch), **keywords)

    def __repr__(self) -> str:
        lines = [" ".join(text for text in cells if text) for cells in self._cells()]
        numbers = f"chi-square {self.chi_square:.4g} on {self.degrees_of_freedom:.4g}"
        head = f"<{type(self).__name__}: {numbers}"
        return "\n".join([head, *(f"  {line}" for line in lines)]) + ">"

    def _cells(self) -> list[tuple[str, str, str, str]]:
        return [
            (
                name, f"{n.value:.7g} +- {n.error:.3g}", "" if n.unit == "1" else n.unit,
                "" if n.scaled_error is None else
                f"(scaled {n.scaled_value:.7g} +- {n.scaled_error:.3g})",
            )
            for name, n in self.unknowns.items()
        ]  # fmt: skip


class LightScenarioSolution(ScenarioSolution):
    """One of the solutions of FitResults of light curves: a ScenarioSolution, and what search_light
    says of it. Figures of light curves take it."""

    @property
    def light(self) -> FoundLight:
        """What search_light would return, in radians and the scenario's unit of time: body, mode,
        periods, pole, what it is beside earlier solutions, `model` of the curves."""
        return found_light(self._results._compiled.raw(self._place))

    @property
    def body(self) -> LightModel:
        """Spin state and shape; its t0 is the middle of the light curves, or 0 from a start."""
        return self.light.body

    def write(self, path: Path) -> None:
        """Writes the scenario that begins at the solution, and of a convex body its mesh beside it:
        PATH-seen.obj beside PATH.toml, which the scenario names. OutputError (a RuntimeError) when
        writing fails."""
        self._results._compiled.write(self._place, path)

    @property
    def text(self) -> str:
        """The scenario file that begins at the solution: of kind "fit", which runs and is fitted
        again. That of a convex body names a mesh "seen.obj" that is not there: `write` leaves
        both."""
        return self._results._compiled.solution_text(self._place)

    @property
    def scenario(self) -> Scenario:
        """The same as a Scenario, which runs: motion needs no mesh. To simulate or fit what a
        convex body was found to be, load what `write` leaves."""
        return super().scenario

    @property
    def state(self) -> SpinState:
        """That of the body: radians and the scenario's unit of time."""
        return self.body.spin

    @property
    def unknowns(self) -> dict[str, FitNumber]:
        """FitNumber by name; without a start of the file `start` is the value."""
        return {
            name: _of_light(one)
            for name, one in self._found["unknowns"].items()
        }  # fmt: skip

    @property
    def precession_period(self) -> FitNumber:
        """P_phi of the long axis; 0 where the regime has none."""
        return _of_light(self._found["precession_period"])

    @property
    def rotation_period(self) -> FitNumber:
        """P_psi; 0 where the regime has none."""
        return _of_light(self._found["rotation_period"])

    @property
    def short_axis_period(self) -> FitNumber:
        """That of the short axis about the momentum, which most papers give; 0 where the regime has
        none."""
        return _of_light(self._found["short_axis_period"])

    @property
    def describes_data(self) -> bool:
        """Whether chi-square per degree of freedom (under a robust loss the square of the spread)
        is at most 10. If that is so of no solution, the report has no errors: they are infinite."""
        return self._found["describes_data"]

    @property
    def scaled_covariance(self) -> Array | None:
        """The same with scaled errors; None without degrees of freedom."""
        factor = self.error_factor
        return None if factor is None else factor**2 * self.covariance

    def residual_function(self, scaled: bool = False, epoch: object = None) -> LightResiduals:
        """Residuals as a function of the unknowns, from this solution on, for other optimisers: in
        radians and the scenario's unit of time, turns about the attitude that was found.

        scaled : with errors that make chi-square per degree of freedom 1.
        epoch : None; it is the middle of the light curves."""
        if epoch is not None:
            raise ValueError(
                f"epoch: got {epoch!r}; expected None: it is the middle of the light curves"
            )
        compiled = self._results._compiled.residuals_from(self._place, bool(scaled))
        made = LightResiduals._of(compiled)
        made._inputs = (_light_residuals, (self, bool(scaled)))
        return made


def _words_of(times: Any) -> list[str]:
    """Of dates as they are, and of numbers with every digit."""
    if isinstance(times, str):
        return [times]
    if isinstance(times, (list, tuple)) and any(isinstance(one, str) for one in times):
        return [one if isinstance(one, str) else repr(_core._number(one, "times"))
                for one in times]  # fmt: skip
    return [repr(float(one)) for one in column(times, "times")]


def _solution(results: FitResults, place: int) -> ScenarioSolution:
    return results[place]


def _residuals(problem: Any, inputs: tuple[Any, ...]) -> SpinResiduals:
    made = SpinResiduals._of(problem.residuals())
    made._inputs = (_residuals_again, inputs)
    return made


def _residuals_again(text: str, path: str, parts: tuple[Any, ...]) -> SpinResiduals:
    problem = _core._spin_problem_of(Scenario.from_text(text, path)._file, parts)
    return _residuals(problem, (text, path, parts))


def _light_residuals(solution: ScenarioSolution, scaled: bool) -> Any:
    return solution.residual_function(scaled)


def _of_light(one: Mapping[str, Any]) -> FitNumber:
    """Errors scale, values stay."""
    given = {key: np.inf if value is None else value for key, value in one.items()}
    value = given["value"]
    scaled = {"scaled_value": value} if "scaled_error" in given else {}
    return FitNumber(**{"start": value, **scaled, **given})


class FitResults:
    """What a fit of a scenario found: solutions by chi-square. Made by
    polhode.fit.fit_scenario.

    `results.solutions[0]` is the best; `len(results)`, `results[k]` and loops go over solutions.

    They pickle as the scenario, whose files are read and fitted again: the same numbers, and the
    time of the fit once more. What takes long is kept by its `report` and the `text` of solutions.
    Copies are the results themselves, which do not change.
    """

    def __init__(self, scenario: Scenario, compiled: Any) -> None:
        self._scenario, self._compiled = scenario, compiled
        self._report: dict[str, Any] = json.loads(compiled.json)
        of_light = self._report.get("observed") == "light-curves"
        kind: type[ScenarioSolution] = LightScenarioSolution if of_light else ScenarioSolution
        self._solutions = [kind(self, k) for k in range(len(self._report["solutions"]))]

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        file = self._scenario._file
        return _fitted_again, (file.text, os.path.abspath(file.path))

    def __copy__(self) -> FitResults:
        return self

    def __deepcopy__(self, memo: object) -> FitResults:
        return self

    @property
    def scenario(self) -> Scenario:
        """What was fitted."""
        return self._scenario

    @property
    def solutions(self) -> list[ScenarioSolution]:
        """By chi-square; none that did not converge."""
        return list(self._solutions)

    @property
    def curves(self) -> list[LightCurve]:
        """What was observed, of light curves; else none."""
        return [LightCurve._of(parts) for parts in getattr(self._compiled, "curves", ())]

    @property
    def scan(self) -> FourierScan | None:
        """The landscape of a search with its minima, which figures.scan_landscape draws; None where
        no scan was made."""
        found = getattr(self._compiled, "scan", None)
        if found is None:
            return None
        unit = self._report["units"]["time"]
        return scan_of(found, self._report["scan"]["order"], self._report["points"], unit)

    @property
    def starts(self) -> int:
        """How many there were."""
        return self._report["starts"]

    @property
    def failed(self) -> int:
        """Starts from which nothing converged; of light curves those that were fitted to the
        end."""
        if "finalists" in self._report:
            return self._report["finalists"] - self._report["converged"]
        return self._report.get("failed", 0)

    @property
    def failure(self) -> str:
        """What was said of the first of them; empty where there are none."""
        return self._report.get("failure", "")

    @property
    def report(self) -> dict[str, Any]:
        """All that `polhode fit --json` says, as a dict."""
        return self._report

    @property
    def text(self) -> str:
        """What `polhode fit` prints."""
        return self._compiled.text

    def plot(self, columns: str | Sequence[str] = ()) -> Any:
        """The residuals of the first solution, of light curves with the fluxes.

        Parameters
        ----------
        columns : names of columns to draw; none: all residuals.

        Returns
        -------
        Axes of Matplotlib, or an array of them, as of polhode.figures.plot. ImportError without
        Matplotlib.
        """
        return plotted(self, columns)

    def __len__(self) -> int:
        return len(self._solutions)

    def __getitem__(self, place: int) -> ScenarioSolution:
        return self._solutions[place]

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        title = self._scenario.title or self._scenario.name
        if not self._solutions:
            return f"<FitResults: {title}: no solution; {self.failure}>"
        head = f"<FitResults: {title}: {len(self)} solutions of {self.starts} starts"
        return "\n".join([head, *(f"  {one!r}" for one in self._solutions)]) + ">"

    def _repr_html_(self) -> str:
        import html

        title = html.escape(self._scenario.title or self._scenario.name)
        parts = [f"<p><b>{title}</b><br>{len(self)} solutions of {self.starts} starts</p>"]
        for k, one in enumerate(self._solutions, 1):
            head = (f"Solution {k}: chi-square {one.chi_square:.4g} on "
                    f"{one.degrees_of_freedom:.4g} degrees of freedom")  # fmt: skip
            parts.append(html_rows(head, one._cells(), ("", "value", "unit", "")))
        if not self._solutions:
            parts.append(f"<p>{html.escape(self.failure)}</p>")
        return "".join(parts)


def _matrix(rows: Any) -> Array:
    return np.array([[np.inf if x is None else x for x in row] for row in rows], dtype=float)


def _factor(units: Any, name: str, error: float, core_error: float) -> float:
    """One radian, or one rad per unit of time, in the units of an unknown; of jumps, whose unit is
    that of their kind, by their errors."""
    if name.startswith("turn_"):
        return units.from_core(1.0, "angle")
    if name.startswith("w_"):
        return units.from_core(1.0, "rate")
    return error / core_error if 0.0 < core_error < np.inf and np.isfinite(error) else 1.0


def _loaded(scenario: Scenario | Path, function: str) -> Scenario:
    if isinstance(scenario, Scenario):
        return scenario
    if not isinstance(scenario, (str, bytes, os.PathLike)):
        raise TypeError(f"{function}: got {scenario!r}; expected a Scenario or a path")
    return load(scenario)


def fit_scenario(
    scenario: Scenario | Path,
    *,
    starts: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> FitResults:
    """From what was observed to spin states with their uncertainty: what `polhode fit` does.

    Parameters
    ----------
    scenario : a Scenario of kind "fit", or the path of its file; the files of its tables
        [[observation]] lie next to it.
    starts, seed : of the table [fit], where they are not None.
    threads : starts, or parts of a scan, at a time; the result does not depend on it. None: as many
        as there are processors.
    progress : called with the starts that are done and their number, of light curves with
        thousandths of the work and 1000; what it raises ends the fit.

    Returns
    -------
    FitResults
        Without solutions where nothing converged: `.failure` says what to try. Of light curves
        `.scan` and `.curves`, too, and solutions are LightScenarioSolution.

    ScenarioError (a ValueError) for a scenario that is no fit and for a mistake in a file of
    observations, with its line; OSError for a file that is not there. Ctrl-C ends it between two
    starts. Releases the GIL.
    """
    of = _loaded(scenario, "fit_scenario")
    changes: Mapping[str, Any] = {
        key: whole(value, key, least)
        for key, value, least in (("starts", starts, 1), ("seed", seed, 0))
        if value is not None
    }
    if changes:
        of = of.replace({f"fit.{key}": value for key, value in changes.items()})
    count = whole(_core._hardware_threads() if threads is None else threads, "threads")
    return _fitted(of, count, progress)


def _fitted(of: Scenario, threads: int, progress: Any = None) -> FitResults:
    made = _core._fit_light_scenario if _core._observes_light(of._file) else _core._fit_scenario
    return FitResults(of, made(of._file, threads, progress))


def _fitted_again(text: str, path: str) -> FitResults:
    return _fitted(Scenario.from_text(text, path), _core._hardware_threads())


def simulate(scenario: Scenario | Path, folder: Path, *, overwrite: bool = False) -> list[str]:
    """What the observations of a scenario of kind "fit" would be, with noise: what `polhode
    simulate` does.

    Parameters
    ----------
    scenario : a Scenario of kind "fit" with [time], or the path of its file.
    folder : where the file of each [[observation]] goes, as its fit reads it.
    overwrite : whether files that are there may be replaced; they may be real observations.

    Returns
    -------
    list of str
        The paths of the files.

    DomainError (a ValueError) for a file that is there, and without [time]; ScenarioError for
    another scenario; OutputError (a RuntimeError) when writing fails.
    """
    of = _loaded(scenario, "simulate")
    return _core._simulate(of._file, folder, bool(overwrite))
