# SPDX-License-Identifier: MIT
"""Mean rotation under a gravity gradient: how fast the error falls

Left: the largest error in attitude of GravityGradientTheory over 48 turns and 2.5 orbits, against
an integration of the body, as the torque gets weaker than that of the orbit's own gm. Order 1
(dashed) falls as the power 2, order 2 as the power 3 (grey lines), for an axisymmetric body and a
triaxial one on a circle, for the triaxial one on an ellipse, and in long-axis mode. Right: the
angle of the momentum from the normal of the orbit, of the triaxial body under the whole torque on
an ellipse: osculating, its mean over the turns of the body alone, and over the orbit as well.
"""

import numpy as np
import polhode
from polhode import Adaptive, GravityGradient, figures
from polhode.secular import GravityGradientTheory

n = 0.0531  # mean motion; the bodies turn about once in 2 pi
attitude = [0.6, 0.5, -0.3, 0.4]
short, long = [0.3, 0.1, 1.0], [1.0, 0.1, 0.2]
cases = [
    ("axisymmetric, circle", polhode.Body(1, 1, 1.5), short, 0.0, 1.0),
    ("triaxial, circle", polhode.Body(1, 1.3, 1.7), short, 0.0, 1.0),
    ("triaxial, e = 0.05", polhode.Body(1, 1.3, 1.7), short, 0.05, 1.0),
    ("long-axis mode, circle", polhode.Body(1, 1.8, 2), long, 0.0, 0.1),
]


def motion(body, omega, e, times, strength):
    """Orbit, first state, and the states at these times."""
    orbit = polhode.KeplerOrbit(
        polhode.KeplerElements(n**2, 1 - e, e, inclination=0.3, node=0.3, argument=0.7)
    )
    start = polhode.rotor_state(body, attitude, omega)
    system = polhode.System(body, terms=GravityGradient(orbit, strength * n**2))
    problem = polhode.Problem(system, start, 0.0, times[-1], Adaptive(1e-13))
    return orbit, start, polhode.integrate(problem, polhode.SaveAt.times(times)).states


def angle(p, q):
    """Between attitudes, rad."""
    vector = p[:, :1] * q[:, 1:] - q[:, :1] * p[:, 1:] - np.cross(p[:, 1:], q[:, 1:])
    return 2 * np.arcsin(np.linalg.norm(vector, axis=-1))


def error(body, omega, e, strength, order):
    times = np.linspace(15.0, 300.0, 20)
    orbit, start, exact = motion(body, omega, e, times, strength)
    theory = GravityGradientTheory(
        body, orbit, start, gm=strength * n**2, order=order, least=1e-14
    )
    found = theory.states(0.0, theory.mean(0.0, start), times)
    return angle(found.q, exact.q).max()


def inclination(mean):
    return np.degrees(np.arccos(mean.I_h / mean.I_g))


with figures.style.style():
    (panels,) = figures.style.panels(None, 1, 2, (figures.DOUBLE_COLUMN, 3.2))
    left, right = panels
    for index, (label, body, omega, e, largest) in enumerate(cases):
        strengths = largest * np.geomspace(0.03 if largest == 1 else 0.2, 0.8, 7)
        for order, line in (1, "--"), (2, "-"):
            errors = [error(body, omega, e, strength, order) for strength in strengths]
            left.loglog(strengths, errors, line, marker=".", color=f"C{index}",
                        label=label if order == 2 else None)  # fmt: skip
    strengths = np.array([0.02, 0.9])
    for order, size in (1, 1e-2), (2, 1e-4):
        left.loglog(strengths, size * strengths ** (order + 1), "-", color="0.6", lw=0.6)
        left.annotate(f"order {order}", (0.92, size * 0.8), fontsize="small")
    left.set(xlabel="torque over that of the orbit's gm", ylabel="error in attitude (rad)",
             xlim=(1e-2, 2.5))  # fmt: skip
    left.legend(loc="upper left", fontsize="small")

    times = np.linspace(0.0, 2 * np.pi / n, 800)
    _, body, omega, e, _ = cases[2]
    orbit, start, states = motion(body, omega, e, times, 1.0)
    orbits = times * n / (2 * np.pi)
    for averages, label, look in (
        (False, "mean over turns", {"color": "C0", "lw": 2.5, "alpha": 0.5}),
        (True, "mean over turns and orbit", {"color": "C1"}),
    ):
        theory = GravityGradientTheory(body, orbit, start, averages_orbit=averages)
        mean = theory.means(0.0, theory.mean(0.0, start), times)
        right.plot(orbits, inclination(mean), "-", label=label, **look)
    osculating = inclination(theory.elements(times, states))
    right.plot(orbits, osculating, "-", color="black", lw=0.7, label="osculating")
    right.set(xlabel="orbits", ylabel="momentum from the normal (deg)", ylim=(50.0, 51.7))
    right.legend(loc="upper left", fontsize="small")
    figures.save(left, "mean_rotation.png")
