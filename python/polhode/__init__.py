# SPDX-License-Identifier: MIT
"""Rotation of rigid bodies, exact, in Serret-Andoyer and every related variable set.

Same names as in C++; NumPy in, NumPy out. polhode.figures draws (it needs matplotlib).
"""

from polhode import _core, elliptic, kinds, vary
from polhode._core import *  # noqa: F403
from polhode._core import __version__  # noqa: F401
from polhode._ensemble_histograms import EnsembleHistogram, FirstTimes
from polhode._notebook import show_tables
from polhode._signatures import (
    ClassSignature,
    explain_constructor,
    sign_methods,
    with_signature,
)
from polhode._summary import Summary
from polhode.ensembles import ensemble
from polhode.fits import (
    FitNumber,
    FitPredictions,
    FitResiduals,
    FitResults,
    LightScenarioSolution,
    ScenarioSolution,
    fit,
    simulate,
)
from polhode.free_wobble import FreeWobble, without_free_wobble
from polhode.harmonics import ArgumentFit, HarmonicFit, argument_fit, harmonic_fit
from polhode.interchange import to_scipy
from polhode.light_bodies import ConvexShape, LightCurve, LightModel, model_fluxes
from polhode.light_fits import (
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
from polhode.posterior import Posterior, posterior
from polhode.residual_functions import ResidualFunction
from polhode.scans import (
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
from polhode.scenarios import (
    Citation,
    EnsembleResults,
    MapResults,
    Results,
    Scenario,
    load,
)
from polhode.spin_fits import (
    FitSolution,
    Snapshots,
    SpinResiduals,
    SpinSolution,
    SpinState,
    fit_spin,
)

__all__ = [
    "ArgumentFit",
    "Citation",
    "ConvexShape",
    "EnsembleHistogram",
    "EnsembleResults",
    "FirstTimes",
    "FitNumber",
    "FitPredictions",
    "FitResiduals",
    "FitResults",
    "FitSolution",
    "FoundLight",
    "FourierScan",
    "FreeWobble",
    "HarmonicFit",
    "JoinedSession",
    "LightCurve",
    "LightExtensionResult",
    "LightModel",
    "LightResiduals",
    "LightScenarioSolution",
    "LightSearchResult",
    "LightSolution",
    "LikelyPeriods",
    "MapResults",
    "PeriodLabel",
    "Posterior",
    "ResidualFunction",
    "Results",
    "ScanAdvice",
    "ScanMinimum",
    "Scenario",
    "ScenarioSolution",
    "Snapshots",
    "SpinResiduals",
    "SpinSolution",
    "SpinState",
    "Summary",
    "argument_fit",
    "elliptic",
    "ensemble",
    "extend_light",
    "fit",
    "fit_light",
    "fit_spin",
    "fourier_scan",
    "harmonic_fit",
    "kinds",
    "likely_periods",
    "load",
    "model_fluxes",
    "period_labels",
    "posterior",
    "scan_advice",
    "search_light",
    "simulate",
    "to_scipy",
    "vary",
    "without_free_wobble",
    *(name for name in dir(_core) if not name.startswith("_") and name not in kinds.__all__),
]
del KindTable  # noqa: F821  a name of polhode.kinds

# Users, pickles and the reference know these things by where they are imported from, and inspect by
# their signatures.
for _name in __all__:
    _thing = globals()[_name]
    if isinstance(_thing, type):
        _thing.__module__ = __name__
        if type(_thing).__name__ == "nb_type" or issubclass(_thing, Exception):
            _thing.__signature__ = ClassSignature(_thing, vars(_core))
            sign_methods(_thing, vars(_core))
            if type(_thing).__name__ == "nb_type":
                explain_constructor(_thing, vars(_core))
    elif hasattr(_thing, "__nb_signature__"):
        globals()[_name] = with_signature(_thing, vars(_core))
        globals()[_name].__module__ = __name__
show_tables()
del _name, _thing, ClassSignature, explain_constructor, show_tables, sign_methods, with_signature
