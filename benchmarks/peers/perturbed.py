# SPDX-License-Identifier: MIT
"""Goals G9 and G10: W1 and variants, a body tumbling under the gravity gradient for 1000 orbits.

Every contender gets the same doubles and brings the body to the same time; the error is the angle
of its last attitude from an 80-bit Taylor integration of the same start. Time is that of the
integration alone: heyoka's compilation is measured apart.
"""

import ctypes
import dataclasses
import pathlib
import subprocess
import time

import equations
import numpy as np
from timing import Contender, interleaved

MOMENTS = (0.9, 1.0, 1.1)
RATES = (5.0, 4.0, 7.5)
ECCENTRICITY = 0.1
STOP = 6283.185307179586
LANES = 8
HERE = pathlib.Path(__file__).resolve().parent


@dataclasses.dataclass(frozen=True)
class Case:
    """One start: the rates that peers are given, and the momentum that polhode is given."""

    name: str
    rates: tuple

    @property
    def momentum(self):
        return tuple(i * w for i, w in zip(MOMENTS, self.rates, strict=True))


def cases(variants, seed):
    """W1, and variants whose rates differ from it by up to 1e-3."""
    random = np.random.default_rng(seed)
    found = [Case("W1", RATES)]
    for k in range(variants):
        change = 1.0 + 1e-3 * random.uniform(-1.0, 1.0, 3)
        rates = tuple(float(w * c) for w, c in zip(RATES, change, strict=True))
        found.append(Case(f"variant {k + 1}", rates))
    return found


class References:
    """Final attitudes in 80 bits: from the rates of the peers, and from polhode's momentum."""

    def __init__(self, heyoka):
        wide = np.longdouble
        self.taylor = heyoka.taylor_adaptive(
            equations.gravity_gradient(heyoka, MOMENTS, wide),
            equations.start(RATES, ECCENTRICITY, wide), tol=wide(1e-19), fp_type=wide)

    def _end(self, rates):
        self.taylor.time = np.longdouble(0)
        self.taylor.state[:] = equations.start(rates, ECCENTRICITY, np.longdouble)
        self.taylor.propagate_until(np.longdouble(STOP))
        return self.taylor.state[:4].copy()

    def of(self, case):
        exact = [np.longdouble(g) / np.longdouble(i)
                 for g, i in zip(case.momentum, MOMENTS, strict=True)]
        return {"peers": self._end(case.rates), "polhode": self._end(exact)}


def polhode_contenders(case, quick):
    import polhode as ph
    orbit = ph.KeplerOrbit(ph.KeplerElements(
        gm=1.0, pericentre=1.0 - ECCENTRICITY, eccentricity=ECCENTRICITY))
    system = ph.System(ph.Body(*MOMENTS), terms=[ph.GravityGradient(orbit, 1.0)])
    start = ph.RotorState([1, 0, 0, 0], case.momentum)

    def run(method):
        def once():
            end = ph.integrate(ph.Problem(system, start, 0.0, STOP, method), [STOP], dense=False)
            return 1, np.array(end.q[-1])
        return once

    def together():
        problems = [ph.Problem(system, start, 0.0, STOP, ph.Collocation())] * LANES
        return LANES, np.array(ph.integrate_many(problems, [STOP])[0].q[-1])

    methods = [("Adaptive", f"{t:g}", ph.Adaptive(t))
               for t in (1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15)]
    methods += [("Adaptive, double-double", "1e-19", ph.Adaptive(1e-19, "double_double"))]
    methods += [("VariationOfConstants", f"{t:g}", ph.VariationOfConstants(t))
                for t in (1e-9, 1e-11, 1e-13)]
    methods += [(f"Splitting {scheme}", f"{h:g}", ph.Splitting(h, scheme))
                for scheme in ("order8", "ABA864", "ABA1064") for h in (0.1, 0.05, 0.025)]
    methods += [("Collocation", f"{t:g}", ph.Collocation(t)) for t in (1e-8, 1e-10, 1e-14)]
    methods += [("Collocation", "default", ph.Collocation())]
    if quick:
        methods = methods[-1:]
    found = [Contender(f"polhode {who}", setting, run(method), once="double-double" in who)
             for who, setting, method in methods]
    return [*found, Contender(f"polhode integrate_many of {LANES}", "default", together)]


