# SPDX-License-Identifier: MIT
"""A planet caught in a Cassini state, and its escape

The node of the orbit goes back ever more slowly. After 110,000 years the axis is caught: from then
on it goes round with the node, and the angle between them (below) swings about 0, while the
obliquity grows. After 250,000 years the inclination of the orbit is damped. The resonance shrinks
until it loses the axis, and the obliquity stays.
"""

import numpy as np
from polhode import Splitting, figures
from polhode.secular import ElementTable, PrecessionRates, spin_history

t = np.linspace(-5e3, 610e3, 12300)  # years
rate = 8e-3 / 8 ** np.clip(t / 250e3, 0, 1)  # of the node, rad a year
node = -np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(t))])
inclination = np.radians(10) / 2000 ** np.clip(t / 150e3 - 5 / 3, 0, 1)
orbit = ElementTable(t, 0 * t, inclination, node, 0 * t)

# 10 degrees from the normal of the orbit, 20 from axis 3
n, tilt = np.interp(0, t, node), np.radians(20)
pole = [np.sin(tilt) * np.sin(n), -np.sin(tilt) * np.cos(n), np.cos(tilt)]
times = np.arange(0, 600e3, 200.0)
spin = spin_history(orbit, PrecessionRates(2e-3), pole, times, Splitting(20, "order8"))
angle = (np.degrees(spin.precession + np.interp(times, t, node)) + 180) % 360 - 180

with figures.style.style():
    above, below = figures.style.panels(None, 2, 1, (figures.SINGLE_COLUMN, 3.4), sharex=True).flat
    above.plot(times / 1e3, np.degrees(spin.obliquity), lw=0.6)
    above.set_ylabel("obliquity (deg)")
    below.plot(times / 1e3, angle, ".", ms=1)
    below.set(xlabel="time (kyr)", ylabel="precession + node (deg)", ylim=(-180, 180))
    below.set_yticks(range(-180, 181, 90))
    figures.save(above, "cassini_capture.png")
