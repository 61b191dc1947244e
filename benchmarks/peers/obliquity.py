# SPDX-License-Identifier: MIT
"""Goal G11: the obliquity of an Earth-like planet over 100 Myr, its orbit a series of three terms.

Peers get the same equation, ds/dt = (alpha(e) (s.n)) s x n with e and n from the same
quasi-periodic series, and integrate it as their users would. snvec is not in the registries.
"""

import numpy as np
from timing import Contender, interleaved

ARCSEC = np.pi / 180 / 3600
SPAN = 1e5  # kyr
MYR = SPAN / 1e3
BODIES, LANES = 256, 8
STAR, SATELLITES = 17370.0 * ARCSEC, 37500.0 * ARCSEC
POLE = (0.0, np.sin(0.4), np.cos(0.4))
# Rates (rad/kyr), amplitudes, phases of e exp(i varpi) and sin(i/2) exp(i node): Laskar 1988.
ELLIPSE = np.array([(4248.976 * ARCSEC, 0.0189701, 0.5343), (7455.487 * ARCSEC, 0.0163190, 3.4874),
                    (17922.491 * ARCSEC, 0.0129891, 2.6529)])
PLANE = np.array([(0.0, 0.0137722, 1.8777), (-18850.133 * ARCSEC, 0.0079888, 4.2802),
                  (-5604.358 * ARCSEC, 0.0051545, 0.2983)])


def rates(cos, sin, t, s):
    """ds/dt, in the terms of whoever brings cos and sin."""
    k, h = (sum(float(a) * f(float(n) * t + float(p)) for n, a, p in ELLIPSE) for f in (cos, sin))
    q, p = (sum(float(a) * f(float(n) * t + float(b)) for n, a, b in PLANE) for f in (cos, sin))
    c = (1.0 - q * q - p * p) ** 0.5
    x, y, z = 2.0 * p * c, -2.0 * q * c, 1.0 - 2.0 * (q * q + p * p)
    turn = (STAR * (1.0 - k * k - h * h) ** -1.5 + SATELLITES) * (s[0] * x + s[1] * y + s[2] * z)
    return [turn * (s[1] * z - s[2] * y), turn * (s[2] * x - s[0] * z),
            turn * (s[0] * y - s[1] * x)]


def polhode_contenders():
    import polhode as ph
    series = ph.secular.ElementSeries(ELLIPSE, PLANE)
    speeds = ph.secular.PrecessionRates(STAR, SATELLITES)

    def run(method):
        def once():
            return MYR, np.array(
                ph.secular.spin_history(series, speeds, POLE, [SPAN], method).s[-1]
            )
        return once

    def together(step):
        star = STAR * (1.0 + 1e-4 * np.arange(BODIES))
        rates = np.column_stack([star, np.full(BODIES, SATELLITES), np.zeros((BODIES, 2))])

        def once():
            found = ph.secular.spin_histories(
                series, rates, POLE, [SPAN], ph.Splitting(step, "order8")
            )
            return BODIES * MYR, np.array(found.s[0, -1])
        return once
    many = [Contender(f"polhode spin_histories of {BODIES}, order8", f"{step:g}", together(step))
            for step in (7.0, 5.0)]
    return many + [Contender(f"polhode {name}", setting, run(m)) for name, setting, m in (
        ("Splitting order8", "7", ph.Splitting(7.0, "order8")),
        ("Splitting order8", "5", ph.Splitting(5.0, "order8")),
        ("Splitting order8", "2", ph.Splitting(2.0, "order8")),
        ("Adaptive", "1e-12", ph.Adaptive(1e-12)),
        ("Collocation", "default", ph.Collocation()))]


def heyoka_contenders(heyoka):
    s = heyoka.make_vars("x", "y", "z")
    equations = list(zip(s, rates(heyoka.cos, heyoka.sin, heyoka.time, s), strict=True))

    def run(tolerance):
        taylor = heyoka.taylor_adaptive(equations, list(POLE), tol=tolerance)

        def once():
            taylor.time = 0.0
            taylor.state[:] = POLE
            taylor.propagate_until(SPAN)
            return MYR, taylor.state.copy()
        return once

    def batch(tolerance):
        lanes = np.repeat(np.array(POLE)[:, None], LANES, axis=1)
        taylor = heyoka.taylor_adaptive_batch(equations, lanes.copy(), tol=tolerance)

        def once():
            taylor.set_time(np.zeros(LANES))
            taylor.state[:] = lanes
            taylor.propagate_until(np.full(LANES, SPAN))
            return LANES * MYR, taylor.state[:, 0].copy()
        return once
    return [Contender(who, f"{t:g}", make(t)) for t in (1e-9, 1e-12, 2.2e-16)
            for who, make in (("heyoka", run), (f"heyoka, batch of {LANES}", batch))]


def exact(heyoka):
    """The last axis, in 80 bits."""
    wide = np.longdouble
    s = heyoka.make_vars("x", "y", "z")
    taylor = heyoka.taylor_adaptive(
        list(zip(s, rates(heyoka.cos, heyoka.sin, heyoka.time, s), strict=True)),
        [wide(x) for x in POLE], tol=wide(1e-18), fp_type=wide)
    taylor.propagate_until(wide(SPAN))
    return taylor.state.copy()


def scipy_contender():
    import math

    from scipy.integrate import solve_ivp

    def once():
        end = solve_ivp(lambda t, s: rates(math.cos, math.sin, t, s), (0.0, SPAN), POLE, "DOP853",
                        rtol=1e-10, atol=1e-10)
        return MYR, end.y[:, -1]
    return Contender("SciPy DOP853", "1e-10", once, once=True)


def measured(options, missing):
    try:
        import heyoka
    except ImportError:
        missing("heyoka (and with it G11)")
        return []
    contenders = polhode_contenders() + heyoka_contenders(heyoka)
    try:
        if not options.quick:
            contenders.append(scipy_contender())
    except ImportError:
        missing("SciPy")
    last = exact(heyoka)
    return [{"who": t.who, "setting": t.setting, "seconds": t.median, "repetitions": t.seconds,
             "error": float(np.linalg.norm(np.asarray(t.ends[0], dtype=np.longdouble) - last))}
            for t in interleaved(contenders, options.repetitions)]