class Heyoka:
    """heyoka's integrators, compiled once for each tolerance; the last is the tightest."""

    def __init__(self, heyoka, tolerances):
        self.compilation = []
        self.scalar = {}
        self.batch = {}
        rates = equations.gravity_gradient(heyoka, MOMENTS)
        start = np.array(equations.start(RATES, ECCENTRICITY))
        lanes = np.repeat(start[:, None], LANES, axis=1)
        wide = "avx512f" in pathlib.Path("/proc/cpuinfo").read_text()
        for tolerance in tolerances:
            begin = time.process_time()
            self.scalar[tolerance] = heyoka.taylor_adaptive(rates, start.copy(), tol=tolerance)
            self.compilation.append(time.process_time() - begin)
            self.batch[tolerance] = heyoka.taylor_adaptive_batch(
                rates, lanes.copy(), tol=tolerance, force_avx512=wide)

    def contenders(self, case, quick):
        start = np.array(equations.start(case.rates, ECCENTRICITY))

        def scalar(taylor):
            def once():
                taylor.time = 0.0
                taylor.state[:] = start
                taylor.propagate_until(STOP)
                return 1, taylor.state[:4].copy()
            return once

        def batch(taylor):
            def once():
                taylor.set_time(np.zeros(LANES))
                taylor.state[:] = start[:, None]
                taylor.propagate_until(np.full(LANES, STOP))
                return LANES, taylor.state[:4, 0].copy()
            return once

        kept = list(self.scalar)[-1:] if quick else list(self.scalar)
        return [Contender(who, f"{t:g}", make(table[t])) for t in kept
                for who, make, table in (("heyoka", scalar, self.scalar),
                                         ("heyoka, batch of 8", batch, self.batch))]


class Rebound:
    """REBOUND's Gragg-Bulirsch-Stoer on ODEs, right-hand sides in C."""

    def __init__(self, rebound, folder):
        self.rebound = rebound
        library = folder / "rates.so"
        subprocess.run(["cc", "-O3", "-march=native", "-shared", "-fPIC", HERE / "rates.c", "-o",
                        library, "-lm"], check=True)
        self.rates = ctypes.CDLL(str(library)).peers_rates

    def contenders(self, case, quick):
        tolerances = (1e-14,) if quick else (1e-8, 1e-10, 1e-12, 1e-13, 1e-14)

        def run(tolerance):
            def once():
                simulation = self.rebound.Simulation()
                simulation.integrator = "bs"
                simulation.integrator.eps_rel = tolerance
                simulation.integrator.eps_abs = tolerance
                ode = simulation.create_ode(length=11, needs_nbody=False)
                ode._derivatives = ctypes.cast(self.rates, dict(ode._fields_[:5])["_derivatives"])
                for k, number in enumerate(equations.start(case.rates, ECCENTRICITY)):
                    ode.y[k] = number
                simulation.integrate(STOP)
                return 1, np.array([ode.y[k] for k in range(4)])
            return once
        return [Contender("REBOUND BS", f"{t:g}", run(t)) for t in tolerances]


def scipy_contenders(case):
    """DOP853 with the right-hand side in Python, as its users write it."""
    from scipy.integrate import solve_ivp
    A, B, C = MOMENTS

    def rates(_, s):
        q, (p, w, r), (x, y, vx, vy) = s[:4], s[4:7], s[7:]
        r2 = x * x + y * y
        pull = r2 ** -1.5
        k = 3.0 * pull / r2
        n = equations.body_axes(q, (x, y, 0.0))
        return [*equations.kinematics(q, (p, w, r), 0.5),
                (B - C) / A * (w * r - k * n[1] * n[2]), (C - A) / B * (r * p - k * n[2] * n[0]),
                (A - B) / C * (p * w - k * n[0] * n[1]), vx, vy, -pull * x, -pull * y]

    def run(tolerance):
        def once():
            end = solve_ivp(rates, (0.0, STOP), equations.start(case.rates, ECCENTRICITY),
                            "DOP853", rtol=tolerance, atol=tolerance)
            return 1, end.y[:4, -1]
        return once
    return [Contender("SciPy DOP853", f"{t:g}", run(t), once=True) for t in (1e-10,)]


def _points(found, reference):
    return [{"who": t.who, "setting": t.setting, "seconds": t.median, "repetitions": t.seconds,
             "error": equations.angle(t.ends[0], reference["polhode" if t.who.startswith("polhode")
                                                           else "peers"])}
            for t in found]


def measured(options, missing):
    """Points of W1's curves, and of the variants at the settings that err least."""
    try:
        import heyoka
    except ImportError:
        missing("heyoka (and with it the references of G9 and G10)")
        return [], {}, []
    tools = [Heyoka(heyoka, (1e-9, 1e-11, 1e-13, 1e-15, 2.2e-16))]
    try:
        import rebound
        tools.append(Rebound(rebound, options.folder))
    except (ImportError, OSError, subprocess.CalledProcessError):
        missing("REBOUND")
    try:
        import scipy  # noqa: F401
        python = not options.quick
    except ImportError:
        missing("SciPy")
        python = False

    references = References(heyoka)
    first, *variants = cases(options.variants, options.seed)

    def contenders(case, quick):
        peers = [c for tool in tools for c in tool.contenders(case, quick)]
        return polhode_contenders(case, quick) + peers

    whole = contenders(first, options.quick) + (scipy_contenders(first) if python else [])
    curve = _points(interleaved(whole, options.repetitions), references.of(first))
    # Each variant is a repetition.
    spread = [_points(interleaved(contenders(case, True), 1), references.of(case))
              for case in variants]
    return curve, {"heyoka_seconds": tools[0].compilation}, spread
