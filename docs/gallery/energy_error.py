# SPDX-License-Identifier: MIT
"""How well each method keeps the energy

A tumbling moon, three moments of inertia, on a circular orbit: in the frame that turns with the
orbit the energy is constant. The adaptive method lets it drift in proportion to its tolerance;
the splitting, which is symplectic, keeps its error bounded."""

import math

from polhode import (
    Adaptive,
    Body,
    Frame,
    GravityGradient,
    Problem,
    Splitting,
    System,
    figures,
    integrate,
    rotor_state,
)

body = Body(1.0, 1.6, 2.0)
planet = GravityGradient(lambda t: (1.0, 0.0, 0.0), 1.0, axes="reference")
system = System(body, Frame.precessing((0, 0, 1), 1.0), [planet])
start = rotor_state(body, [0.9, 0.3, 0.2, 0.1], [1.5, 2.0, 3.0])
methods = {
    "adaptive, tolerance 1e-8": Adaptive(1e-8),
    "adaptive, tolerance 1e-12": Adaptive(1e-12),
    "splitting ABA864, step 0.05": Splitting(0.05),
}
stop, times = 200 * 2 * math.pi, [math.pi * k for k in range(401)]
runs = {name: integrate(Problem(system, start, 0, stop, m), times) for name, m in methods.items()}
ax = figures.energy_error(runs, system)
figures.save(ax, "energy_error.png")
