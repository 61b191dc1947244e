# SPDX-License-Identifier: MIT
"""Five million years of Mars and the Earth: obliquity and eccentricity

On the orbits that polhode brings along. Mars swings between 15 and 40 degrees, since its precession
comes near to frequencies of its node. The Earth keeps between 22 and 24.5 degrees, because the Moon
makes its precession faster than all of them.
"""

import numpy as np
from polhode import Splitting, figures
from polhode.secular import planet_pole, planet_rates, shipped_orbit, spin_history

times = np.arange(0, -5001, -2.0)  # kyr

with figures.style.style():
    panels = figures.style.panels(None, 2, 2, (figures.DOUBLE_COLUMN, 3.4), sharex=True)
    for (above, below), planet in zip(panels.T, ("mars", "earth")):
        spin = spin_history(
            shipped_orbit(planet, year=1e-3), planet_rates(planet, year=1e-3),
            planet_pole(planet), times, Splitting(2, "order8"))
        above.plot(times / 1e3, np.degrees(spin.obliquity), lw=0.6)
        above.set(title={"mars": "Mars", "earth": "the Earth"}[planet], xlim=(-5, 0))
        below.plot(times / 1e3, spin.eccentricity, lw=0.6)
        below.set_xlabel("time (million years)")
    panels[0, 0].set_ylabel("obliquity (deg)")
    panels[1, 0].set_ylabel("eccentricity")
    figures.save(panels, "obliquity_series.png")
