# SPDX-License-Identifier: MIT
"""Four poles that one night leaves

Poles of all solutions that one night of a synthetic tumbler allows, with their 1-sigma ellipses.
Seen and lit from fixed directions, an ellipsoid has the same light after half turns about three
directions at right angles: four poles of the same chi-square.
"""

import numpy as np
import polhode
from polhode import figures

sun, observer = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
body = polhode.light.LightModel.homogeneous(
    [0.6, 0.3, -0.5, 0.2], [0.12, 0.1, 0.2], [1.0, 0.7, 0.5]
)
random = np.random.default_rng(2)
t = np.sort(random.uniform(0.0, 150.0, 110))
(flux,) = polhode.light.model_fluxes(
    body, polhode.light.LightCurve(t, np.ones(110), 1.0, sun, observer)
)
seen = flux * (1.0 + 0.05 * random.normal(size=t.size))
curve = polhode.light.LightCurve(t, seen, 0.05 * flux, sun, observer)

motion = body.spin.free_rotation
mode = {"short_axis": "SAM", "long_axis": "LAM"}[motion.regime.name]
periods = [(mode, 2.0 * np.pi / motion.precession_rate_long, motion.polhode_period)]
found = polhode.light.search_light(curve, periods, starts=20, threads=2)
figures.save(figures.pole_sky(found), "pole_sky.png")
