#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Elliptic functions in mpmath, at any precision: the oracle of tools/accuracy/elliptic.py.

Run as a program it writes tests/unit/elliptic/typed_values.hpp, by quadrature of the definitions.
Every argument is taken exactly as the double given. Of m and m1 the smaller one counts."""

import pathlib
import sys

from mpmath import (
    agm,
    asin,
    atan2,
    cos,
    ellipfun,
    elliprc,
    elliprd,
    elliprf,
    exp,
    expm1,
    fabs,
    inf,
    log,
    log1p,
    mp,
    mpf,
    nan,
    nint,
    pi,
    qfrom,
    quad,
    sin,
    sqrt,
)


def pair(m, m1):
    m, m1 = mpf(m), mpf(m1)
    return (1 - m1, m1) if fabs(m1) < fabs(m) and fabs(m1) < 1 else (m, 1 - m)


def rf(x, y, z):
    return elliprf(mpf(x), mpf(y), mpf(z))


def rc(x, y):
    return elliprc(mpf(x), mpf(y)).real


def rd(x, y, z):
    return elliprd(mpf(x), mpf(y), mpf(z))


def rc_of_step(roots, sp):
    """RC(1, 1 + e) of one duplication, 1 + e without its cancellation at e near -1."""
    parts = [(sp - s) / (sp + s) for s in roots]
    e = parts[0] * parts[1] * parts[2]
    if e > -mpf(1) / 2:
        return elliprc(mpf(1), 1 + e).real
    w = -expm1(sum(log1p(-2 * min(s, sp) / (s + sp)) for s in roots))
    r = sqrt(-e)
    return log((1 + r) ** 2 / w) / (2 * r)


def rj(x, y, z, p):
    """By Carlson's duplication; principal value by [DLMF 19.20.14], whose terms cancel."""
    x, y, z, p = mpf(x), mpf(y), mpf(z), mpf(p)
    if p < 0:
        x, y, z = sorted((x, y, z))
        q, p = -p, y + (z - y) * (y - x) / (y - p)
        last = 3 * sqrt(x * y * z / (x * z + p * q)) * elliprc(x * z + p * q, p * q).real
        return ((p - y) * rj(x, y, z, p) - 3 * elliprf(x, y, z) + last) / (y + q)
    a0 = a = (x + y + z + 2 * p) / 5
    spread = max(fabs(a - v) for v in (x, y, z, p)) * mpf(10) ** (mpf(mp.dps) / 6)
    total, power = mpf(0), mpf(1)
    x0, y0, z0 = x, y, z
    while spread * power > fabs(a):
        sx, sy, sz, sp = sqrt(x), sqrt(y), sqrt(z), sqrt(p)
        low = sx * sy + sx * sz + sy * sz
        d = (sp + sx) * (sp + sy) * (sp + sz)
        total += power / d * rc_of_step((sx, sy, sz), sp)
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
    d2 = c * c + m1 * s * s
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
    return {"sn": sin(phi), "cn": cos(phi), "dn": sqrt(cos(phi) ** 2 + m1 * sin(phi) ** 2)}[name]


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


# --- by quadrature of the definitions, for the typed values ---


def over_half_line(f, marks, centre=1):
    """int_0^inf f(t) dt by the trapezoidal rule in ln t, which converges exponentially: also to the
    principal value when a pole at `centre` is half way between two nodes."""
    at = [log(mpf(x)) for x in marks if x]
    h = mpf(1) / 5
    first = log(mpf(centre)) + h / 2
    low = int((min(at) - 180 - first) / h)
    high = int((max(at) + 180 - first) / h)
    nodes = (exp(first + k * h) for k in range(low, high))
    return h * sum(t * f(t) for t in nodes)


def quad_rf(x, y, z):
    x, y, z = mpf(x), mpf(y), mpf(z)
    return over_half_line(lambda t: 1 / (2 * sqrt((t + x) * (t + y) * (t + z))), (x, y, z))


def quad_rj(x, y, z, p):
    x, y, z, p = mpf(x), mpf(y), mpf(z), mpf(p)

    def f(t):
        return mpf(1.5) / (sqrt((t + x) * (t + y) * (t + z)) * (t + p))
    return over_half_line(f, (x, y, z, fabs(p)), fabs(p))


def quad_rd(x, y, z):
    return quad_rj(x, y, z, z)


def integrand(kind, m, n):
    def f(x):
        s2 = sin(x) ** 2
        delta = sqrt(1 - m * s2)
        return {"f": 1 / delta, "e": delta, "d": s2 / delta, "b": (1 - s2) / delta,
                "pi": 1 / ((1 - n * s2) * delta)}[kind]
    return f


