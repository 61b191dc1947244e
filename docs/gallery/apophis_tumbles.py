# SPDX-License-Identifier: MIT
"""A tumbling asteroid, seen from the Earth

Asteroid Apophis as an ellipsoid with its published moments, periods and pole, every nine hours; the
red dot marks one end of its long axis. It turns about no fixed axis, so that no view repeats. A
telescope sees only the brightness (below). The rotation angles at 0 h are examples.
"""

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

apophis = polhode.Body(0.61, 0.965, 1.0)  # Pravec et al. (2014): I1 : I2 : I3
longitude, latitude = np.radians([250.0, -75.0])  # of the angular momentum, ecliptic
pole = [
    np.cos(latitude) * np.cos(longitude),
    np.cos(latitude) * np.sin(longitude),
    np.sin(latitude),
]
tumbler = polhode.TumblerState(30.56, 263.0, pole, "SAM", phi0=0.0, psi0=0.0)  # h
state = polhode.to_rotor(apophis, tumbler)
motion = polhode.FreeRotation(apophis, state)
moments = np.array(apophis.moments)
axes = np.sqrt(moments.sum() / 2 - moments)  # of a uniform ellipsoid
body = polhode.light.LightModel(polhode.fit.SpinState(state.q, state.g / moments, moments), axes)

toward = np.radians([120.0, 162.0])  # ecliptic longitudes of the Earth and the Sun from Apophis
observer, sun = np.stack([np.cos(toward), np.sin(toward), [0.0, 0.0]], axis=1)
hours = np.arange(0.0, 73.0, 9.0)
fine = np.linspace(0.0, 72.0, 433)
(flux,) = polhode.light.model_fluxes(
    body, polhode.light.LightCurve(fine, np.ones(433), 1.0, sun, observer)
)
magnitude = -2.5 * np.log10(flux / flux.mean())

with figures.style.style():
    figure = plt.figure(figsize=(figures.DOUBLE_COLUMN, 0.4 * figures.DOUBLE_COLUMN))
    grid = figure.add_gridspec(2, hours.size, height_ratios=[1, 1.6], wspace=0.0, hspace=0.05)
    views = [figure.add_subplot(grid[0, k]) for k in range(hours.size)]
    figures.body_as_seen(body, hours, sun, observer, views)
    right = np.cross([0, 0, 1], observer)  # on the observer's sky, where ecliptic north is up
    for view, t in zip(views, hours):
        view.texts[0].remove()  # the arrow to the Sun: the shading shows it
        view.set(title="", xlim=(-1.1, 1.1), ylim=(-1.1, 1.1))
        tip = polhode.charts.attitude_matrix(motion.at(t).q)[0]  # long axis
        if tip @ observer > 0:
            view.plot(tip @ right, tip[2], "o", color=figures.style.VERMILLION, markersize=4,
                      clip_on=False)  # fmt: skip
    light = figure.add_subplot(grid[1, :])
    light.plot(fine, magnitude, **figures.series(0).line)
    seen = np.searchsorted(fine, hours)
    light.plot(hours, magnitude[seen], "o", color=figures.style.BLACK, markersize=3)
    light.set(xlabel="Time (h)", ylabel="Brightness (mag)", xlim=(-4.5, 76.5), xticks=hours)
    light.invert_yaxis()
figures.save(figure, "apophis_tumbles.png")
