# SPDX-License-Identifier: MIT
"""Dates, Sun, Moon and planets, files of attitudes (AEM) and of orbits (OEM)."""

from polhode._core import (
    AemSegment,
    AttitudeEphemeris,
    Date,
    OemSegment,
    OrbitEphemeris,
    Planetary,
    TimeScale,
    calendar_date,
    date_after,
    j2000_from_teme,
    planetary_error,
    planetary_gm,
    planetary_orbit,
    planetary_position,
    read_aem,
    read_oem,
    seconds_between,
)
from polhode._signatures import publish

__all__ = [
    "AemSegment",
    "AttitudeEphemeris",
    "Date",
    "OemSegment",
    "OrbitEphemeris",
    "Planetary",
    "TimeScale",
    "calendar_date",
    "date_after",
    "j2000_from_teme",
    "planetary_error",
    "planetary_gm",
    "planetary_orbit",
    "planetary_position",
    "read_aem",
    "read_oem",
    "seconds_between",
]
publish(globals())
