# SPDX-License-Identifier: MIT
"""A long run at a glance

A curve that swings too often for the picture is shown by a band from its least to its largest
value in each bin of time, with a line of the mean; an angle that turns that fast goes round. Here
friction inside a tumbling satellite takes energy and leaves the momentum: within a week and 400
turns the satellite goes from turning about its long axis to a spin about the short one. The
momentum crosses polhode after polhode, of which some are drawn."""

from polhode import Scenario, figures

satellite = Scenario.from_text("""
schema = 1
title = "Friction inside"
units = { time = "d", angle = "deg", moment = "kg m2" }
body.moments = [1700, 2500, 3000]
state.attitude-rate = { quaternion = [0.8, 0, 0.6, 0], omega_body = [28800, 2880, 1440] }
time = { stop = 7, step = "10 s" }
output.columns = ["q", "omega", "g"]

[[perturbation]]
kind = "internal-damping"
wobble_time = "12 h"
rate = "20 deg/min"
""")
axes = figures.overview(satellite.run())
figures.save(axes, "long_run.png")
