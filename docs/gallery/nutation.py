# SPDX-License-Identifier: MIT
"""Nutation of the rigid Earth: the ellipse of 18.6 years, and what parts its axes

Left: the path of the axis of figure among the stars by the theory, once precession is taken off,
and the ellipse that the node of the Moon alone draws. Right: the axis of figure less that of the
momentum, the Oppolzer terms, over one year and a thousand times smaller: a constant offset in
obliquity, and round it loops of half a month that half a year makes wider and narrower.
"""

import numpy as np
import polhode
from polhode import figures

MAS = np.pi / 648000e3
earth = polhode.secular.nutation_theory()
days = np.arange(0, 6798.4, 0.5)
figure = earth.at(days * 86400)
year = np.arange(0, 365.3, 0.1) * 86400
oppolzer = earth.at(year) - earth.at(year, "momentum")
sky = np.array([np.sin(np.radians(84381.406 / 3600)), 1.0])  # angles on the sky

node = earth.terms()
largest = node["longitude_sine"][0], node["obliquity_cosine"][0]
turn = np.linspace(0, 2 * np.pi, 400)
ellipse = np.column_stack([largest[0] * np.sin(turn), largest[1] * np.cos(turn)]) * sky

with figures.style.style():
    ((left, right),) = figures.style.panels(None, 1, 2, (figures.DOUBLE_COLUMN, 3.4))
    left.plot(*(figure * sky / MAS / 1000).T, color=figures.style.BLUE, lw=0.5, label="all terms")
    left.plot(*(ellipse / MAS / 1000).T, color=figures.style.BLACK, lw=1.2,
              label="the node of the Moon alone")  # fmt: skip
    left.set(xlabel="longitude on the sky (arcsec)", ylabel="obliquity (arcsec)", aspect="equal",
             xlim=(-11, 11), ylim=(-13, 14))  # fmt: skip
    left.legend(loc="upper center", ncols=2)
    right.plot(*(oppolzer * sky / MAS).T, color=figures.style.VERMILLION, lw=0.7)
    right.plot(0, 0, "+", color=figures.style.BLACK)
    right.annotate("axis of momentum", (0, 0), (0, 6), textcoords="offset points", ha="center")
    right.set(xlabel="longitude on the sky (mas)", ylabel="obliquity (mas)", aspect="equal",
              xlim=(-16, 16), ylim=(-25, 5))  # fmt: skip
    figures.save(left, "nutation.png")
