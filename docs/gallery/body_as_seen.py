# SPDX-License-Identifier: MIT
"""The body behind the light curve

A tumbling ellipsoid as its observer sees it at six times, shaded by the law of Lommel and Seeliger;
arrows point to the Sun.
"""

import polhode
from polhode import figures

body = polhode.light.LightModel.homogeneous(
    [0.6, 0.3, -0.5, 0.2], [0.12, 0.1, 0.2], [1.0, 0.7, 0.5]
)
axes = figures.body_as_seen(
    body, [0, 4, 8, 12, 16, 20], [1.0, 0.2, 0.3], [0.8, 0.9, 0.1], unit="min"
)
figures.save(axes, "body_as_seen.png")
