# SPDX-License-Identifier: MIT
"""A satellite that librates: frequencies, energy, what an elliptic orbit does."""

# %% [markdown]
# # A satellite that librates
#
# The side of a long satellite that is nearer to the Earth is pulled a little more
# than the other. If the satellite points down, this *gravity gradient* holds it
# there: it swings about the vertical like a pendulum, and keeps one face to the
# Earth without fuel. This page builds such a satellite from Python objects,
# measures its swings against theory, runs the same from a file, and then makes the
# orbit elliptic.
#
# Three things are needed: a body, an orbit, and what acts.
# %%
import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

satellite = polhode.Body(
    10.0, 98.0, 100.0
)  # kg m2: vertical, along the track, normal
I1, I2, I3 = satellite.moments
gm, a = 398600.4418, 7178.137  # of the Earth, km3/s2; 800 km above its equator
orbit = polhode.KeplerOrbit(
    polhode.KeplerElements(gm, pericentre=a, eccentricity=0.0)
)
n = orbit.mean_motion  # rad/s
revolution = 2 * np.pi / n  # s
gravity_gradient = polhode.GravityGradient(orbit, gm)
# %% [markdown]
# ## Two angular velocities
#
# A satellite that keeps one face to the Earth turns once per orbit. Whether it
# "turns" depends on who is asked: its gyros say $n$, its camera says 0. Both are
# right, and confusing them is the commonest error of the subject ([a page about
# it](../guide/frames-and-osculation.md)).
#
# The natural axes are those of the orbit: the first up, the second along the track,
# the third normal to the orbit. On a circular orbit they precess evenly, at the
# rate $n$ about the normal. Put this `Frame` into the [`System`][polhode.System],
# and states are relative to it, while their momentum stays that of the whole
# motion; `angular_velocity` gives both answers.
# %%
orbit_axes = polhode.Frame.precessing([0, 0, 1], n)
system = polhode.System(satellite, orbit_axes, [gravity_gradient])

pointing_down = polhode.RotorState(
    [1, 0, 0, 0], [0, 0, I3 * n]
)  # body axes on orbit axes
rates = polhode.angular_velocity(system, 0.0, pointing_down)
print("in units of n:")
print("  gyro:   relative to the stars  ", rates.inertial / n)
print("  camera: relative to the orbit  ", rates.relative / n)
print("torque:", polhode.rates.effect(system, 0.0, pointing_down).u)
# Prints:
#   in units of n:
#     gyro:   relative to the stars   [0. 0. 1.]
#     camera: relative to the orbit   [0. 0. 0.]
#   torque: [0. 0. 0.]
# %% [markdown]
# No relative rate and no torque: pointing down is an equilibrium.
#
# ## Three small swings
#
# For small angles the theory is linear ([DeBra and Delp
# 1961](../references.bib#debra1961)). *Pitch*, about the normal, swings alone, with
# the frequency
#
# $$ \nu_\text{pitch} = n \sqrt{3 (I_2 - I_1) / I_3}. $$
#
# *Roll* (about the track) and *yaw* (about the vertical) are coupled by the turning
# of the frame, and with $k_r = (I_3 - I_1)/I_2$, $k_y = (I_3 - I_2)/I_1$ have the
# two frequencies
#
# $$ \nu_\pm^2 = \frac{n^2}{2} \left( b \pm \sqrt{b^2 - 16 k_r k_y} \right), \qquad
#    b = 1 + 3 k_r + k_r k_y. $$
#
# Roll swings mostly at the faster one, yaw at the slower one.
#
# Are these the frequencies of the full equations? Turn the satellite by a
# ten-thousandth of a radian about each axis, [`integrate`][polhode.integrate] 256
# orbits, and read the frequencies from the spectra of the three angles, which for
# small angles are twice the vector part of the quaternion.
# %%
k_r, k_y = (I3 - I1) / I2, (I3 - I2) / I1
b = 1 + 3 * k_r + k_r * k_y
root = np.sqrt(b**2 - 16 * k_r * k_y)
theory = {
    "pitch": np.sqrt(3 * (I2 - I1) / I3),
    "roll": np.sqrt((b + root) / 2),
    "yaw": np.sqrt((b - root) / 2),
}

