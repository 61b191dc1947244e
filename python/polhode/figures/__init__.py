# SPDX-License-Identifier: MIT
"""Figures of rotating bodies, for print; needs matplotlib (`pip install polhode[figures]`).

Each function takes data, and `ax=None`: Axes to draw on, or None for a new figure. It returns the
Axes, shows nothing, and leaves matplotlib's settings alone. `save(axes, path)` writes the figure at
print size and resolution; `style` is the module with the colours and looks."""

from polhode.figures import style
from polhode.figures.animation import animation
from polhode.figures.attitude import BodyPicture, attitude_of_body
from polhode.figures.body_as_seen import body_as_seen
from polhode.figures.chaos import chaos_growth, chaos_map
from polhode.figures.corner_plot import corner_plot
from polhode.figures.ellipses import orbit_ellipses
from polhode.figures.energy_error import energy_error
from polhode.figures.ensembles import outcomes, quantile_fan, regime_fractions
from polhode.figures.frames import frames_and_angles
from polhode.figures.landscape import scan_landscape
from polhode.figures.light_curves import light_curve_fit
from polhode.figures.momentum_sphere import momentum_sphere
from polhode.figures.oblate_planet import OblatePlanet
from polhode.figures.overview import overview
from polhode.figures.phase_plane import phase_plane
from polhode.figures.plot import plot
from polhode.figures.pole_cloud import pole_cloud
from polhode.figures.pole_sky import pole_sky
from polhode.figures.polhode_curves import (
    herpolhode,
    polhode_and_herpolhode,
    polhode_on_ellipsoid,
)
from polhode.figures.run_data import RunData
from polhode.figures.section import poincare_section
from polhode.figures.style import DOUBLE_COLUMN, SINGLE_COLUMN, Look, regime_look, save, series
from polhode.figures.time_series import time_series
from polhode.figures.view import View

__all__ = [
    "BodyPicture",
    "DOUBLE_COLUMN",
    "Look",
    "OblatePlanet",
    "RunData",
    "SINGLE_COLUMN",
    "View",
    "animation",
    "attitude_of_body",
    "body_as_seen",
    "chaos_growth",
    "chaos_map",
    "corner_plot",
    "energy_error",
    "frames_and_angles",
    "herpolhode",
    "light_curve_fit",
    "momentum_sphere",
    "orbit_ellipses",
    "outcomes",
    "overview",
    "phase_plane",
    "plot",
    "poincare_section",
    "pole_cloud",
    "pole_sky",
    "polhode_and_herpolhode",
    "polhode_on_ellipsoid",
    "quantile_fan",
    "regime_fractions",
    "regime_look",
    "save",
    "scan_landscape",
    "series",
    "style",
    "time_series",
]
