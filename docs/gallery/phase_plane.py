# SPDX-License-Identifier: MIT
"""The phase plane of l and L

The paper's Fig. 4, computed: curves of equal energy of a free body in Andoyer's l and L, with
the separatrix through the unstable rotation about b2; the long-axis mode is shaded. Where L =
G, all l are one state. Moments 3, 4 and 6."""

from polhode import Body, figures

ax = figures.phase_plane(Body(3.0, 4.0, 6.0))
figures.save(ax, "phase_plane.png")
