# SPDX-License-Identifier: MIT
"""Shapes of bodies from facets: mass properties, torques of light."""

from polhode._core import (
    FacetShape,
    MassMoments,
    MassProperties,
    mass_properties,
    mean_pressure,
    read_obj,
    yorp_torque,
)
from polhode._signatures import publish

__all__ = [
    "FacetShape",
    "MassMoments",
    "MassProperties",
    "mass_properties",
    "mean_pressure",
    "read_obj",
    "yorp_torque",
]
publish(globals())
