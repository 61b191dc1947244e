# SPDX-License-Identifier: MIT
"""The landscape of a Fourier scan

Chi-square of two-dimensional Fourier series of a tumbler's light curve, by two frequencies; dark is
low. The lowest minima are numbered; crosses are those where harmonics are not told apart or that
lie at the edge. The two lines of the body are the minimum 1 or one of its relabellings.
"""

import numpy as np
import polhode
from polhode import figures

sun, observer = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
body = polhode.light.LightModel.homogeneous(
    [0.6, 0.3, -0.5, 0.2], [0.12, 0.1, 0.2], [1.0, 0.7, 0.5]
)
random = np.random.default_rng(1)
t = np.sort(random.uniform(0.0, 270.0, 220))
(flux,) = polhode.light.model_fluxes(
    body, polhode.light.LightCurve(t, np.ones(220), 1.0, sun, observer)
)
seen = flux * (1.0 + 0.02 * random.normal(size=t.size))
curve = polhode.light.LightCurve(t, seen, 0.02 * flux, sun, observer)

scan = polhode.light.fourier_scan(curve, (0.01, 0.12), order=2, threads=2)
figures.save(figures.scan_landscape(scan, unit="min"), "scan_landscape.png")
