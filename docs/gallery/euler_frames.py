# SPDX-License-Identifier: MIT
"""The same attitude by two ways

The paper's Fig. 3, with fewer details: (a) from the inertial axes to the body by way of the
invariable plane, with Andoyer's h, I, g, J, l; (b) directly, with Euler's phi, theta, psi."""

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

I, J = np.radians([38.0, 32.0])
state = polhode.to_rotor(
    polhode.AndoyerState(
        l=np.radians(55.0), g=np.radians(70.0), h=np.radians(40.0), L=np.cos(J), G=1.0, H=np.cos(I)
    )
)
size = (figures.DOUBLE_COLUMN, 0.46 * figures.DOUBLE_COLUMN)
figure, (left, right) = plt.subplots(1, 2, figsize=size, layout="constrained")
figures.frames_and_angles(state, "andoyer", ax=left)
figures.frames_and_angles(state, "euler", ax=right)
figures.style.panel_label(left, "(a)")
figures.style.panel_label(right, "(b)")
figures.save(figure, "euler_frames.png")
