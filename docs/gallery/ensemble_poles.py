# SPDX-License-Identifier: MIT
"""Where Apophis will point: its angular momentum after 2029

The same encounter, with what is not known of the phases: directions of the angular momentum of 600
draws two days after it, on the sky in ecliptic coordinates, by the mode in which the body comes
out. Before the encounter all of them are one point, at (250, -75) degrees.
"""

import polhode
from polhode import figures, vary

scenario = polhode.Scenario.from_text("""
schema = 1
units = { time = "h", angle = "deg", length = "km" }
body = { moments = [0.61, 0.965, 1.0] }
perturbation = [{ kind = "gravity-gradient", orbit = "earth" }]
time = { at = [96] }
output.columns = ["tumbler", "pole"]
[state]
axes = "ecliptic-J2000"
[state.tumbler]
precession_period = 30.56
rotation_period = 263
pole = { longitude = 250, latitude = -75 }
mode = "SAM"
phi0 = 0
psi0 = 0
[orbit.earth]
gm = "398600.4418 km3/s2"
pericentre = 38000
eccentricity = 4.2626
inclination = 162.8
node = 152.3
pericentre_argument = 32.8
epoch = 48
""")
phases = {
    "state.tumbler.phi0": vary.uniform(0, 360),
    "state.tumbler.psi0": vary.uniform(-53, 53),
}
results = scenario.ensemble(vary=phases, size=600, draws="sobol", keep="final")
figures.save(figures.pole_cloud(results, value="mode"), "ensemble_poles.png")
