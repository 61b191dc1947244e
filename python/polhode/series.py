# SPDX-License-Identifier: MIT
"""Trigonometric series, Lie transforms and normal forms."""

from polhode._core import (
    CompiledSeries,
    LieMethod,
    LieTransform,
    ProductSize,
    RotorFrequencies,
    Series,
    SeriesTerm,
    Symbols,
    TransformSize,
    TriaxialNormalForm,
    Truncation,
)
from polhode._signatures import publish

__all__ = [
    "CompiledSeries",
    "LieMethod",
    "LieTransform",
    "ProductSize",
    "RotorFrequencies",
    "Series",
    "SeriesTerm",
    "Symbols",
    "TransformSize",
    "TriaxialNormalForm",
    "Truncation",
]
publish(globals())
