# SPDX-License-Identifier: MIT
"""Obliquity against precession rate: the resonances of Mars

A planet on the orbit of Mars, from the pole of Mars, with other rates of precession: the lowest,
the mean and the highest obliquity over the past 20 million years. Dashed are frequencies of the
node, 5.6, 6.8 and 17.8 arcsec a year. Near one of them the obliquity swings far. Mars itself
(dotted) is in the zone of the lower two; the upper one widens all that is to the right of 13.
"""

import numpy as np
from polhode import Splitting, figures
from polhode.secular import PrecessionRates, planet_pole, shipped_orbit, spin_history

arcsec = np.pi / 180 / 3.6  # a year, in rad a kyr
orbit, pole = shipped_orbit("mars", year=1e-3), planet_pole("mars")
times = np.arange(0, -20001, -5.0)  # kyr
rates = np.linspace(3, 21, 181)  # arcsec a year
cosine = np.cos(spin_history(orbit, PrecessionRates(arcsec), pole, [0.0, -1.0]).obliquity[0])
eccentric = (1 - 0.0934**2) ** -1.5

found = []
for rate in rates:
    star = PrecessionRates(rate * arcsec / cosine / eccentric)
    degrees = np.degrees(spin_history(orbit, star, pole, times, Splitting(5, "order8")).obliquity)
    found.append([degrees.min(), degrees.mean(), degrees.max()])
least, mean, most = np.transpose(found)

with figures.style.style():
    ax = figures.style.axes_or_new(None, figures.SINGLE_COLUMN)
    ax.fill_between(rates, least, most, color=figures.series(0).color, alpha=0.25, lw=0)
    for bound in (least, most):
        ax.plot(rates, bound, **figures.series(0).line | {"linewidth": 0.6})
    ax.plot(rates, mean, color="black", lw=0.8)
    for frequency in (5.6, 6.8, 17.75):
        ax.axvline(frequency, color="gray", ls="--", lw=0.6)
    ax.axvline(7.597, color="black", ls=":", lw=0.8)
    ax.set(xlabel="precession rate now (arcsec a year)", ylabel="obliquity (deg)",
           xlim=(rates[0], rates[-1]), ylim=(0, None))
    figures.save(ax, "obliquity_resonances.png")
