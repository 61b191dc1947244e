# SPDX-License-Identifier: MIT
"""Rates of states and elements: the effect of the terms of a system, equations of motion in every
variable set, the convective term."""

from polhode._core import (
    AndoyerRates,
    Effect,
    EulerPhaseRates,
    HubRates,
    RotorRates,
    andoyer_rates,
    at_damper_rate,
    canonical_rates,
    convective_term,
    effect,
    element_convective_term,
    element_rates,
    equations_of_motion,
    euler_phase_rates,
    hub_rates,
    modified_andoyer_rates,
    perturbation_rates,
    rotor_rates,
    wobble_time,
)
from polhode._signatures import publish

__all__ = [
    "AndoyerRates",
    "Effect",
    "EulerPhaseRates",
    "HubRates",
    "RotorRates",
    "andoyer_rates",
    "at_damper_rate",
    "canonical_rates",
    "convective_term",
    "effect",
    "element_convective_term",
    "element_rates",
    "equations_of_motion",
    "euler_phase_rates",
    "hub_rates",
    "modified_andoyer_rates",
    "perturbation_rates",
    "rotor_rates",
    "wobble_time",
]
publish(globals())
