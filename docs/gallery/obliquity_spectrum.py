# SPDX-License-Identifier: MIT
"""The spectrum of the obliquity: Mars and the Earth

The leading lines of the obliquity over the past 20 million years, without its mean. Those of the
Earth are sums of its precession (50.4 arcsec a year) and the frequencies of the node of its orbit:
31.6 arcsec a year is the cycle of 41,000 years. Those of Mars lie where the differences of its
precession and its nodes are: much lower, and near 0 where the two nearly meet.
"""

import warnings

import numpy as np
from polhode import Splitting, figures
from polhode.analysis import spectrum
from polhode.secular import planet_pole, planet_rates, shipped_orbit, spin_history

times = np.arange(0, -20001, -1.0)  # kyr
warnings.simplefilter("ignore", RuntimeWarning)  # of lines that lie close: the orbit is chaotic
arcsec = 180 / np.pi * 3.6  # a year, of rad a kyr

with figures.style.style():
    panels = figures.style.panels(None, 2, 1, (figures.SINGLE_COLUMN, 3.6), sharex=True).flat
    for ax, planet in zip(panels, ("mars", "earth")):
        spin = spin_history(
            shipped_orbit(planet, year=1e-3), planet_rates(planet, year=1e-3),
            planet_pole(planet), times, Splitting(2, "order8"))
        lines = spectrum(np.degrees(spin.obliquity), 1.0, lines=20)
        at, size = np.abs(lines.frequency) * arcsec, lines.amplitude
        ax.vlines(at, 0, size, lw=0.8)
        ax.set(xlim=(0, 50), ylim=(0, None), ylabel="amplitude (deg)",
               title={"mars": "Mars", "earth": "the Earth"}[planet])
        ax.annotate(f"{1296 / at[0]:.0f} kyr", (at[0], size[0]), (4, -4),
                    textcoords="offset points")
    ax.set_xlabel("frequency (arcsec a year)")
    figures.save(ax, "obliquity_spectrum.png")