per_orbit, samples = 16, 4096
kick = np.array([1, 0.5e-4, 0.5e-4, 0.5e-4])
problem = polhode.Problem(
    system,
    polhode.RotorState(kick / np.linalg.norm(kick), [0, 0, I3 * n]),
    start=0.0,
    stop=samples / per_orbit * revolution,
)
times = polhode.SaveAt.steps(problem.start, problem.stop, revolution / per_orbit)
run = polhode.integrate(problem, times)
yaw, roll, pitch = 2 * run.q[:samples, 1:].T


def frequency(angle):
    """The strongest frequency, from the two highest lines of the spectrum."""
    line = np.abs(np.fft.rfft(angle * np.hanning(samples)))
    k = line.argmax()
    side = 1 if line[k + 1] > line[k - 1] else -1
    ratio = line[k + side] / line[k]
    return (k + side * (2 * ratio - 1) / (ratio + 1)) * per_orbit / samples


print("frequency / n    theory    integrated")
for (name, nu), angle in zip(theory.items(), (pitch, roll, yaw)):
    print(f"{name:15}  {nu:.4f}    {frequency(angle):.4f}")
# Prints:
#   frequency / n    theory    integrated
#   pitch            1.6248    1.6248
#   roll             1.9345    1.9345
#   yaw              0.4431    0.4431
# %%
with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.36 * figures.DOUBLE_COLUMN)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, width_ratios=[3, 2])
    first = slice(0, 8 * per_orbit)
    fine = np.linspace(0, 8 * revolution, 1601)
    angles = np.degrees(2 * run.at(fine).q[:, 1:].T)
    line = np.abs(np.fft.rfft([yaw, roll, pitch] * np.hanning(samples)))
    per_turn = np.arange(line.shape[1]) * per_orbit / samples
    shown = per_turn < 2.5
    for k, name in enumerate(("yaw", "roll", "pitch")):
        left.plot(
            fine / revolution, 1e3 * angles[k], label=name, **figures.series(k).line
        )
        right.semilogy(
            per_turn[shown], line[k, shown] / line.max(), **figures.series(k).line
        )
    for nu in theory.values():
        right.axvline(
            nu, color=figures.style.GREY, linestyle=":", linewidth=0.8, zorder=0
        )
    left.set_xlabel("orbits")
    left.set_ylabel(r"angle ($10^{-3}$ deg)")
    left.margins(x=0)
    left.legend(loc="upper right", ncols=3, bbox_to_anchor=(1.0, 1.13))
    right.set_xlabel("frequency (per orbit)")
    right.set_ylabel("amplitude")
    right.set_ylim(1e-7, 2)
    right.margins(x=0)
