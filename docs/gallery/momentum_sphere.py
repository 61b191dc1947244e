# SPDX-License-Identifier: MIT
"""Phase flow on the momentum sphere

The paper's Fig. 1, computed: the angular momentum keeps its length, so in the body it moves on
a sphere, along curves of constant energy. Solid lines circle the axis of greatest moment b3
(short-axis mode), dashed ones the axis of least moment b1 (long-axis mode); the thick
separatrix divides them. Dots: steady rotation, stable (full) and unstable (open). Moments 3,
4 and 6."""

from polhode import Body, figures

ax = figures.momentum_sphere(Body(3.0, 4.0, 6.0))
figures.save(ax, "momentum_sphere.png")
