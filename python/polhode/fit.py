# SPDX-License-Identifier: MIT
"""Fits of spin states to observations, their uncertainty and posteriors."""

from polhode._fit_tables import FitPredictions, FitResiduals
from polhode._posterior import Posterior, posterior
from polhode._residual_functions import ResidualFunction
from polhode._scenario_fits import (
    FitNumber,
    FitResults,
    LightScenarioSolution,
    ScenarioSolution,
    fit_scenario,
    simulate,
)
from polhode._signatures import explain_call, publish
from polhode._spin_fits import (
    FitSolution,
    Snapshots,
    SpinResiduals,
    SpinSolution,
    SpinState,
    fit_spin,
)

__all__ = [
    "FitNumber",
    "FitPredictions",
    "FitResiduals",
    "FitResults",
    "FitSolution",
    "LightScenarioSolution",
    "Posterior",
    "ResidualFunction",
    "ScenarioSolution",
    "Snapshots",
    "SpinResiduals",
    "SpinSolution",
    "SpinState",
    "fit_scenario",
    "fit_spin",
    "posterior",
    "simulate",
]
publish(globals())
explain_call(__name__, "polhode.fit.fit_scenario")  # a function before 0.1.0
