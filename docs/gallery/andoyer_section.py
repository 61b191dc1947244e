# SPDX-License-Identifier: MIT
"""A surface of section in Andoyer's plane: a magnetised satellite

A tumbling satellite (moments 1, 1.6 and 2) with a magnet along its longest axis, in a field that
does not change: the energy and the momentum H along the field are constant, and two degrees of
freedom are left. All starts have the same E and H; a dot where g passes 0, in the plane of l and
L/G, the cosine of the angle between the shortest axis and the angular momentum. Without the magnet
every motion were one of the curves of free rotation: about the short axis above and below, about
the long axis round l = 90 and -90 degrees, with a separatrix between. With it, islands of
resonances between wobble and precession stand among the curves, and a single run (grey) fills the
place of the separatrix: the satellite turns over, now about one axis, now about the other, without
a rule."""

import math

from polhode import (
    Adaptive,
    AndoyerState,
    Body,
    Problem,
    ResidualDipole,
    System,
    energy,
    figures,
    to_rotor,
)
from polhode.analysis import andoyer_section

E, H = 1.0, 0.3
satellite = Body(1.0, 1.6, 2.0)
magnet = ResidualDipole([0.3, 0, 0], field=[0, 0, 1])
system = System(satellite, terms=[magnet])


def start(l, cos_J):  # noqa: E741
    """The state with g = h = 0 and these l and L/G, on the level of E and H."""
    low, high = H, 5.0
    for _ in range(60):
        G = (low + high) / 2
        state = to_rotor(AndoyerState(l, 0.0, 0.0, cos_J * G, G, H))
        low, high = (G, high) if energy(system, 0.0, state) < E else (low, G)
    return state


def section(l, cos_J, stop=2000.0):  # noqa: E741
    return andoyer_section(Problem(system, start(l, cos_J), 0.0, stop, Adaptive(1e-10)))


chaotic = section(0.0, 0.1, stop=20000.0)
starts = [(0.0, x) for x in (-0.95, -0.88, -0.8, 0.77, 0.92)]
starts += [(-math.pi / 2, x) for x in (-0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5)]
starts += [(math.pi / 2, x) for x in (0.2, 0.28, 0.36, 0.44, 0.5, 0.55, 0.6, 0.67, 0.74, 0.8)]
ax = figures.poincare_section(chaotic, "l", "L/G", color="0.6", size=0.7)
figures.poincare_section([section(*at) for at in starts], "l", "L/G", ax=ax, size=0.8)
ax.set_ylim(-1, 1)
figures.save(ax, "andoyer_section.png")
