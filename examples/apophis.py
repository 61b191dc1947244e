# SPDX-License-Identifier: MIT
"""Apophis: runs the scenario next to this file, says how it tumbles, and draws it.

    python apophis.py [PATH.png]
"""

import math
import sys
from pathlib import Path

import polhode
import polhode.figures

scenario = polhode.load(Path(__file__).with_name("apophis.toml"))
motion = scenario.free_rotation
tumbler = polhode.to_tumbler(motion, 0.0)
print(f"{scenario.title}: {motion.regime.name}")
print(f"P_phi = {tumbler.precession_period:.2f} h, P_psi = {tumbler.rotation_period:.1f} h")
print(f"the short axis precesses in {2 * math.pi / motion.precession_rate_short:.2f} h")

results = scenario.run()
path = polhode.figures.save(polhode.figures.overview(results), *sys.argv[1:] or ["apophis.png"])
print(f"{len(results.t)} states in {path}")

# Prints:
# Apophis, torque-free: short_axis
# P_phi = 30.56 h, P_psi = 263.0 h
# the short axis precesses in 27.38 h
# 1441 states in apophis.png
