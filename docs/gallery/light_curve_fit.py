# SPDX-License-Identifier: MIT
"""A light curve, its fit and what is left

Two nights of a synthetic tumbler with periods of 27 and 77 minutes, relative fluxes with errors of
2 %, and the ellipsoid that fits them: `fit_light` from a start nearby. Residuals are in standard
errors.
"""

import numpy as np
import polhode
from polhode import figures

sun, observer = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
body = polhode.light.LightModel.homogeneous(
    [0.6, 0.3, -0.5, 0.2], [0.12, 0.1, 0.2], [1.0, 0.7, 0.5]
)
random = np.random.default_rng(1)
nights = []
for name, begin, stop in (("first night", 0.0, 110.0), ("second night", 160.0, 270.0)):
    t = np.sort(random.uniform(begin, stop, 110))
    blank = polhode.light.LightCurve(t, np.ones(t.size), 1.0, sun, observer)
    (flux,) = polhode.light.model_fluxes(body, blank)
    seen = flux * (1.0 + 0.02 * random.normal(size=t.size))
    nights.append(polhode.light.LightCurve(t, seen, 0.02 * flux, sun, observer, name=name))

start = polhode.light.LightModel.homogeneous(body.spin.q, 1.0005 * body.spin.w, [1.0, 0.75, 0.55])
found = polhode.light.fit_light(start, nights)
axes = figures.light_curve_fit(nights, found, unit="min")
figures.save(axes, "light_curve_fit.png")
