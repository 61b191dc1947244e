#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Elliptic functions in mpmath, at any precision: the oracle of tools/accuracy/elliptic.py. Run as a
program it writes the values that tests/unit/elliptic/typed_values.hpp holds, by direct quadrature
of the definitions.

Every argument is taken exactly as the double given. Of m and m1 the smaller one counts."""

import sys

from mpmath import (acos, agm, asin, atan2, cos, elliprc, elliprd, elliprf, exp,
                    fabs, floor, inf, isnan, log, log10, mp, mpf, nan, nint, pi, quad, sin, sqrt)


def digits_for(*numbers):
    """Digits that 1 - x and x - y need when the numbers are as small as these."""
    least = min([fabs(mpf(x)) for x in numbers if x] + [mpf(1)])
    most = max([fabs(mpf(x)) for x in numbers] + [mpf(1)])
    return 50 + int(-2 * log10(least)) + int(2 * log10(most))


def pair(m, m1):
    m, m1 = mpf(m), mpf(m1)
    return (1 - m1, m1) if fabs(m1) < fabs(m) and fabs(m1) < 1 else (m, 1 - m)


def rf(x, y, z):
    return elliprf(mpf(x), mpf(y), mpf(z))


def rc(x, y):
    return elliprc(mpf(x), mpf(y)).real


def rd(x, y, z):
    return elliprd(mpf(x), mpf(y), mpf(z))


def rj(x, y, z, p):
    """By Carlson's duplication; principal value by [DLMF 19.20.14], whose terms cancel."""
    x, y, z, p = mpf(x), mpf(y), mpf(z), mpf(p)
    if p < 0:
        x, y, z = sorted((x, y, z))
        q, p = -p, y + (z - y) * (y - x) / (y - p)
        last = 3 * sqrt(x * y * z / (x * z + p * q)) * elliprc(x * z + p * q, p * q).real
        return ((p - y) * rj(x, y, z, p) - 3 * elliprf(x, y, z) + last) / (y + q)
    a0 = a = (x + y + z + 2 * p) / 5
    delta = (p - x) * (p - y) * (p - z)
    spread = max(fabs(a - v) for v in (x, y, z, p)) * mpf(10) ** (mpf(mp.dps) / 6)
    total, power = mpf(0), mpf(1)
    x0, y0, z0 = x, y, z
    while spread * power > fabs(a):
        sx, sy, sz, sp = sqrt(x), sqrt(y), sqrt(z), sqrt(p)
        low = sx * sy + sx * sz + sy * sz
        d = (sp + sx) * (sp + sy) * (sp + sz)
        e = power ** 3 * delta / d ** 2
        total += power / d * elliprc(mpf(1), 1 + e).real
        x, y, z, p, a = ((v + low) / 4 for v in (x, y, z, p, a))
        power /= 4
    dx, dy, dz = ((a0 - v) * power / a for v in (x0, y0, z0))
    dp = -(dx + dy + dz) / 2
    e2 = dx * dy + dx * dz + dy * dz - 3 * dp ** 2
    e3 = dx * dy * dz + 2 * e2 * dp + 4 * dp ** 3
    e4 = (2 * dx * dy * dz + e2 * dp + 3 * dp ** 3) * dp
    e5 = dx * dy * dz * dp ** 2
    series = (1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 ** 2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52
              + 3 * e5 / 26)
    return power * series / a ** mpf("1.5") + 6 * total


def cel(kc, p, a, b):
    kc, p, a, b = mpf(kc), mpf(p), mpf(a), mpf(b)
    return a * elliprf(0, kc ** 2, 1) + (b - p * a) / 3 * rj(0, kc ** 2, 1, p)


