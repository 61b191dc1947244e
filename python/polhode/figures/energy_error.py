# SPDX-License-Identifier: MIT
"""How well runs keep the energy: its relative error against time, on a logarithmic scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter

import polhode
from polhode.figures.columns import axis_label
from polhode.figures.style import SINGLE_COLUMN, axes_or_new, series, styled

FLOOR = np.finfo(float).eps / 4
"""Errors of zero, for which a logarithmic axis has no place, are drawn here."""


@styled
def energy_error(
    trajectories: Any,
    system: Any,
    ax: Axes | None = None,
    *,
    labels: Sequence[str] | None = None,
    unit: str = "",
) -> Axes:
    """The relative error |E - E_0| / |E_0| of runs of one system, E_0 at the first sample of each.

    Parameters
    ----------
    trajectories : a Trajectory or Results, a list of them, or a mapping of labels to them. Anything
        with .t and .states will do.
    system : their System. It must have an energy that is constant: terms and frame without time.
    labels : for the legend; None: the methods of the trajectories, where there are several.
    unit : of time, for the axis.

    Returns
    -------
    The Axes. ValueError for a run whose E_0 is zero.

    Errors below 2^-54, zero among them, are drawn at 2^-54."""
    runs = _named(trajectories, labels)
    axis = axes_or_new(ax, SINGLE_COLUMN)
    for label, run in runs:
        energy = np.asarray(polhode.energy(system, run.t, run.states))
        if energy.size == 0 or energy[0] == 0:
            raise ValueError(
                f"energy_error: the energy at the first sample of {label or 'the run'} is "
                f"{'unknown' if energy.size == 0 else 0}; expected a number other than zero"
            )
        error = np.maximum(np.abs((energy - energy[0]) / energy[0]), FLOOR)
        axis.plot(run.t, error, label=label, **series(len(axis.get_lines())).line)
    axis.set_yscale("log")
    # A label at each decade is more than a column of a journal has room for.
    axis.yaxis.set_major_locator(LogLocator(numticks=7))
    axis.yaxis.set_minor_formatter(NullFormatter())
    axis.margins(x=0)
    axis.set_xlabel(axis_label(["t"], unit))
    axis.set_ylabel(r"$|E - E_0| \, / \, |E_0|$")
    if axis.get_legend_handles_labels()[1]:
        axis.legend(loc="best")
    return axis


def _named(trajectories: Any, labels: Sequence[str] | None) -> list[tuple[str | None, Any]]:
    """(label, run) of each run."""
    # Results are a mapping too: of their columns.
    if isinstance(trajectories, Mapping) and not hasattr(trajectories, "t"):
        return list(trajectories.items())
    runs = list(trajectories) if isinstance(trajectories, (list, tuple)) else [trajectories]
    if labels is None:
        labels = [getattr(run, "method", None) if len(runs) > 1 else None for run in runs]
    if len(labels) != len(runs):
        raise ValueError(f"energy_error: got {len(labels)} labels; expected {len(runs)}")
    return list(zip(labels, runs))
