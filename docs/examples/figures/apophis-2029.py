# SPDX-License-Identifier: MIT
"""Apophis in 2029: how it tumbles after the encounter, for every attitude that it may have then."""

import math
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
N = 36  # phases each way
CLOSEST = 48.0  # h

scenario = polhode.load(EXAMPLES / "apophis-2029.toml")
motion = scenario.free_rotation
momentum = polhode.charts.inertial_momentum(scenario.initial_state)
pole = momentum / np.linalg.norm(momentum)


def product(a, b):
    """Of two quaternions."""
    vector = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.array([a[0] * b[0] - a[1:] @ b[1:], *vector])


def after(precession, rotation):
    """The free motion and the momentum after the encounter; the phases, parts of a turn of the long
    axis about the pole and of a period P_psi, are those of the free motion when it is closest."""
    along = rotation * motion.polhode_period
    angle = 2 * math.pi * precession - motion.precession_rate_long * along
    turn = np.array([math.cos(angle / 2), *(math.sin(angle / 2) * pole)])
    state = motion.at(along - CLOSEST)
    start = polhode.RotorState(product(turn, np.array(state.q)), state.g)
    problem = polhode.Problem(scenario.system, start, 0.0, 2 * CLOSEST, polhode.Adaptive(1e-9))
    end = polhode.integrate(problem).states[-1]
    return polhode.FreeRotation(scenario.body, end), polhode.charts.inertial_momentum(end)


phases = np.arange(N) / N
rate = np.empty((N, N))
long_axis = np.empty((N, N))
poles = []
for i, precession in enumerate(phases):
    for j, rotation in enumerate(phases):
        end, G = after(precession, rotation)
        rate[j, i] = end.energy / end.momentum * motion.momentum / motion.energy
        long_axis[j, i] = end.regime == polhode.free.Regime.long_axis
        poles.append([math.degrees(math.atan2(G[1], G[0])) % 360,
                      math.degrees(math.asin(G[2] / np.linalg.norm(G)))])

with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.42 * figures.DOUBLE_COLUMN)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, layout="constrained")
    grid = 360 * np.append(phases, 1.0)
    around = lambda table: np.pad(table, ((0, 1), (0, 1)), mode="wrap")  # noqa: E731
    colours = left.contourf(grid, grid, around(rate), levels=np.arange(0.5, 1.75, 0.1))
    left.contour(grid, grid, around(long_axis), levels=[0.5], colors="white", linewidths=1.2)
    figure.colorbar(colours, ax=left, label="effective rate, after / before")
    left.set_xlabel("phase of the precession (deg)")
    left.set_ylabel("phase of the rotation (deg)")
    left.set_xticks([0, 90, 180, 270, 360])
    left.set_yticks([0, 90, 180, 270, 360])
    longitude, latitude = np.array(poles).T
    right.plot(longitude, latitude, ".", markersize=2, color=figures.series(0).line["color"],
               label="after")
    right.plot([250], [-75], "o", color=figures.series(1).line["color"], label="before")
    right.set_xlabel("ecliptic longitude of the pole (deg)")
    right.set_ylabel("ecliptic latitude (deg)")
    right.legend(loc="upper left")
figures.save(figure, "apophis-2029.png")
