#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the elliptic functions over the whole range of double and writes
docs/accuracy/elliptic.md.

Random arguments, stratified by their exponents, against mpmath at as many digits as they need
(tools/reference/elliptic.py). Minutes on one core."""

import argparse
import math
import pathlib
import random
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/reference"))

from mpmath import fabs, inf, isnan, mp, mpf  # noqa: E402

import elliptic as oracle  # noqa: E402

PAGE = ROOT / "docs/accuracy/elliptic.md"
EPS = 2.0 ** -52
LEAST, MOST = 2.0 ** -1022, 1.7976931348623157e308


def power(draw, low, high):
    return draw.uniform(1.0, 10.0) * 10.0 ** draw.uniform(low, high - 1)


def plain(draw):
    m = draw.uniform(0.001, 0.999)
    return m, 1.0 - m


def edges(draw):
    """m or m1 down to the smallest double."""
    small = max(power(draw, -323.3, -1), 5e-324)
    return (small, 1.0 - small) if draw.random() < 0.4 else (1.0 - small, small)


def negative(draw):
    m = -power(draw, -12, 12)
    return m, 1.0 - m


def beyond(draw):
    m = 1.0 + power(draw, -12, 8)
    return m, 1.0 - m


def angle(draw):
    kind = draw.randrange(4)
    if kind == 0:
        return draw.uniform(-1.57, 1.57)
    if kind == 1:
        return draw.choice((-1, 1)) * max(power(draw, -300, -1), 5e-324)
    if kind == 2:
        return draw.choice((-1, 1)) * (math.pi / 2 - power(draw, -15, -1))
    return draw.uniform(-1e6, 1e6)


def under(draw, m):
    """An angle with |sin| < 1/k."""
    top = math.asin(1.0 / math.sqrt(m))
    return draw.choice((-1, 1)) * top * (1.0 - power(draw, -8, 0))


def carlson(count, low, high):
    return lambda draw: [power(draw, low, high) for _ in range(count)]


def principal(count):
    def rows(draw):
        return [power(draw, -100, 100) for _ in range(count - 1)] + [-power(draw, -100, 100)]
    return rows


def with_angle(modulus, phi=angle):
    return lambda draw: [phi(draw), *modulus(draw)]


def with_n(modulus, characteristic, phi=angle):
    return lambda draw: [phi(draw), characteristic(draw), *modulus(draw)]


def with_bound(draw):
    m, m1 = beyond(draw)
    return [under(draw, m), m, m1]


def with_bound_n(draw):
    phi, m, m1 = with_bound(draw)
    return [phi, draw.choice((-1.0, 1.0)) * power(draw, -3, 3), m, m1]


def u(draw):
    return draw.uniform(-10.0, 10.0)


def below_one(draw):
    return draw.choice((draw.uniform(-3, 0.99), 1 - power(draw, -15, -1), -power(draw, -300, 300)))


def above_one(draw):
    return draw.choice((draw.uniform(1.01, 9.0), 1 + power(draw, -12, -1), power(draw, 1, 12)))


def for_cel(draw):
    return [power(draw, -160, 100), power(draw, -300, 300),
            power(draw, -100, 100), power(draw, -100, 100)]


# What is measured: heading -> (function, its oracle, strata: name -> rows).
MODULI = {"m in [0, 1]": plain, "m or m1 to 5e-324": edges, "m < 0": negative}
CASES = {
    "carlson_rf": ("rf", oracle.rf, {"1e-30 .. 1e30": carlson(3, -30, 30),
                                     "1e-307 .. 1e308": carlson(3, -307, 308)}),
    "carlson_rc": ("rc", oracle.rc, {"1e-30 .. 1e30": carlson(2, -30, 30),
                                     "1e-307 .. 1e308": carlson(2, -307, 308),
                                     "y < 0": principal(2)}),
    "carlson_rd": ("rd", oracle.rd, {"1e-30 .. 1e30": carlson(3, -30, 30),
                                     "1e-307 .. 1e308": carlson(3, -307, 308)}),
    "carlson_rj": ("rj", oracle.rj, {"1e-30 .. 1e30": carlson(4, -30, 30),
                                     "1e-307 .. 1e308": carlson(4, -307, 308),
                                     "p < 0": principal(4)}),
    "agm": ("agm", lambda a, b: oracle.agm(mpf(a), mpf(b)),
            {"1e-307 .. 1e308": carlson(2, -307, 308)}),
    "cel": ("cel", oracle.cel, {"kc to 1e-160, p to 1e+-300": for_cel}),
    **{f"complete_{k}": (k, lambda m, m1, k=k: oracle.complete(k, m, m1),
                         {s: (lambda d, f=f: [*f(d)]) for s, f in MODULI.items()})
       for k in "kebd"},
    "complete_pi": ("pi", lambda n, m, m1: oracle.complete("pi", m, m1, n), {
        "n < 1": lambda d: [below_one(d), *edges(d)],
        "n > 1": lambda d: [above_one(d), *edges(d)],
        "m < 0": lambda d: [d.choice((below_one, above_one))(d), *negative(d)]}),
    "nome": ("nome", oracle.nome, {s: (lambda d, f=f: [*f(d)]) for s, f in MODULI.items()}),
    "heuman_lambda0": ("heuman", oracle.heuman, {
        "m in [0, 1]": with_angle(plain), "m or m1 to 5e-324": with_angle(edges)}),
    "jacobi_zeta": ("zeta", oracle.zeta, {s: with_angle(f) for s, f in MODULI.items()}),
    **{f"legendre_{k}": ("l" + k, lambda phi, m, m1, k=k: oracle.incomplete(k, phi, m, m1),
                         {**{s: with_angle(f) for s, f in MODULI.items()}, "m > 1": with_bound})
       for k in "fedb"},
    "legendre_pi": ("lpi", lambda phi, n, m, m1: oracle.incomplete("pi", phi, m, m1, n), {
        "n < 1": with_n(plain, below_one), "n < 1, m or m1 to 5e-324": with_n(edges, below_one),
        "n > 1": with_n(plain, above_one),
        "m < 0": with_n(negative, lambda d: d.choice((below_one, above_one))(d)),
        "m > 1": with_bound_n}),
    **{f"jacobi: {k}": (k, lambda x, m, m1, k=k: oracle.jacobi(k, x, m, m1),
                        {**{s: with_angle(f, u) for s, f in MODULI.items()},
                         "m > 1": with_angle(lambda d: (lambda m: (m, 1 - m))(
                             1 + power(d, -12, 3)), u)})
       for k in ("sn", "cn", "dn", "am")},
}


def slopes(name, row, value):
    """What one rounding of u does to a Jacobi function, over its size."""
    x, m, m1 = row
    sn, cn, dn = (oracle.jacobi(k, x, m, m1) for k in ("sn", "cn", "dn"))
    slope = {"sn": cn * dn, "cn": sn * dn, "dn": m * sn * cn, "am": dn}[name]
    # and of k u, from which m > 1 and m < 0 start
    return fabs(value) + fabs(x * slope)


def error(name, row, got, exact):
    """In units of 2^-52: relative; None for what a double cannot hold."""
    if isnan(exact):
        return 0.0 if math.isnan(got) else None
    if exact in (inf, -inf) or fabs(exact) > MOST:
        return 0.0 if got == math.copysign(math.inf, exact) else None
    if math.isnan(got) or math.isinf(got):
        return None
    size = max(fabs(exact), mpf(LEAST))
    if name in ("sn", "cn", "dn", "am"):
        size = max(slopes(name, row, exact), mpf(LEAST))
    return float(fabs(mpf(got) - exact) / size / EPS)


def needed_digits(name, row):
    """What the cancellations of the textbook formulas cost, and 1 - m."""
    def reach(x):
        return int(abs(math.log10(abs(x)))) if x else 0
    if name in ("rf", "rc", "rd", "rj", "agm"):
        return 60 if row[-1] > 0 else 120
    if name == "cel":
        return 80 + reach(row[1])
    if name in ("sn", "cn", "dn", "am"):
        return 80 + int(1.2 * max(reach(row[1]), reach(row[2])))
    if name in ("pi", "lpi"):
        return 120 + reach(row[-3]) + max(reach(row[-2]), reach(row[-1]))
    if name in ("zeta", "heuman"):
        return 120 + 2 * max(reach(row[1]), reach(row[2]))
    return 120


def measured(name, function, rows_of, count, seed, evaluate):
    draw = random.Random(f"{seed} {name}")
    rows = [rows_of(draw) for _ in range(count)]
    errors, failed, worst = [], 0, None
    for row, got in zip(rows, evaluate(name, rows)):
        mp.dps = needed_digits(name, row)
        found = error(name, row, got, function(*row))
        if found is None:
            failed += 1
            worst = (math.inf, row, got)
            continue
        errors.append(found)
        if worst is None or found > worst[0]:
            worst = (found, row, got)
    return {"count": count, "failed": failed, "errors": errors, "worst": worst}


def by_library(name, rows):
    import numpy as np
    from polhode import elliptic as e
    a = np.array(rows, dtype=float).T
    if name in ("rf", "rc", "rd", "rj"):
        return getattr(e, "carlson_" + name)(*a)
    if name in ("agm", "cel", "nome"):
        return getattr(e, name)(*a[:-1], m1=a[-1]) if name == "nome" else getattr(e, name)(*a)
    if name in ("sn", "cn", "dn"):
        return getattr(e.jacobi(*a[:-1], m1=a[-1]), name)
    full = {"k": "complete_k", "e": "complete_e", "b": "complete_b", "d": "complete_d",
            "pi": "complete_pi", "heuman": "heuman_lambda0", "zeta": "jacobi_zeta",
            "am": "amplitude", "lf": "legendre_f", "le": "legendre_e", "ld": "legendre_d",
            "lb": "legendre_b", "lpi": "legendre_pi"}[name]
    return getattr(e, full)(*a[:-1], m1=a[-1])


HEAD = """\
# Accuracy of elliptic functions

