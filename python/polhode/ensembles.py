# SPDX-License-Identifier: MIT
"""Ensembles: many runs of a scenario with some of its numbers drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from polhode.scenarios import EnsembleResults, Scenario, load

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from polhode import vary
    from polhode.scenarios import Path


def ensemble(
    scenario: Scenario | Path,
    vary: Mapping[Any, vary.Distribution] | None = None,
    outputs: Path | Iterable[Path] = (),
    *,
    size: int | None = None,
    seed: int | None = None,
    keep: str | None = None,
    quantiles: Sequence[float] | None = None,
    threads: int | None = None,
    executor: Executor | None = None,
    resume: bool = False,
    restart: bool = False,
    any_machine: bool = False,
    progress: Callable[[int, int], object] | None = None,
    **others: Any,
) -> EnsembleResults:
    """Many runs of a scenario with some of its numbers drawn: its members, and what they have in
    common.

    Parameters
    ----------
    scenario : a Scenario, or the path of its file.
    vary : what is drawn, by key: {"body.moments[0]": polhode.vary.uniform(0.60, 0.63)}. Several
        keys that are drawn together stand in a tuple, and an array by its name. None: what the
        table [ensemble] of the scenario says. What is given takes the place of all its tables
        [[ensemble.vary]]; the rest of [ensemble] stays: size, seed, quantiles, fractions,
        histograms.
    outputs : PATH.csv or PATH.h5, one or several, as those of Scenario.map; or "rows-{chunk}.h5", a
        file for each chunk, as in Scenario.ensemble.
    size : how many members.
    seed : another one draws other members.
    keep : "statistics" of the members at each time, memory not growing with them; "final", what was
        drawn and the last row of each member; "rows", all rows of all.
    quantiles : which ones statistics have, from 0 to 1.
    threads, executor, resume, restart, any_machine, progress : as in Scenario.ensemble.
    others : further keys of the table [ensemble] of scenario files, such as draws="sobol".

    What is None is what the scenario says, or the default of scenario files. The same numbers as
    `polhode ensemble` gives of the same file, to the last bit, for any number of threads
    and whoever computes them.

    Returns
    -------
    EnsembleResults
        A mapping of columns. `.failures` are the members that could not be, `.member(k)` is the
        scenario of one, `.scenario` that of the ensemble, which `polhode ensemble` runs as well.

    ScenarioError for a key that does not exist or cannot vary and for what is no distribution;
    RuntimeError where all members fail, with the first reasons; else as Scenario.ensemble.
    """
    of = scenario if isinstance(scenario, Scenario) else load(scenario)
    keys = {"size": size, "seed": seed, "keep": keep, "quantiles": quantiles, **others}
    if vary is not None or any(value is not None for value in keys.values()):
        of = of.with_ensemble(vary, **keys)
    return of.ensemble(
        outputs, threads=threads, executor=executor, resume=resume, restart=restart,
        any_machine=any_machine, progress=progress,
    )
