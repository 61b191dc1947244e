# SPDX-License-Identifier: MIT
"""Free rotation in detail: frequencies, periods, regimes, generating functions, golden cases."""

from polhode._core import (
    GeneratingFunction,
    GoldenCase,
    Regime,
    SadovFrequencies,
    SadovGeneratingFunction,
    SadovParameters,
    SadovQuadratures,
    free_events,
    free_rotation,
    generating_function,
    golden_cases,
    least_period_ratio,
    long_axis_period,
    psi_max,
    regime_name,
    rounding_sensitivity,
    sadov_frequencies,
    sadov_generating_function,
    sadov_parameters,
    sadov_quadratures,
    serret_branches,
    write_golden,
)
from polhode._signatures import publish

__all__ = [
    "GeneratingFunction",
    "GoldenCase",
    "Regime",
    "SadovFrequencies",
    "SadovGeneratingFunction",
    "SadovParameters",
    "SadovQuadratures",
    "free_events",
    "free_rotation",
    "generating_function",
    "golden_cases",
    "least_period_ratio",
    "long_axis_period",
    "psi_max",
    "regime_name",
    "rounding_sensitivity",
    "sadov_frequencies",
    "sadov_generating_function",
    "sadov_parameters",
    "sadov_quadratures",
    "serret_branches",
    "write_golden",
]
publish(globals())
