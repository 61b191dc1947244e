# SPDX-License-Identifier: MIT
"""Types of arguments and results of the top level that are rarely named."""

from polhode._core import (
    AnyPerturbation,
    Checkpoint,
    Crossing,
    DampedMaterial,
    Dual,
    DualState,
    EventRecord,
    FrameMotion,
    Outcome,
    Precision,
    SplittingScheme,
    Statistics,
)
from polhode._scenarios import Citation
from polhode._signatures import publish
from polhode._summary import Summary

__all__ = [
    "AnyPerturbation",
    "Checkpoint",
    "Citation",
    "Crossing",
    "DampedMaterial",
    "Dual",
    "DualState",
    "EventRecord",
    "FrameMotion",
    "Outcome",
    "Precision",
    "SplittingScheme",
    "Statistics",
    "Summary",
]
publish(globals())
