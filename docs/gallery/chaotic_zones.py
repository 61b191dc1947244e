# SPDX-License-Identifier: MIT
"""Chaotic zones of the obliquity: Mars, and the Earth with and without its Moon

The frequency of the precession over the first and over the second half of 20 million years, for
every obliquity and precession constant at the start: where it changed (yellow), the obliquity is
chaotic. Mars (cross) lies in such a zone. The Earth would without its Moon (lower cross); the Moon
makes the precession constant three times as large, and all is regular there (upper cross).
"""

from polhode import Scenario, figures

FILE = """
schema = 1
kind = "obliquity"
units = {{ time = "kyr", angle = "deg" }}
planet.orbit = "own"
planet.precession_constant = 1
planet.pole = {{ obliquity = 0, precession = {psi} }}
orbit.own = {{ kind = "shipped", name = "{planet}" }}
method = {{ kind = "splitting", scheme = "order8", step = 5 }}
time = {{ stop = -20000, step = 2 }}

[map]
kind = "frequency"

[[map.axis]]
key = "planet.precession_constant"
from = 1
to = {most}
count = 19

[[map.axis]]
key = "planet.pole.obliquity"
from = 0
to = 90
count = 25
"""


def zones(ax, planet, psi, most):
    of = Scenario.from_text(FILE.format(planet=planet, psi=psi, most=most)).map()
    figures.chaos_map(of, "change", ax, log=True, limits=(1e-4, 1e-1))
    ax.set(xlabel="obliquity (deg)", ylabel="precession constant (deg/kyr)")
    ax.figure.axes[-1].set_ylabel("relative change of the frequency")  # the colour bar


with figures.style.style():
    ((mars, earth),) = figures.style.panels(None, 1, 2, (figures.DOUBLE_COLUMN, 2.8))
    zones(mars, "mars", 95, 4)
    mars.set_title("on the orbit of Mars")
    mars.plot(25.2, 2.33, "x", color="white", markersize=7, markeredgewidth=1.5)
    zones(earth, "earth", 0, 17)
    earth.set_title("on the orbit of the Earth")
    earth.plot([23.4, 23.4], [4.83, 15.3], "x", color="white", markersize=7, markeredgewidth=1.5)
    figures.save(mars, "chaotic_zones.png")
