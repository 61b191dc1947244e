# SPDX-License-Identifier: MIT
"""A film: the wing nut turns over

Dzhanibekov's wing nut, as a box of its moments, spins about its intermediate axis and turns
over. The momentum **G** stays; in the body its tip runs along the polhode (green), slowly near
b2, fast in between. One polhode period, two turnovers. With ffmpeg, the same call writes an
.mp4."""

import math

import numpy as np
from polhode import Body, FreeRotation, figures, rotor_state

body = Body(30.53, 83.87, 113.3)
start = rotor_state(body, q=[0.9, 0.3, 0.2, 0.1], omega_B=np.array([0.01, 1.0, 0.0]) * 2 * math.pi)
motion = FreeRotation(body, start)
times = np.linspace(0.0, motion.polhode_period, 54)
figures.animation(motion, "attitude_animation.gif", times=times, fps=12, shape="box", unit="s")