figures.save(figure, "libration_swings.png")
# Figure libration_swings.png: Left, the three angles over eight orbits; right,
#   their spectra over 256, with the frequencies of the linear theory (dotted). Yaw
#   and roll share theirs; pitch is alone.
# %% [markdown]
# ## The same from a file
#
# A scenario is the same problem as text, with units: the one below is
# [gravity-gradient-satellite.toml](../../examples/gravity-gradient-satellite.toml)
# without its comments. Its satellite starts 3 degrees off in pitch, at rest
# relative to the orbit. It is described in *inertial* axes; `reference_state` turns
# its states into those of our `system`.
# %%
scenario = polhode.Scenario.from_text("""\
schema = 1
title = "A gravity-gradient satellite, 800 km up"

[units]
time = "s"
angle = "deg"
moment = "kg m2"
length = "km"

[body]
moments = [10.0, 98.0, 100.0]

[state.attitude-rate]
euler = { phi = 3, theta = 0, psi = 0 }
omega_inertial = [0, 0, 0.059480403488]

[orbit.earth]
gm = "398600.4418 km3/s2"
semi_major_axis = 7178.137

[[perturbation]]
kind = "gravity-gradient"
orbit = "earth"

[time]
stop = "10 d"
step = 60

[output]
columns = ["q", "omega", "euler", "energy"]
""")
results = scenario.with_columns(["q", "g", "energy"]).run()
relative = polhode.charts.reference_state(system, results.t, results.states)
swing = np.degrees(2 * np.arctan2(relative.q[:, 3], relative.q[:, 0]))
print(
    f"{len(results.t)} rows, pitch from {swing.min():.4f} to {swing.max():.4f} deg"
)
# Prints:
#   14401 rows, pitch from -3.0000 to 3.0000 deg
# %% [markdown]
# Now the swing is finite. The torque goes like $\sin 2\theta$, so that $2\theta$ is
# the angle of a pendulum, and a swing to $\theta$ is slower than the linear theory
# says: its period is longer by the factor $\frac{2}{\pi} K(\sin\theta)$, which is
# one over the arithmetic-geometric mean of 1 and $\cos\theta$. An
# [`Event`][polhode.Event] finds every passage through the vertical to rounding, so
# that this can be tried to many digits.
# %%
start = polhode.charts.reference_state(system, 0.0, scenario.initial_state)
level = polhode.Event("level", lambda t, s: s.q[3], crossing="rising")
problem = polhode.Problem(system, start, 0.0, 10 * 86400.0, events=[level])
passages = np.array([event.t for event in polhode.integrate(problem).events])
measured = np.diff(passages).mean()

linear = revolution / theory["pitch"]
x, y = 1.0, np.cos(np.radians(3))
while abs(x - y) > 1e-15:
    x, y = (x + y) / 2, np.sqrt(x * y)
print(f"linear theory           {linear:.6f} s")
print(f"swing to 3 degrees      {linear / x:.6f} s")
print(f"mean of {len(passages) - 1} swings      {measured:.6f} s")
# Prints:
#   linear theory           3725.003039 s
#   swing to 3 degrees      3727.557721 s
#   mean of 231 swings      3727.557721 s
# %% [markdown]
# ## What is constant
#
# In the orbit axes nothing depends on time, so there the energy of the system is
# constant, a Jacobi integral: kinetic energy, plus potential, less $n g_3$ for the
# turning of the frame. In inertial axes the Earth goes round, and the energy of the
# same motion is not constant, nor should it be. The first is a test of the
# integrator, the second is not.
# %%
in_orbit_axes = polhode.energy(system, results.t, relative)
in_inertial_axes = results["E"]
for name, E in (("orbit axes", in_orbit_axes), ("inertial axes", in_inertial_axes)):
    spread = np.ptp(E) / np.abs(in_orbit_axes).max()
    said = "constant to 1e-12" if spread < 1e-12 else f"varies by {spread:.1e}"
    print(f"energy in {name:14} {said}")
# Prints:
#   energy in orbit axes     constant to 1e-12
#   energy in inertial axes  varies by 1.2e-01
# %% [markdown]
# ## An elliptic orbit
#
# On an ellipse the vertical does not turn evenly, and the satellite cannot follow:
# it is driven once per orbit. For a small eccentricity $e$ linear theory gives a
# forced pitch of amplitude $2 e / (\kappa - 1)$, with $\kappa = 3 (I_2 - I_1)/I_3$,
# which passes 0 at pericentre, where its rate is that amplitude times $n$. What
# else is there? Look once per orbit, at pericentre: there the orbit axes are
# inertial axes 1, 2, 3, and every motion in the plane is a point (pitch, rate).
# This is a Poincare section of a driven pendulum.
# %%
e = 0.05
ellipse = polhode.KeplerOrbit(
    polhode.KeplerElements(gm, pericentre=a * (1 - e), eccentricity=e)
)
driven = polhode.System(satellite, terms=[polhode.GravityGradient(ellipse, gm)])
at_pericentre = n * np.sqrt((1 + e) / (1 - e) ** 3)  # rate of the vertical there


