# SPDX-License-Identifier: MIT
"""What is not known of a rate: how the pitch of a satellite spreads

A satellite that gravity keeps upright is let go with a pitch rate of 0.04 deg/s against the local
vertical, which is known to a quarter. All of 300 draws swing in step at first. But wide swings take
longer than small ones, so that their phases drift apart, and after half a day only the range of the
swings is left to know.
"""

import polhode
from polhode import figures, vary

scenario = polhode.Scenario.from_text("""
schema = 1
units = { time = "h", angle = "deg", length = "km" }
body = { moments = [100, 110, 20] }
frame.local-vertical.orbit = "earth"
orbit.earth = { gm = "398600.4418 km3/s2", semi_major_axis = 7178.137 }
perturbation = [{ kind = "gravity-gradient", orbit = "earth" }]
time = { stop = 16, count = 401 }
output.columns = ["roll_pitch_yaw"]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_relative = [0, 0, 0] }
""")
rate = "state.attitude-rate.omega_relative[1]"
results = scenario.ensemble(vary={rate: vary.normal(mean=144, sigma=36)}, size=300, quantiles=[
    0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99
])  # fmt: skip
figures.save(figures.quantile_fan(results, "pitch"), "ensemble_fan.png")
