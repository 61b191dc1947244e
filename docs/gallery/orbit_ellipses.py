# SPDX-License-Identifier: MIT
"""A perturbed orbit of ellipses that cut it, and of ellipses that touch it

The paper's Figs. 5 and 6, computed: one orbit of a satellite of a precessing oblate planet, in
the frame of its equator of date. Left: the ellipses of the canonical (Delaunay) elements are
non-osculating. The Keplerian velocity **g** along them is the velocity relative to *inertial*
axes, the orbit's is r' = **g** - mu x r. Right: the ellipses of the osculating elements touch
the orbit, and r' = **g**. To be seen, the precession is exaggerated beyond any planet's: the
frame turns by 0.2 rad while a satellite at distance 1 moves by 1 rad (obliquity 25 degrees),
with J2 R^2 = 0.01. For the Earth and a close satellite the former is below 1e-8."""

from matplotlib import pyplot as plt
from polhode import figures

figure, axes = plt.subplots(1, 2, figsize=(figures.DOUBLE_COLUMN, 3.2), layout="constrained")
figures.orbit_ellipses(osculating=False, ax=axes[0])
figures.orbit_ellipses(osculating=True, ax=axes[1])
figures.save(figure, "orbit_ellipses.png")