def released(rate):
    """Upright at pericentre, with this rate relative to the orbit (unit n)."""
    return polhode.RotorState([1, 0, 0, 0], [0, 0, I3 * (at_pericentre + rate * n)])


def followed(rate, orbits, per_orbit):
    """The run from there, with samples from pericentre to pericentre."""
    stop = orbits * revolution
    problem = polhode.Problem(
        driven, released(rate), 0.0, stop, polhode.Adaptive(1e-10)
    )
    times = polhode.SaveAt.steps(0.0, stop, revolution / per_orbit)
    return polhode.integrate(problem, times, dense=False)


def off_vertical(run):
    """The angle of the long axis from the vertical (rad), of a run."""
    up = ellipse.position(run.t)
    long_axis = polhode.charts.attitude_matrix(run.q)[:, 0]
    return np.arctan2(np.cross(up, long_axis)[:, 2], (up * long_axis).sum(axis=1))


kappa = 3 * (I2 - I1) / I3
forced = followed(2 * e / (kappa - 1), orbits=20, per_orbit=50)
print(f"forced pitch: theory {np.degrees(2 * e / (kappa - 1)):.2f} deg,", end="")
print(f" integrated {np.degrees(np.abs(off_vertical(forced)).max()):.2f} deg")
# Prints:
#   forced pitch: theory 3.49 deg, integrated 3.52 deg
# %%
rates = np.arange(0.06, 2.0, 0.1)
runs = [followed(rate, orbits=600, per_orbit=8) for rate in rates]
turns_over = np.array([np.abs(off_vertical(run)).max() > np.pi / 2 for run in runs])
print(f"{np.sum(~turns_over)} of {len(runs)} librate, from rates up to", end="")
print(f" {rates[~turns_over].max():.2f} n; sqrt(kappa) = {np.sqrt(kappa):.2f}")


# Prints:
#   15 of 20 librate, from rates up to 1.46 n; sqrt(kappa) = 1.62
# %%
def pitch_at(states):
    """Pitch (deg) between -90 and 90: the long axis has no sign."""
    return (
        np.degrees(2 * np.arctan2(states.q[:, 3], states.q[:, 0])) + 90
    ) % 180 - 90


def rate_at(states):
    return (states.g[:, 2] / I3 - at_pericentre) / n


kinds = {
    "librates": (~turns_over, figures.style.BLACK),
    "turns over": (turns_over, figures.style.VERMILLION),
}
ax = None
for name, (kind, color) in kinds.items():
    states = [run.states[::8] for run, shown in zip(runs, kind) if shown]
    ax = figures.poincare_section(
        states, pitch_at, rate_at, ax=ax, label=name, color=color
    )
with figures.style.style():
    ax.set_xlim(-90, 90)
    ax.set_xticks([-90, -45, 0, 45, 90])
    ax.set_xlabel("pitch at pericentre (deg)")
    ax.set_ylabel("rate at pericentre, relative ($n$)")
figures.save(ax, "libration_section.png")
# Figure libration_section.png: Pitch at pericentre on an orbit of eccentricity
#   0.05, once per orbit for 600 orbits. The centre is the forced pitch, smooth
#   curves and islands of resonance lie around it, and a sea where the circular
#   orbit has its separatrix.
# %% [markdown]
# On a circular orbit every curve would be closed or go round, and between the two
# would be a sharp separatrix, at the rate $\sqrt{\kappa}\, n$ above. The ellipse
# dissolves it into a chaotic sea: a satellite released with too large a swing turns
# over, now or after years, and no formula says when. The smooth curves around the
# forced pitch are the safe side.
#
# Next: which shapes are stable at all, in [satellite
# stability](../guide/satellite-stability.md); which integrator for how long, in
# [which propagator](../guide/which-propagator.md); terms of your own, such as a
# damper, in [perturbations](../../python/polhode).
