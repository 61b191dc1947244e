# SPDX-License-Identifier: MIT
"""The moon of Wisdom, Peale and Mignard (1984) on its orbit, in units of the semi-major axis and of
the mean motion: what the tests of chaos and of sections look at."""

from polhode import Body, GravityGradient, KeplerElements, KeplerOrbit, System

a2, b2, c2 = 190.0**2, 145.0**2, 114.0**2
HYPERION = Body((b2 + c2) / (a2 + b2), (a2 + c2) / (a2 + b2), 1.0)
ORBIT = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
SYSTEM = System(HYPERION, terms=[GravityGradient(ORBIT, 1.0)])
