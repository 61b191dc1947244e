# SPDX-License-Identifier: MIT
"""Results of Monte Carlo ensembles.

`Scenario.ensemble` runs one; polhode.vary has the distributions."""

from polhode._ensemble_histograms import EnsembleHistogram, FirstTimes
from polhode._scenarios import EnsembleResults
from polhode._signatures import explain_call, publish

__all__ = [
    "EnsembleHistogram",
    "EnsembleResults",
    "FirstTimes",
]
publish(globals())
explain_call(__name__, "Scenario.ensemble")  # a function before 0.1.0
