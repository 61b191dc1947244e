# SPDX-License-Identifier: MIT
"""Light curves: models of their bodies, fits, searches, periods."""

from polhode._light_bodies import ConvexShape, LightCurve, LightModel, model_fluxes
from polhode._light_fits import (
    FoundLight,
    JoinedSession,
    LightExtensionResult,
    LightResiduals,
    LightSearchResult,
    LightSolution,
    extend_light,
    fit_light,
    search_light,
)
from polhode._scans import (
    FourierScan,
    LikelyPeriods,
    PeriodLabel,
    ScanAdvice,
    ScanMinimum,
    fourier_scan,
    likely_periods,
    period_labels,
    scan_advice,
)
from polhode._signatures import publish

__all__ = [
    "ConvexShape",
    "FoundLight",
    "FourierScan",
    "JoinedSession",
    "LightCurve",
    "LightExtensionResult",
    "LightModel",
    "LightResiduals",
    "LightSearchResult",
    "LightSolution",
    "LikelyPeriods",
    "PeriodLabel",
    "ScanAdvice",
    "ScanMinimum",
    "extend_light",
    "fit_light",
    "fourier_scan",
    "likely_periods",
    "model_fluxes",
    "period_labels",
    "scan_advice",
    "search_light",
]
publish(globals())
