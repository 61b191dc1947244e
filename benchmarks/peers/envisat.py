# SPDX-License-Identifier: MIT
"""Goal G14: a year of Envisat (examples/envisat.toml) beside heyoka with the same equations.

Gravity gradient and eddy currents in the field of a tilted dipole that turns, on a Kepler orbit
whose node and pericentre move evenly; 1.4 million radians. heyoka is given the planar Kepler
problem as four equations more; lengths are in axes of the orbit and times in 20 s, so that all
numbers are near 1. Its integration in 80 bits from polhode's momentum is the reference of both; run
as a program this prints its end.
"""

import pathlib

import equations
import numpy as np
from equations import cross, dot
from timing import Contender, interleaved

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/envisat.toml"
SPAN = 365.25 * 86400.0
UNIT = 20.0
END = tuple(map(np.longdouble, (
    "-0.094459559866502213095", "-0.33446287639921879815", "0.53837012663759550943",
    "-0.76770409833789954486")))
END_MOMENTUM = (-0.007449447108787058, -0.6486352301255539, 4839.540067985047)  # kg m2/s, body axes


def scaled(k, a):
    return tuple(k * x for x in a)


def total(*vectors):
    return tuple(sum(parts[1:], parts[0]) for parts in zip(*vectors, strict=True))


def turned(cosine, sine, a):
    """About axis 3."""
    return (cosine * a[0] - sine * a[1], sine * a[0] + cosine * a[1], a[2])


class Orbit:
    """Place, velocity and normal along inertial axes, from those in the plane of the ellipse."""

    def __init__(self, heyoka, orbit, number):
        self.elements, rates = orbit.elements, orbit.rates
        self.node = number(rates.node) * number(UNIT)
        self.argument = number(rates.argument) * number(UNIT)
        tilt = number(self.elements.inclination)
        self.tilt = np.cos(tilt), np.sin(tilt)
        time = heyoka.time
        node = number(self.elements.node) + self.node * time
        argument = number(self.elements.argument) + self.argument * time
        self.in_plane = heyoka.cos(argument), heyoka.sin(argument)
        self.of_node = heyoka.cos(node), heyoka.sin(node)

    def inertial(self, a):
        cosine, sine = self.tilt
        x, y, z = turned(*self.in_plane, a)
        return turned(*self.of_node, (x, cosine * y - sine * z, sine * y + cosine * z))

    def motion(self, x, y, vx, vy):
        zero = 0.0 * x
        r = self.inertial((x, y, zero))
        cosine, sine = self.tilt
        normal = turned(*self.of_node, (0.0 * self.of_node[0], -sine + 0.0 * zero,
                                        cosine + 0.0 * zero))
        turn = scaled(self.argument, cross(normal, r))
        swing = (-self.node * r[1], self.node * r[0], zero)
        return r, total(self.inertial((vx, vy, zero)), turn, swing)


def field_of(heyoka, dipole, size, number):
    """A function of place and velocity: the field there, and its whole rate."""
    shrink = number(size) ** number(3)
    k1, k2, k3 = (number(k) / shrink for k in dipole.strength)
    rate = number(dipole.rate) * number(UNIT)
    angle = number(dipole.meridian) + rate * heyoka.time
    cosine, sine = heyoka.cos(angle), heyoka.sin(angle)
    K = (k1 * cosine - k2 * sine, k1 * sine + k2 * cosine, k3 + 0.0 * cosine)
    dK = (-rate * K[1], rate * K[0], 0.0 * cosine)

    def field(r, v):
        r2 = dot(r, r)
        cube = r2 ** number(-1.5)
        along, out = 3.0 * dot(K, r) / r2, dot(r, v) / r2
        B = total(scaled(along * cube, r), scaled(-cube, K))
        by_time = total(scaled(3.0 * (dot(dK, r) + dot(K, v)) / r2 * cube, r),
                        scaled(along * cube, v), scaled(-cube, dK))
        by_size = total(scaled(-5.0 * along * out * cube, r), scaled(3.0 * out * cube, K))
        return B, total(by_time, by_size)
    return field


