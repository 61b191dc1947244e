# SPDX-License-Identifier: MIT
"""The body in space

The homogeneous ellipsoid and the box with the moments of a body, in the attitude of one state,
with the body axes and the directions of momentum and angular velocity. What the body hides is
pale."""

from matplotlib import pyplot as plt
from polhode import Body, figures, rotor_state
from polhode.charts import EulerAngles, attitude

body = Body(3.0, 5.0, 6.5)
q = attitude(EulerAngles(phi=0.2, theta=0.5, psi=0.1))
state = rotor_state(body, q, omega_B=[0.1, -0.6, 0.7])
figure, axes = plt.subplots(1, 2, figsize=(figures.DOUBLE_COLUMN, 2.9), layout="constrained")
for ax, shape in zip(axes, ("ellipsoid", "box")):
    figures.attitude_of_body(state, body, shape, ax=ax)
figures.save(figure, "attitude_of_body.png")