def quad_legendre(kind, phi, m, n=0):
    """Half turns and the rest; symmetric about the pole, for the principal value."""
    phi, m, n = mpf(phi), mpf(m), mpf(n)
    f = integrand(kind, m, n)
    turns = nint(phi / pi)

    def part(end):
        sign, end = (-1, -end) if end < 0 else (1, end)
        pole = asin(1 / sqrt(n)) if n > 1 else inf
        if end < pole:
            return sign * end * quad(lambda t: f(end * t), [mpf(k) / 8 for k in range(9)])
        h = min(end - pole, pole)
        near = quad(lambda t: f(pole + t) + f(pole - t),
                    [mpf(10) ** -42, *(h * k / 8 for k in range(1, 9))])
        return sign * (near + quad(f, [0, (pole - h) / 2, pole - h])
                       + quad(f, [pole + h, (pole + h + end) / 2, end]))
    whole = 2 * turns * part(pi / 2) if turns else 0
    return whole + part(phi - turns * pi)


def quad_zeta(phi, m):
    e, k = quad_legendre("e", pi / 2, m), quad_legendre("f", pi / 2, m)
    return quad_legendre("e", phi, m) - e / k * quad_legendre("f", phi, m)


LEGENDRE = [(-2.5, 0.3), (1.0e6, 0.3), (1.0e6, 0.96875), (-7.5, -5.0), (1.5, -1000.0), (0.5, 2.5),
            (1.0e-300, 0.3), (-0.25, 15.0), (30.0, 0.0)]
THIRD = [(0.3, 2.5, 0.3), (0.9, 2.5, 0.3), (1.2, 1.0625, 0.3), (-2.0, 2.5, 0.3), (-7.5, 2.5, 0.3),
         (4.0, 0.5, 0.3), (1.0, 3.0, -5.0), (1.0, -3.0, -5.0), (1.0, -300.0, -5.0),
         (2.0, 0.5, -5.0), (0.55, 4.0, 2.5), (0.5, -2.0, 2.5), (100.0, -0.5, 0.875),
         (1.55, 40.0, 0.96875)]
RF = [(5e-324, 1e300, 1.7e308), (1e-307, 2e-307, 3e-307), (1e308, 1.5e308, 1e308)]
RD = [(1e-280, 1e300, 1e-250), (1e150, 3e150, 1e-290), (0.0, 2e-200, 3e-170),
      (1e200, 1e205, 1e201)]
RJ = [(0.0, 1.76e-118, 1.83e-79, 1.18e137), (1e-100, 1e300, 2e-100, 1e-290),
      (1e200, 1e190, 1e180, 1e-100), (1e-250, 1e-260, 1e200, 1e100), (2.0, 3.0, 4.0, -0.5),
      (2.0, 3.0, 4.0, -5.0), (1e-100, 1e20, 1e100, -1e10), (0.25, 1.0, 2.0, -40.0)]
ZETA = [(1.0, 0.3), (-2.0, 0.96875), (1.0, -5.0), (1.0e6, 0.75)]
JACOBI = [(0.7, -3.0), (-0.125, -300.0), (0.7, 2.5), (0.125, 40.0), (1.5, 0.75)]
NOME = [-3.0, -1.0e6, -1.0e-8, 0.75]


def typed_rows():
    rows = []
    for at in LEGENDRE:
        rows += [("legendre_" + kind, at, quad_legendre(kind, *at)) for kind in "fedb"]
    rows += [("legendre_pi", at, quad_legendre("pi", at[0], at[2], at[1])) for at in THIRD]
    rows += [("complete_pi", at, quad_legendre("pi", pi / 2, at[1], at[0]))
             for at in ((1.5, 0.3), (3.0, -2.0), (-40.0, -2.0), (1.0625, 0.96875), (500.0, 0.5))]
    rows += [("carlson_rf", at, quad_rf(*at)) for at in RF]
    rows += [("carlson_rd", at, quad_rd(*at)) for at in RD]
    rows += [("carlson_rj", at, quad_rj(*at)) for at in RJ]
    rows += [("jacobi_zeta", at, quad_zeta(*at)) for at in ZETA]
    rows += [(name, at, ellipfun(name, mpf(at[0]), m=mpf(at[1])).real)
             for at in JACOBI for name in ("sn", "cn", "dn")]
    rows += [("nome", (m,), qfrom(m=mpf(m)).real) for m in NOME]
    return rows


TYPED = """\
// SPDX-License-Identifier: MIT
// Written by tools/reference/elliptic.py: quadrature of the definitions in mpmath. A value is the
// sum of two doubles.
#pragma once

#include <array>

namespace polhode::test {

struct TypedValue {
  const char* function;
  std::array<double, 4> at;
  double hi;
  double lo;
};

// clang-format off
inline constexpr std::array<TypedValue, COUNT> typed_values{{
ROWS
}};
// clang-format on

}  // namespace polhode::test
"""


def main():
    mp.dps = 90  # the two sides of a pole cancel
    lines = []
    for name, at, value in typed_rows():
        hi = float(value)
        lo = float(value - mpf(hi))
        four = ", ".join(repr(x) for x in (*at, 0.0, 0.0, 0.0)[:4])
        lines.append(f'    {{"{name}", {{{four}}}, {hi!r}, {lo!r}}},')
    path = pathlib.Path(__file__).resolve().parents[2] / "tests/unit/elliptic/typed_values.hpp"
    path.write_text(TYPED.replace("COUNT", str(len(lines))).replace("ROWS", "\n".join(lines)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
