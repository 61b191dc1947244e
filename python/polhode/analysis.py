# SPDX-License-Identifier: MIT
"""Analysis of motions: spectra, chaos indicators, surfaces of section, state transitions."""

from polhode._core import (
    AndoyerAngle,
    AndoyerSection,
    ChaosIndicator,
    DeviationBy,
    Spectrum,
    SpinOrbitSection,
    TransitionSamples,
    andoyer_section,
    chaos_indicator,
    spectrum,
    spin_orbit_section,
    state_transitions,
)
from polhode._free_wobble import FreeWobble, without_free_wobble
from polhode._harmonics import ArgumentFit, HarmonicFit, argument_fit, harmonic_fit
from polhode._signatures import publish

__all__ = [
    "AndoyerAngle",
    "AndoyerSection",
    "ArgumentFit",
    "ChaosIndicator",
    "DeviationBy",
    "FreeWobble",
    "HarmonicFit",
    "Spectrum",
    "SpinOrbitSection",
    "TransitionSamples",
    "andoyer_section",
    "argument_fit",
    "chaos_indicator",
    "harmonic_fit",
    "spectrum",
    "spin_orbit_section",
    "state_transitions",
    "without_free_wobble",
]
publish(globals())
