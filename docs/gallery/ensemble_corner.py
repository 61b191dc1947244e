# SPDX-License-Identifier: MIT
"""What errors of observations say together: the wobble of Apophis

Both periods of (99942) Apophis and the ratio of its moments have errors (Pravec et al. 2014). The
mean period of precession and the amplitude of the wobble about the long axis follow from them, with
errors that depend on one another: a longer rotation period goes with a wider wobble.
"""

import polhode
from polhode import figures, vary

scenario = polhode.Scenario.from_text("""
schema = 1
units = { time = "h", angle = "deg" }
body = { moments = [0.61, 0.965, 1.0] }
time = { at = [0] }
output.columns = ["tumbler"]
[state.tumbler]
short_axis_period = 27.38
rotation_period = 263
pole = { longitude = 250, latitude = -75 }
mode = "SAM"
phi0 = 0
psi0 = 0
""")
results = scenario.ensemble(vary={
        "state.tumbler.short_axis_period": vary.normal(sigma=0.07),
        "state.tumbler.rotation_period": vary.normal(sigma=6),
        "body.moments[0]": vary.uniform(0.60, 0.63),
    }, size=2000, keep="final")  # fmt: skip
figures.save(figures.corner_plot(results), "ensemble_corner.png")
