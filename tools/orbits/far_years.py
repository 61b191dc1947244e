#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where planets are farthest from JPL's DE406 between 1000 and 3000, for
tests/unit/ephemeris/ephemeris.cpp: lines "planet, JD (TDB), x, y, z" from the Sun in km, and what
ERFA's plan94 is off there and in 1800 to 2100, in arcsec.

    far_years.py       (needs jplephem, pyerfa and de406)"""

import warnings

import de406
import erfa
import numpy as np
from jplephem.ephem import Ephemeris

AU = 149597870.7  # km
PLANETS = {"mercury": 1, "venus": 2, "mars": 4, "jupiter": 5, "saturn": 6, "uranus": 7,
           "neptune": 8}  # fmt: skip
DAYS = np.linspace(2451545 - 364000, 2451545 + 364000, 40001)  # every 18 days


def main():
    warnings.simplefilter("ignore")  # of years that are far
    ephemeris = Ephemeris(de406)
    sun = ephemeris.position("sun", DAYS)
    best = (DAYS > 2451545 - 200 * 365.25) & (DAYS < 2451545 + 100 * 365.25)
    for name, number in PLANETS.items():
        there = (ephemeris.position(name, DAYS) - sun).T
        here = erfa.plan94(DAYS, 0.0, number)["p"] * AU
        apart = np.linalg.norm(np.cross(here, there), axis=1) / np.sum(there**2, axis=1)
        arcsec = apart * 648000 / np.pi
        k = int(np.argmax(arcsec))
        x, y, z = there[k]
        print(f"{{{name}, {DAYS[k]:.2f}, {{{x:.1f}, {y:.1f}, {z:.1f}}}}},"
              f"  // {arcsec[k]:.1f}, {arcsec[best].max():.1f} from 1800 to 2100")  # fmt: skip


if __name__ == "__main__":
    main()
