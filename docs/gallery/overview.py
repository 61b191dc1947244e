# SPDX-License-Identifier: MIT
"""A run at a glance

What `make demo` draws of a scenario: the momentum in the body among its polhodes, the Euler
angles and the angular velocity. Here the asteroid (99942) Apophis tumbles for a month (periods
and moment ratios of Pravec et al. 2014)."""

from polhode import Scenario, figures

apophis = Scenario.from_text("""
schema = 1
title = "Apophis"
units = { time = "h", angle = "deg" }
body.moments = [0.61, 0.965, 1.0]
time = { stop = 720, step = 0.5 }
output.columns = ["q", "omega", "g"]

[state.tumbler]
precession_period = 30.56
rotation_period = 263
pole = { longitude = 250, latitude = -75 }
mode = "SAM"
phi0 = 0
psi0 = 0
""")
axes = figures.overview(apophis.run(), apophis.body)
figures.save(axes, "overview.png")
