# SPDX-License-Identifier: MIT
"""What a picture of a run needs: times, states, body and units, from whatever holds them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

import polhode
from polhode import Body, RotorState
from polhode._core import _numbers
from polhode._output_files import OutputFile, read_output
from polhode.charts import attitude, attitude_matrix
from polhode.figures.columns import radians_in


@dataclass(frozen=True)
class RunData:
    """A run: times t (n,), states (n,), body; units by column name ("t", "w1", ...); a title.

    omega (n, 3): the angular velocity in body axes, in units["w1"]; None where it is I^-1 g of the
    states (no frame, no perturbation adds to the rate), in radians per unit of t."""

    t: NDArray[np.float64]
    states: RotorState
    body: Body
    units: Mapping[str, str] = field(default_factory=dict)
    title: str = ""
    omega: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "t", _numbers(self.t, "t"))
        if self.t.ndim != 1 or self.states.shape != self.t.shape or self.t.size == 0:
            raise ValueError(
                f"RunData: got times of shape {self.t.shape} and states of shape "
                f"{self.states.shape}; expected one row of each, at least one"
            )

    @property
    def time_unit(self) -> str:
        return self.units.get("t", "")


def run_data(source: Any, body: Body | None = None) -> RunData:
    """RunData of any run: itself, the path of a file that polhode wrote, a Trajectory, Results.

    Or anything with .t, .units and .states, or with the columns of q and g, or of q and omega.

    body: where the source has none (`source.body`, `source.scenario.body`, or the scenario inside
    the file)."""
    if isinstance(source, RunData):
        return source
    if isinstance(source, OutputFile):
        return data_of_file(source, body)
    if isinstance(source, (str, os.PathLike)):
        return data_of_file(read_output(source), body)
    of = getattr(source, "scenario", source)  # Results know the scenario that they are of
    body = body or getattr(of, "body", None)
    if body is None:
        raise TypeError(
            f"run_data: got {type(source).__name__} without a body; expected body=Body(...)"
        )
    units = dict(getattr(source, "units", None) or {})
    states = getattr(source, "states", None)
    if states is None:
        states = states_of_columns(source, body, units)
    omega = rates_of_columns(source, body) if isinstance(source, Mapping) else None
    return RunData(source.t, states, body, units, str(getattr(of, "title", "") or ""), omega)


def stacked(columns: Mapping[str, Any], names: tuple[str, ...]) -> NDArray[np.float64] | None:
    """Columns side by side (n, len(names)), or None where one is missing."""
    if not all(name in columns for name in names):
        return None
    return np.stack([_numbers(columns[name], name) for name in names], axis=-1)


def rates_of_columns(columns: Mapping[str, Any], body: Body) -> NDArray[np.float64] | None:
    """The angular velocity (n, 3) along principal axes: files have it along those of the tensor."""
    omega = stacked(columns, ("w1", "w2", "w3"))
    return None if omega is None else omega @ attitude_matrix(body.q_FB).T


def principal_attitudes(q: NDArray[np.float64], body: Body) -> NDArray[np.float64]:
    """Attitudes (n, 4) of principal axes, of those of the tensor as files have them."""
    to_principal = attitude_matrix(body.q_FB)
    if np.array_equal(to_principal, np.eye(3)):
        return q
    return attitude(to_principal @ attitude_matrix(q))


def states_of_columns(
    columns: Mapping[str, Any], body: Body, units: Mapping[str, str]
) -> RotorState:
    """States from the columns of a file: attitude qw..qz, momentum g1..g3 or angular velocity
    w1..w3, all of the axes of body.q_FB.

    w is the inertial angular velocity: I w is g only where no frame and no perturbation adds to the
    rate, so g1..g3 are taken first."""
    q = stacked(columns, ("qw", "qx", "qy", "qz"))
    g = stacked(columns, ("g1", "g2", "g3"))
    if q is not None and g is not None:
        return RotorState(principal_attitudes(q, body), g @ attitude_matrix(body.q_FB).T)
    omega = rates_of_columns(columns, body)
    if q is None or omega is None:
        raise ValueError(
            f"run_data: got the columns {', '.join(columns)}; expected the groups q and g, or "
            "q and omega"
        )
    unit = units.get("w1", "rad/s")
    radians = radians_in(unit.partition("/")[0])
    if radians is None:
        raise ValueError(f"run_data: got w1 in {unit}; expected an angle per time, as rad/s")
    return polhode.rotor_state(body, principal_attitudes(q, body), radians * omega)


def data_of_file(file: OutputFile, body: Body | None = None) -> RunData:
    """A file of `polhode run`: its rows, its units, and the scenario inside it for the body."""
    columns = file.columns
    if not len(file.table) or "t" not in columns:
        raise ValueError(f"run_data: got {file.path} without rows; expected what polhode run wrote")
    if body is None:
        body = polhode.Scenario.from_text(file.scenario, file.path).body
    states = states_of_columns(columns, body, file.units)
    omega = rates_of_columns(columns, body)
    return RunData(columns["t"], states, body, file.units, file.title, omega)
