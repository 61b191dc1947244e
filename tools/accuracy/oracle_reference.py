#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the state that tests/unit/oracle/free_body.cpp holds in digits: Euler's equations and the
quaternion kinematics by mpmath's Taylor integrator, 45 digits, about half a minute."""

from mpmath import mp, mpf, odefun, sqrt

mp.dps = 45

MOMENTS = [mpf("2.5"), mpf(1), mpf(2)]
MOMENTUM = [mpf("0.75"), mpf("0.5"), mpf("0.3125")]
QUATERNION = [mpf("0.5"), mpf("0.5"), mpf("-0.125"), mpf("0.75")]
TIME = mpf("12.5")


def derivative(_t, y):
    w, x, z, v = y[:4]
    g1, g2, g3 = y[4:]
    o1, o2, o3 = g1 / MOMENTS[0], g2 / MOMENTS[1], g3 / MOMENTS[2]
    return [
        (-x * o1 - z * o2 - v * o3) / 2,
        (w * o1 + z * o3 - v * o2) / 2,
        (w * o2 + v * o1 - x * o3) / 2,
        (w * o3 + x * o2 - z * o1) / 2,
        g2 * o3 - g3 * o2,
        g3 * o1 - g1 * o3,
        g1 * o2 - g2 * o1,
    ]


def main():
    length = sqrt(sum(c * c for c in QUATERNION))
    start = [c / length for c in QUATERNION] + MOMENTUM
    for value in odefun(derivative, 0, start)(TIME):
        print(mp.nstr(value, 32))


if __name__ == "__main__":
    main()
