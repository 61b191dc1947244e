# SPDX-License-Identifier: MIT
"""From the long axis to the short one: when friction turns a tumbler over

A tumbler about its long axis loses energy by friction inside, until it turns about its short axis.
How strong the friction is, is known to a factor of three, and the rotation period to a tenth: the
part of 300 such bodies in each mode, against time.
"""

import polhode
from polhode import figures, vary

scenario = polhode.Scenario.from_text("""
schema = 1
units = { time = "d", angle = "deg" }
body = { moments = [0.61, 0.965, 1.0] }
perturbation = [{ kind = "internal-damping", wobble_time = 900, rate = 300 }]
time = { stop = 300, step = 3 }
output.columns = ["tumbler"]
[state.tumbler]
precession_period = 1.2
rotation_period = 11
pole = { longitude = 250, latitude = -75 }
mode = "LAM"
phi0 = 0
psi0 = 0
""")
results = scenario.ensemble(vary={
        "perturbation[0].wobble_time": vary.log_uniform(500, 1500),
        "state.tumbler.rotation_period": vary.uniform(10, 12),
    }, size=300)
figures.save(figures.regime_fractions(results), "ensemble_regimes.png")
