# SPDX-License-Identifier: MIT
"""The posterior of Toutatis in December 1992

Draws from the posterior of the 17 attitudes that radar gave, with the prior of moments of those
who measured them (Takahashi, Busch and Scheeres 2013): the rate in the middle, rad per day, and
ratios of moments, with errors of attitudes as large as the residuals say; lines are what `fit_spin`
found. Needs `pip install polhode[sample]`.
"""

import numpy as np
import polhode
from polhode import figures

seen = """
02T21:40 122.2 86.5 107.0    03T19:30  86.3 81.8  24.5    04T18:10  47.8 60.7 284.0
05T18:50  14.6 39.4 207.1    06T17:30 331.3 23.7 151.6    07T17:20 222.5 25.4 143.9
08T16:40 169.8 45.5 106.9    09T17:50 137.3 71.3  22.3    10T17:20 103.1 85.2 292.6
11T09:40  77.0 85.7 225.5    12T09:20  42.8 70.2 133.2    13T08:10  13.7 44.4  51.9
14T07:50 323.7 14.0   0.0    15T07:50 193.2 24.4  21.4    16T07:10 165.1 46.4 310.6
17T06:49 130.6 76.1 234.9    18T07:09  91.6 81.6 142.4
""".split()
times = np.array(["1992-12-" + day for day in seen[::4]], "datetime64[s]")
t = (times - np.datetime64("1992-12-10T14:25")) / np.timedelta64(1, "D")
phi, theta, psi = np.radians([np.array(seen[k::4], float) for k in (1, 2, 3)])
attitudes = polhode.charts.attitude(polhode.charts.EulerAngles(phi, theta, psi))

middle = polhode.charts.attitude(polhode.charts.EulerAngles(*np.radians([105.0, 83.0, -60.0])))
start = polhode.fit.SpinState(middle, np.radians([36.0, -12.0, -98.0]), [3.0, 3.2, 1.0])
radar = polhode.fit.Snapshots(attitudes=(t, attitudes, np.radians(15.0)))
prior = {"Ixx/Izz": (3.091, 0.1), "Iyy/Izz": (3.2178, 0.1)}
found = polhode.fit.fit_spin(start, radar, priors=prior, scales_errors=True)
residuals = polhode.fit.SpinResiduals(
    found.state, radar, priors=prior, error_factor=found.error_factor
)
draws = polhode.fit.posterior(residuals, draws=500, warm_up=200, seed=1)
columns = ["w_x", "w_y", "w_z", "Ixx/Izz", "Iyy/Izz"]
best = [dict(zip(found.names, found.values))[name] for name in columns]
figures.save(figures.corner_plot(draws, columns, truths=best), "posterior_corner.png")