def complete(kind, m, m1, n=None):
    m, m1 = pair(m, m1)
    if m1 < 0:
        return nan
    if m1 == 0:
        return mpf(1) if kind in "eb" else inf
    if kind in "kf":
        return elliprf(0, m1, 1)
    if kind == "d":
        return elliprd(0, m1, 1) / 3
    if kind == "b":
        return elliprf(0, m1, 1) - elliprd(0, m1, 1) / 3
    if kind == "e":
        return elliprf(0, m1, 1) - m * elliprd(0, m1, 1) / 3
    n = mpf(n)
    return elliprf(0, m1, 1) + n / 3 * rj(0, m1, 1, 1 - n)


def incomplete(kind, phi, m, m1, n=None):
    """F, E, D, B, Pi of any angle; principal values behind poles."""
    phi = mpf(phi)
    m, m1 = pair(m, m1)
    turns = nint(phi / pi)
    s, c = sin(phi - turns * pi), cos(phi - turns * pi)
    d2 = 1 - m * s * s
    if d2 < 0 or (m > 1 and turns):
        return nan
    if kind == "pi":
        n = mpf(n)
        value = s * elliprf(c * c, d2, 1) + n / 3 * s ** 3 * rj(c * c, d2, 1, 1 - n * s * s)
    else:
        f, d = s * elliprf(c * c, d2, 1), s ** 3 * elliprd(c * c, d2, 1) / 3
        value = {"f": f, "d": d, "b": f - d, "e": f - m * d}[kind]
    return value + (2 * turns * complete(kind, m, m1, n) if turns else 0)


def amplitude(u, m, m1):
    """By the descending Landen (AGM) sequence of phases [DLMF 22.20(ii)]; 22.17 for m > 1."""
    u = mpf(u)
    m, m1 = pair(m, m1)
    if m1 < 0:
        k = sqrt(m)
        return asin(sin(amplitude(k * u, 1 / m, -m1 / m)) / k)
    if m1 == 0:
        return 2 * atan2(exp(u), 1) - pi / 2
    a, b, steps = mpf(1), sqrt(m1), []
    while fabs(a - b) > a * mpf(10) ** (-mp.dps):
        a, b, c = (a + b) / 2, sqrt(a * b), (a - b) / 2
        steps.append(c / a)
    phi = 2 ** len(steps) * a * u
    for ratio in reversed(steps):
        phi = (phi + asin(ratio * sin(phi))) / 2
    return phi


def jacobi(name, u, m, m1):
    m, m1 = pair(m, m1)
    phi = amplitude(u, m, m1)
    if name == "am":
        return phi
    if m1 < 0 and name == "cn":
        k = sqrt(m)
        return jacobi("dn", k * mpf(u), 1 / m, -m1 / m)
    if m1 < 0 and name == "dn":
        k = sqrt(m)
        return cos(amplitude(k * mpf(u), 1 / m, -m1 / m))
    return {"sn": sin(phi), "cn": cos(phi), "dn": sqrt(1 - m * sin(phi) ** 2)}[name]


def zeta(phi, m, m1):
    """By the definition."""
    m, m1 = pair(m, m1)
    if m1 == 0:
        return sin(phi) if cos(phi) > 0 else -sin(phi)
    phi = mpf(phi)
    phi -= nint(phi / pi) * pi
    e, k = complete("e", m, m1), complete("k", m, m1)
    return incomplete("e", phi, m, m1) - e / k * incomplete("f", phi, m, m1)


def heuman(psi, m, m1):
    """By the definition."""
    m, m1 = pair(m, m1)
    e, k = complete("e", m, m1), complete("k", m, m1)
    f = incomplete("f", psi, m1, m)
    return 2 / pi * (e * f + k * (incomplete("e", psi, m1, m) - f))


def nome(m, m1):
    m, m1 = pair(m, m1)
    if m < 0:
        return -nome(-m / m1, 1 / m1)
    if m == 0 or m1 == 0:
        return mpf(1 if m1 == 0 else 0)
    return exp(-pi * agm(1, sqrt(m1)) / agm(1, sqrt(m)))
