#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The orbit of (4179) Toutatis from 1992 to 2008, from the Sun and from the Earth: the table of
examples/toutatis-2008.toml.

    toutatis.py > examples/toutatis-orbit.csv     (needs pyerfa and scipy; half a minute)

From the osculating elements of JPL's Small-Body Database (solution 726, epoch JD 2461200.5 TDB),
integrated back under the Sun with the leading term of relativity, the planets and the Moon, which
are those of ERFA. What was published for the years between (JPL: the Earth passed at 0.0104 au on
2004-09-29 and at 0.0502 au on 2008-11-09 at 12:23; osculating a = 2.5321 au, e = 0.6288, i = 0.4460
deg at JD 2454797.5) is met to these digits; the times of the passes to some minutes."""

import sys

import erfa
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

AU, DAY, LIGHT = 149597870.7, 86400.0, 299792.458  # km, s, km/s
UNIT = DAY**2 / AU**3  # km3/s2 in au3/d2
SUN = 132712440041.27942 * UNIT
PLANETS = {1: 22031.868551, 2: 324858.592, 4: 42828.375816, 5: 126712764.1, 6: 37940584.8418,
           7: 5794556.4, 8: 6836527.10058}  # fmt: skip
EARTH, MOON = 398600.435507 * UNIT, 4902.800118 * UNIT
EPOCH = 2461200.5
ELEMENTS = (2.543047155641573, 0.6246302247178447, 0.4480836624628189, 125.3654799655549,
            277.8615384113277, 125.5161576467994)  # fmt: skip
FIRST, LAST = 2448920.5, 2454830.0
OBLIQUITY = np.radians(84381.448 / 3600.0)


def along_ecliptic(x):
    c, s = np.cos(OBLIQUITY), np.sin(OBLIQUITY)
    return np.array([x[0], c * x[1] + s * x[2], c * x[2] - s * x[1]])


def earth(jd):
    """Position and velocity from the Sun."""
    heliocentric, _ = erfa.epv00(erfa.DJ00, jd - erfa.DJ00)
    return along_ecliptic(heliocentric["p"]), along_ecliptic(heliocentric["v"])


def bodies(jd):
    """(gm, position from the Sun)"""
    for number, gm in PLANETS.items():
        yield gm * UNIT, along_ecliptic(erfa.plan94(erfa.DJ00, jd - erfa.DJ00, number)["p"])
    centre, _ = earth(jd)
    yield EARTH, centre
    yield MOON, centre + along_ecliptic(erfa.moon98(erfa.DJ00, jd - erfa.DJ00)["p"])


def rates(jd, y):
    r, v = y[:3], y[3:]
    d = np.linalg.norm(r)
    a = -SUN / d**3 * r
    a += SUN / ((LIGHT * DAY / AU) ** 2 * d**3) * ((4 * SUN / d - v @ v) * r + 4 * (r @ v) * v)
    for gm, p in bodies(jd):
        s = p - r
        a += gm * (s / np.linalg.norm(s) ** 3 - p / np.linalg.norm(p) ** 3)
    return np.concatenate([v, a])


def state(a, e, i, node, pericentre, anomaly):
    i, node, pericentre, anomaly = np.radians([i, node, pericentre, anomaly])
    E = anomaly
    for _ in range(50):
        E -= (E - e * np.sin(E) - anomaly) / (1.0 - e * np.cos(E))
    b, turn = np.sqrt(1.0 - e * e), np.sqrt(SUN / a**3) / (1.0 - e * np.cos(E))
    c, s = np.cos, np.sin
    P = np.array([c(node) * c(pericentre) - s(node) * s(pericentre) * c(i),
                  s(node) * c(pericentre) + c(node) * s(pericentre) * c(i),
                  s(pericentre) * s(i)])  # fmt: skip
    Q = np.array([-c(node) * s(pericentre) - s(node) * c(pericentre) * c(i),
                  -s(node) * s(pericentre) + c(node) * c(pericentre) * c(i),
                  c(pericentre) * s(i)])  # fmt: skip
    return np.concatenate([a * ((c(E) - e) * P + b * s(E) * Q),
                           a * turn * (b * c(E) * Q - s(E) * P)])  # fmt: skip


def main():
    orbit = solve_ivp(rates, (EPOCH, FIRST), state(*ELEMENTS), method="DOP853", rtol=1e-11,
                      atol=1e-13, dense_output=True).sol  # fmt: skip

    def distance(days, about):
        jd = about + days
        return float(np.linalg.norm(orbit(jd)[:3] - earth(jd)[0]))

    passes = []
    for about in (2448964.7, 2450417.4, 2451848.7, 2453278.1, 2454780.0):
        least = minimize_scalar(distance, args=(about,), bounds=(-2.0, 2.0), method="bounded",
                                options={"xatol": 1e-6})  # fmt: skip
        passes.append((about + least.x, least.fun))
    print("# The asteroid (4179) Toutatis from the Sun (x, vx) and from the Earth (gx, gvx), along")
    print("# the ecliptic of J2000 in au and au/d, by tools/orbits/toutatis.py from elements of")
    print("# JPL's Small-Body Database (solution 726) at JD 2461200.5. Nearest to the Earth:")
    for jd, least in passes:
        print(f"#   JD {jd:.3f} TDB at {least:.6f} au")
    print("JDTDB,x,y,z,vx,vy,vz,gx,gy,gz,gvx,gvy,gvz")
    jd = FIRST
    while jd < LAST:
        y, (p, v) = orbit(jd), earth(jd)
        row = [*y, *(y[:3] - p), *(y[3:] - v)]
        numbers = (f"{x:.8f}" if k % 6 < 3 else f"{x:.10f}" for k, x in enumerate(row))
        print(f"{jd:.1f},{','.join(numbers)}")
        # denser where the Earth is near
        apart = min(abs(jd - at) for at, _ in passes)
        jd += 2.0 if apart < 12 else 4.0 if apart < 32 else 10.0 if apart < 80 else 20.0


if __name__ == "__main__":
    sys.exit(main())