def rates(heyoka, example, number=float):
    import polhode as ph

    gradient, eddies = (term.arguments for term in example.system.terms)
    names = heyoka.make_vars("qw", "qx", "qy", "qz", "wx", "wy", "wz", "x", "y", "vx", "vy")
    q, w, (x, y, vx, vy) = names[:4], names[4:7], names[7:]
    orbit = Orbit(heyoka, gradient["orbit"], number)
    a, gm = size_and_pull(orbit.elements, number)
    r, v = orbit.motion(x, y, vx, vy)
    r2 = x * x + y * y
    pull = gm * r2 ** number(-1.5)
    n = equations.body_axes(q, r)
    dipole = ph.DipoleField.from_gauss(
        *eddies["gauss"], eddies["reference_radius"], eddies["pole"], eddies["rotation_rate"],
        eddies["meridian"], eddies["meridian_epoch"])
    B, dB = (equations.body_axes(q, c) for c in field_of(heyoka, dipole, a, number)(r, v))
    seen = total(cross(w, B), scaled(-1.0, dB))
    M = [[number(m) for m in row] for row in eddies["tensor"]]
    brake = scaled(number(UNIT), cross([dot(row, seen) for row in M], B))
    I = [number(i) for i in example.system.body.moments]
    k = 3.0 * pull / r2
    turns = [((I[j] - I[m]) * (w[j] * w[m] - k * n[j] * n[m]) + brake[i]) / I[i]
             for i, j, m in ((0, 1, 2), (1, 2, 0), (2, 0, 1))]
    found = [*equations.kinematics(q, w, number(0.5)), *turns, vx, vy, -pull * x, -pull * y]
    return list(zip(names, found, strict=True))


def size_and_pull(elements, number):
    """The axis of the orbit, and gm in that and in units of time."""
    a = number(elements.pericentre) / (number(1) - number(elements.eccentricity))
    return a, number(elements.gm) * number(UNIT) ** 2 / a ** 3


def start(example, number=float):
    elements = example.system.terms[0].arguments["orbit"].elements
    e, M = number(elements.eccentricity), number(elements.mean_anomaly)
    _, gm = size_and_pull(elements, number)
    E = M
    for _ in range(20):
        E = E - (E - e * np.sin(E) - M) / (number(1) - e * np.cos(E))
    far, long = number(1) - e * np.cos(E), np.sqrt((number(1) - e) * (number(1) + e))
    speed = np.sqrt(gm) / far
    state = example.initial_state
    w = [number(g) / number(i) * number(UNIT)
         for g, i in zip(state.g, example.system.body.moments, strict=True)]
    return [*(number(c) for c in state.q), *w, np.cos(E) - e, long * np.sin(E),
            -speed * np.sin(E), speed * long * np.cos(E)]


def exact(heyoka, example):
    """The last attitude and angular velocity, in 80 bits: what END holds. Some two minutes."""
    wide = np.longdouble
    taylor = heyoka.taylor_adaptive(rates(heyoka, example, wide), start(example, wide),
                                    tol=wide(1e-18), fp_type=wide)
    taylor.propagate_until(wide(SPAN) / wide(UNIT))
    return taylor.state[:7].copy()


def polhode_contenders(ph, example):
    def run(method):
        problem = ph.Problem(example.system, example.initial_state, 0.0, SPAN, method)

        def once():
            return 1, np.array(ph.integrate(problem, [SPAN], dense=False).q[-1])
        return once
    methods = [("default", ph.Collocation())]
    methods += [(f"{t:g}", ph.Collocation(t)) for t in (1e-7, 1e-8, 1e-14)]
    return [Contender("polhode Collocation", setting, run(m)) for setting, m in methods]


def heyoka_contenders(heyoka, example):
    right, begin = rates(heyoka, example), np.array(start(example))

    def run(tolerance):
        taylor = heyoka.taylor_adaptive(right, begin.copy(), tol=tolerance)

        def once():
            taylor.propagate_until(SPAN / UNIT)
            return 1, taylor.state[:4].copy()
        return once
    return [Contender("heyoka", f"{t:g}", run(t), once=True) for t in (1e-11, 2.2e-16)]


def measured(options, missing):
    try:
        import heyoka
    except ImportError:
        missing("heyoka")
        return []
    import polhode as ph
    example = ph.load(EXAMPLE)
    found = interleaved(polhode_contenders(ph, example) + heyoka_contenders(heyoka, example),
                        options.repetitions)
    return [{"who": t.who, "setting": t.setting, "seconds": t.median, "repetitions": t.seconds,
             "error": equations.angle(t.ends[0], END)} for t in found]


def main():
    import heyoka
    import polhode as ph
    print(*(np.format_float_positional(x) for x in exact(heyoka, ph.load(EXAMPLE))))


if __name__ == "__main__":
    main()
