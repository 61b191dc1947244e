#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes examples/migrating-exoplanet.csv: the circular orbit of a planet whose neighbour migrates.

    tools/orbits/migrating.py > examples/migrating-exoplanet.csv

The node goes back, by 8 milliradians a year at first. It slows down to an eighth of that within
250,000 years, as the neighbour moves away; then the inclination is damped from 10 degrees to 0.005
within 150,000 years. Both go exponentially. Needs nothing but Python."""

import math

SLOWS, DAMPED = 250e3, 150e3  # years
RATE, SLOWER = 8e-3, 8.0  # rad/yr, and by what factor it falls
INCLINATION, FACTOR = 10.0, 2000.0  # degrees
STEP = 2 * math.pi / 10  # of the node between two rows


def node(t):
    """The closed form of the integral of the rate from 0 to t."""
    if t < 0:
        return -RATE * t
    if t > SLOWS:
        return node(SLOWS) - RATE / SLOWER * (t - SLOWS)
    decay = math.log(SLOWER) / SLOWS
    return RATE / decay * math.expm1(-decay * t)


def inclination(t):
    part = min(max((t - SLOWS) / DAMPED, 0.0), 1.0)
    return INCLINATION / FACTOR**part


def rate(t):
    return RATE / SLOWER ** min(max(t / SLOWS, 0.0), 1.0)


def main():
    print("# t, e, i, Omega, omega: years and degrees (tools/orbits/migrating.py)")
    t = -3000.0
    while t < SLOWS + DAMPED + 203000:
        print(f"{t:.2f},0,{inclination(t):.5f},{math.degrees(node(t)) % 360:.4f},0")
        t = round(t + STEP / rate(t), 2)


if __name__ == "__main__":
    main()
