# SPDX-License-Identifier: MIT
"""A third body beside heyoka: sunlight on three plates, which a planet eclipses once an orbit.

The body spins about the normal of its orbit (e = 0.05), the Sun stands 30 degrees above the orbit,
and no plate turns edge-on. The shadow is a cone: light, penumbra and umbra have equations of their
own for heyoka, an integrator each. When one follows the other is known from the orbits alone: it is
found ahead, outside the times, and heyoka is told. polhode finds it in the run.
"""

import itertools

import equations
import numpy as np
from equations import cross, dot

ECCENTRICITY, RATES = 0.05, (0.6, 0.5, 12.5)
PRESSURE, RADIUS = 0.01, 0.7
SUN_RADIUS, SUN_FAR, SUN_RATE = 10.0, 200.0, 5e-5
SUN_GM = SUN_RATE ** 2 * SUN_FAR ** 3
TILT, NODE, ARGUMENT = np.pi / 6, 1.5 * np.pi, 0.5 * np.pi
# Around axis 3, each leaning outwards by 20 degrees: azimuth, area, mirrored and scattered parts.
PLATES = ((0.3, 0.9, 0.3, 0.2), (2.2, 0.6, 0.1, 0.5), (4.5, 0.7, 0.6, 0.1))
LEAN = np.radians(20.0)
# The light of a penumbra is singular at its edges, where a Taylor series does not reach; so much of
# its length is left to the light or dark beside it, by which ends move by 1e-14 rad.
MARGIN = 1e-6


def rows():
    """Of a Surface: centre, normal, area, mirrored, scattered, and three that light ignores."""
    found = []
    for azimuth, area, mirrored, scattered in PLATES:
        out = np.sin(LEAN) * np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        centre = [*(out[:2] + 0.1), 0.4]
        found.append([*centre, *(out + [0.0, 0.0, np.cos(LEAN)]), area, mirrored, scattered, 0.0,
                      1.0, 1.0])
    return found


def terms(ph, orbit):
    sun = ph.KeplerOrbit(ph.KeplerElements(SUN_GM, SUN_FAR, 0.0, TILT, NODE, ARGUMENT))
    return [ph.GravityGradient(orbit, 1.0), ph.SolarPressure(
        ph.Surface(rows()), orbit, PRESSURE, SUN_FAR, sun=sun, shadow="cone",
        shadow_radius=RADIUS, sun_radius=SUN_RADIUS)]


def sun_at(angle, cos, sin, number):
    """Its place at an angle from the pericentre."""
    tilt, node, argument = number(TILT), number(NODE), number(ARGUMENT)
    x, y = (number(SUN_FAR) * f(argument + angle) for f in (cos, sin))
    z, y = np.sin(tilt) * y, np.cos(tilt) * y
    return np.cos(node) * x - np.sin(node) * y, np.sin(node) * x + np.cos(node) * y, z


def discs(to_sun, place, functions, number):
    """The angular radii of Sun and planet, and the angle between their centres."""
    asin, atan2, sqrt = functions
    far, away = sqrt(dot(to_sun, to_sun)), sqrt(dot(place, place))
    s = [c / far for c in to_sun]
    to_planet = [-c for c in place]
    across = cross(s, to_planet)
    return (asin(number(SUN_RADIUS) / far), asin(number(RADIUS) / away),
            atan2(sqrt(dot(across, across)), dot(s, to_planet)))


def sunlight(light):
    """Of "all", "part" or "none" of the Sun: what orbits.py takes for the torque of a case."""
    def of_number(number):
        def torque(heyoka, q, x, y):
            if light == "none":
                return [number(0)] * 3
            to_sun = sun_at(number(SUN_RATE) * heyoka.time, heyoka.cos, heyoka.sin, number)
            place = (x, y, 0.0 * x)
            to_sun = [a - b for a, b in zip(to_sun, place, strict=True)]
            r2 = dot(to_sun, to_sun)
            strength = number(PRESSURE) * number(SUN_FAR) ** 2 / r2
            if light == "part":
                strength = strength * uncovered(heyoka, *discs(
                    to_sun, place, (heyoka.asin, heyoka.atan2, heyoka.sqrt), number), number)
            e = equations.body_axes(q, [c * r2 ** number(-0.5) for c in to_sun])
            return [strength * c for c in on_plates(e, number)]
        return torque
    return of_number


def on_plates(e, number):
    """Torque at a pressure of one: centre x force of each (Wertz 1978, section 17.2)."""
    whole = [0.0 * e[0]] * 3
    for row in rows():
        centre, n, (area, mirrored, scattered) = (
            [number(float(c)) for c in part] for part in (row[:3], row[3:6], row[6:9]))
        lit = dot(n, e)
        push = number(2) * (mirrored * lit + scattered / number(3))
        force = [-area * lit * ((number(1) - mirrored) * a + push * b)
                 for a, b in zip(e, n, strict=True)]
        whole = [a + b for a, b in zip(whole, cross(centre, force), strict=True)]
    return whole


def uncovered(heyoka, a, b, c, number):
    """The part of a disc of radius a that one of radius b leaves (Montenbruck & Gill 2000)."""
    x = (c * c + (a - b) * (a + b)) / (2.0 * c)
    y = heyoka.sqrt((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c)) / (2.0 * c)
    covered = a * a * heyoka.atan2(y, x) + b * b * heyoka.atan2(y, c - x) - c * y
    return number(1) - covered / (number(np.longdouble("3.14159265358979323846")) * a * a)


def edges(stop):
    """The times of every border, in 80 bits, and the light up to each; then `stop`."""
    wide = np.longdouble
    e = wide(ECCENTRICITY)

    def borders(t):
        E = t + e * np.sin(t)
        for _ in range(8):
            E = E - (E - e * np.sin(E) - t) / (1 - e * np.cos(E))
        place = (np.cos(E) - e, np.sqrt((1 - e) * (1 + e)) * np.sin(E), 0 * E)
        sun = sun_at(wide(SUN_RATE) * t, np.cos, np.sin, wide)
        a, b, c = discs([s - p for s, p in zip(sun, place, strict=True)], place,
                        (np.arcsin, np.arctan2, np.sqrt), wide)
        return c - (a + b), c - (b - a)

    grid = np.arange(wide(0), wide(stop), wide(0.02))
    found = []
    for k, values in enumerate(borders(grid)):
        places = np.nonzero(values[1:] * values[:-1] < 0)[0]
        low, high, rising = grid[places], grid[places + 1], values[places] < 0
        for _ in range(70):
            middle = (low + high) / 2
            before = (borders(middle)[k] < 0) == rising
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        # Outer: into the penumbra or out of it; inner: into the dark or out of it.
        ahead = ("part", "all") if k == 0 else ("none", "part")
        found += [(t, ahead[0] if up else ahead[1]) for t, up in zip(low, rising, strict=True)]
    found.sort()
    assert all(now != then for (_, now), (_, then) in itertools.pairwise(found))
    return [*found, (wide(stop), "all")]


def with_margins(found):
    """The same with penumbras a little shorter."""
    times = [t for t, _ in found]
    widths = [times[k] - times[k - 1] if light == "part" else 0
              for k, (_, light) in enumerate(found)]
    moved = []
    for k, (t, light) in enumerate(found):
        after = widths[k + 1] if k + 1 < len(found) else 0
        moved.append((t + MARGIN * (after - widths[k]), light))
    return moved
