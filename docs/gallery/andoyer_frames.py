# SPDX-License-Identifier: MIT
"""Planes, nodes and angles of a state

The paper's Fig. 2, drawn from a real state: the inertial plane, the invariable plane (normal to
the angular momentum G) and the body's equator, the lines in which they meet, Andoyer's angles
h, I, g, J, l and Euler's phi, theta, psi."""

import numpy as np
import polhode
from polhode import figures

I, J = np.radians([38.0, 32.0])  # tilts of the invariable plane and of the body equator
state = polhode.to_rotor(
    polhode.AndoyerState(
        l=np.radians(55.0), g=np.radians(70.0), h=np.radians(40.0), L=np.cos(J), G=1.0, H=np.cos(I)
    )
)
ax = figures.frames_and_angles(state, "both")
figures.save(ax, "andoyer_frames.png")
