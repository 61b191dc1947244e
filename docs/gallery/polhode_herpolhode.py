# SPDX-License-Identifier: MIT
"""Polhode and herpolhode

Poinsot's picture of free rotation: the ellipsoid of energy rolls on a plane that stays in
space. The angular velocity of (99942) Apophis, in its tumbling: (a) its polhode on the
ellipsoid, closed in the body; (b) its herpolhode in the plane, which does not close."""

import numpy as np
import polhode
from polhode import figures

longitude, latitude = np.radians([250.0, -75.0])
apophis = polhode.Body(0.61, 0.965, 1.0)  # ratios, P_1 and P_psi (h): Pravec et al. (2014)
pole = [
    np.cos(latitude) * np.cos(longitude),
    np.cos(latitude) * np.sin(longitude),
    np.sin(latitude),
]
tumbler = polhode.TumblerState(
    30.56, 263.0, pole, polhode.free.Regime.short_axis, phi0=0.0, psi0=0.0
)
motion = polhode.FreeRotation(apophis, polhode.to_rotor(apophis, tumbler))
axes = figures.polhode_and_herpolhode(motion, periods=1, unit="rad/h")
figures.save(axes, "polhode_herpolhode.png")