This page is written by `tools/accuracy/elliptic.py`. Random arguments whose exponents run over the
whole range of double (seed {seed}, {count} cases a row) are compared with mpmath at 50 digits and
as many more as the arguments need (`tools/reference/elliptic.py`): Carlson's integrals by
duplication, Legendre's through them by the textbook formulas with their cancellations, Jacobi's
functions by the sequence of phases of the arithmetic-geometric mean, Heuman's and Jacobi's zeta
function by their definitions. Every argument is taken exactly as the double given; of m and m1 the
smaller one counts.

Errors are relative, in units of 2^-52 = 2.2e-16 (of subnormal results: of 2^-1022). Those of
`jacobi` are over what one rounding of u does, |f| + |u f'(u)|. **Failed** counts NaN, and 0 or
infinity where a double has room for the value.

Angles: a quarter each in +-1.57, from 5e-324 on, next to pi/2, and up to 1e6 rad.

| function | arguments | cases | failed | median | worst |
|---|---|---|---|---|---|
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=120)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--show", action="store_true", help="print the worst; write nothing")
    options = parser.parse_args()
    lines = []
    for title, (name, function, strata) in CASES.items():
        if options.only and options.only not in (title, name):
            continue
        for stratum, rows_of in strata.items():
            r = measured(name, function, rows_of, options.count, options.seed, EVALUATE)
            median = statistics.median(r["errors"]) if r["errors"] else math.nan
            top = max(r["errors"], default=math.nan)
            lines.append(f"| `{title}` | {stratum} | {r['count']} | {r['failed']} | {median:.2f} "
                         f"| {top:.2f} |")
            if options.show:
                print(lines[-1], r["worst"] if r["failed"] or top > 4 else "", flush=True)
    if not options.show:
        PAGE.write_text(HEAD.format(seed=options.seed, count=options.count)
                        + "\n".join(lines) + "\n")
    return 0


EVALUATE = by_library

if __name__ == "__main__":
    sys.exit(main())
