# SPDX-License-Identifier: MIT
"""Elements over time

Columns of a run with their units, on one time axis; columns of one unit may share a panel. A
wrapped angle goes to the edge of its panel and comes back at the other. Here Dzhanibekov's wing
nut, spun at one turn per second about its intermediate axis, turns over every few seconds."""

from polhode import Scenario, figures

nut = Scenario.from_text("""
schema = 1
units = { time = "s", angle = "deg", moment = "g cm2" }
body.moments = [30.53, 83.87, 113.3]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.6, 360, 0] }
time = { stop = 15, step = 0.01 }
output.columns = ["omega", "andoyer"]
""")
axes = figures.time_series(nut.run(), ["g", "L", ("w1", "w2", "w3")])
figures.save(axes, "time_series.png")
