# SPDX-License-Identifier: MIT
"""Three other bodies and orbits beside heyoka, 300 orbits each, with the same equations.

degree 3: an orbit of e = 0.3, the gravity gradient and the moments of mass of degree 3.
dipole: an orbit of e = 0.05, the gravity gradient and a magnetic moment in the field of a dipole
that is tilted against the primary's axis, itself tilted against the orbit, and turns with it.
sunlight: with a cone of shadow (sunlight.py).
"""

import dataclasses
import itertools
from collections.abc import Callable

import equations
import numpy as np
import sunlight
from timing import Contender, interleaved

STOP = 1884.9555921538758
MOMENTS = (0.7, 1.0, 1.2)
RATES = (3.0, 6.0, 12.5)
# xxx xxy xxz xyy xyz xzz yyy yyz yzz zzz: a body of unit size without symmetry.
THIRD = (0.0021, -0.0013, 0.0008, 0.0017, 0.0005, -0.0011, 0.0009, 0.0014, -0.0006, 0.0019)
STRENGTH, RATE, TILT, MOMENT = (0.2, 0.0, 1.0), 3.7, 0.4, (0.03, -0.05, 0.04)


def third_degree(number):
    """-n x grad p3 / r^4 with grad p3 = (15 m n n - 3 t) / 2 but for what is along n."""
    full = np.empty((3, 3, 3), dtype=object)
    places = itertools.combinations_with_replacement(range(3), 3)
    for value, place in zip(THIRD, places, strict=True):
        for same in set(itertools.permutations(place)):
            full[same] = number(value)

    def torque(heyoka, q, x, y):
        r2 = x * x + y * y
        n = [c * r2 ** number(-0.5) for c in equations.body_axes(q, (x, y, 0.0 * x))]
        gradient = [sum(full[i, j, k] * n[j] * n[k] for j in range(3) for k in range(3))
                    * number(7.5) - number(1.5) * sum(full[i, j, j] for j in range(3))
                    for i in range(3)]
        return [-c / (r2 * r2) for c in equations.cross(n, gradient)]
    return torque


def dipole(number):
    """m x B, B = (3 (K.n) n - K) / r^3."""
    sine, cosine = np.sin(number(TILT)), np.cos(number(TILT))

    def torque(heyoka, q, x, y):
        angle = number(RATE) * heyoka.time
        east, north = heyoka.cos(angle), heyoka.sin(angle)
        k1, k3 = number(STRENGTH[0]), number(STRENGTH[2])
        # Axis 1 is `angle` from the node of the equator, which is the y axis of the orbit.
        K = (k3 * sine - k1 * cosine * north, k1 * east, k3 * cosine + k1 * sine * north)
        r2 = x * x + y * y
        along = 3.0 * (K[0] * x + K[1] * y) / r2
        shrink = r2 ** number(-1.5)
        B = ((along * x - K[0]) * shrink, (along * y - K[1]) * shrink, -K[2] * shrink)
        return equations.cross([number(m) for m in MOMENT], equations.body_axes(q, B))
    return torque


def throughout(stop):
    """One torque from the start to the end."""
    return [(np.longdouble(stop), "all")]


def in_and_out(stop):
    return sunlight.with_margins(sunlight.edges(stop))


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    eccentricity: float
    torques: dict  # by the light: of a number type, the torque beside the gravity gradient
    terms: Callable  # of polhode and an orbit
    rates: tuple = RATES
    legs: Callable = throughout  # of the stop: until when there is which light


CASES = (
    Case("e = 0.3, gravity to degree 3", 0.3, {"all": third_degree},
         lambda ph, orbit: [ph.GravityGradient(
             orbit, 1.0, third_moments=THIRD, orbit_of="attractor")]),
    Case("tilted dipole", 0.05, {"all": dipole},
         lambda ph, orbit: [ph.GravityGradient(orbit, 1.0), ph.ResidualDipole(
             MOMENT, orbit, field=ph.DipoleField(
                 STRENGTH, (float(np.sin(TILT)), 0.0, float(np.cos(TILT))), RATE))]),
    Case("sunlight with a cone of shadow", sunlight.ECCENTRICITY,
         {light: sunlight.sunlight(light) for light in ("all", "part", "none")}, sunlight.terms,
         sunlight.RATES, in_and_out),
)


def rates(heyoka, case, light, number=float):
    pairs = equations.gravity_gradient(heyoka, MOMENTS, number)
    names = [v for v, _ in pairs]
    more = case.torques[light](number)(heyoka, names[:4], names[7], names[8])
    for k, (u, moment) in enumerate(zip(more, MOMENTS, strict=True)):
        pairs[4 + k] = (names[4 + k], pairs[4 + k][1] + u / number(moment))
    return pairs


class Taylor:
    """heyoka's integrators of a case, one for each light."""

    def __init__(self, heyoka, case, tolerance, number=float, **more):
        self.case, self.number = case, number
        self.legs = [(number(t), light) for t, light in case.legs(STOP)]
        start = self.start(case.rates)
        self.of_light = {light: heyoka.taylor_adaptive(rates(heyoka, case, light, number), start,
                                                       tol=number(tolerance), **more)
                         for light in case.torques}

    def start(self, rates):
        return equations.start(rates, self.case.eccentricity, self.number)

    def end(self, start):
        """The last attitude."""
        time, state = self.number(0), start
        for stop, light in self.legs:
            taylor = self.of_light[light]
            taylor.time = time
            taylor.state[:] = state
            taylor.propagate_until(stop)
            time, state = stop, taylor.state
        return state[:4].copy()


def exact(heyoka, case):
    """Final attitudes in 80 bits, from the rates and from polhode's rounded momentum."""
    wide = np.longdouble
    taylor = Taylor(heyoka, case, 1e-19, wide, fp_type=wide)
    rounded = [wide(i * w) / wide(i) for i, w in zip(MOMENTS, case.rates, strict=True)]
    return {who: taylor.end(taylor.start(start))
            for who, start in (("peers", case.rates), ("polhode", rounded))}


def polhode_contenders(case):
    import polhode as ph
    orbit = ph.KeplerOrbit(ph.KeplerElements(
        gm=1.0, pericentre=1.0 - case.eccentricity, eccentricity=case.eccentricity))
    system = ph.System(ph.Body(*MOMENTS), terms=case.terms(ph, orbit))
    start = ph.RotorState([1, 0, 0, 0], [i * w for i, w in zip(MOMENTS, case.rates, strict=True)])

    def run(method):
        def once():
            end = ph.integrate(ph.Problem(system, start, 0.0, STOP, method), [STOP], dense=False)
            return 1, np.array(end.q[-1])
        return once
    methods = [("Adaptive", f"{t:g}", ph.Adaptive(t)) for t in (1e-11, 1e-13, 1e-15)]
    methods += [("VariationOfConstants", f"{t:g}", ph.VariationOfConstants(t))
                for t in (1e-11, 1e-13)]
    methods += [("Collocation", f"{t:g}", ph.Collocation(t)) for t in (1e-9, 1e-14)]
    methods += [("Collocation", "default", ph.Collocation())]
    return [Contender(f"polhode {who}", setting, run(method)) for who, setting, method in methods]


def heyoka_contenders(heyoka, case):
    def run(tolerance):
        taylor = Taylor(heyoka, case, tolerance)
        start = taylor.start(case.rates)
        return lambda: (1, taylor.end(start))
    return [Contender("heyoka", f"{t:g}", run(t)) for t in (1e-11, 1e-13, 2.2e-16)]


def measured(options, missing):
    """Points of each case."""
    try:
        import heyoka
    except ImportError:
        missing("heyoka")
        return {}
    found = {}
    for case in CASES:
        ends = exact(heyoka, case)
        contenders = polhode_contenders(case) + heyoka_contenders(heyoka, case)
        found[case.name] = [
            {"who": t.who, "setting": t.setting, "seconds": t.median, "repetitions": t.seconds,
             "error": equations.angle(t.ends[0], ends["polhode" if t.who.startswith("polhode")
                                                      else "peers"])}
            for t in interleaved(contenders, options.repetitions)]
    return found
