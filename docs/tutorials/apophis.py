# SPDX-License-Identifier: MIT
"""Apophis: from published periods to its attitude years later, and its error."""

# %% [markdown]
# # Apophis tumbles
#
# The asteroid (99942) Apophis does not spin about one axis: it tumbles, and nothing
# but sunlight acts on it until it passes the Earth in April 2029. What observers
# publish about such a body is periods and a direction. This page makes a complete
# state of them, looks at the body as a telescope does to see that each period is
# that of the right axis, and follows it for years; then it asks how much of the
# answer is known.
#
# What [Pravec et al. (2014)](../references.bib#pravec2014) found: the ratios of the
# moments of inertia to the greatest, a precession period $P_\phi$ and a rotation
# period $P_\psi$, the direction of the angular momentum (the *pole*), and that
# Apophis is in *short-axis mode* (SAM): seen from the body, the momentum circles
# about the axis of the greatest moment, which is the short axis of the body. The
# light curve is strongest at twice the frequency of a third period, $P_1$. Two more
# of their numbers are kept apart, as tests: $E/E_0$, the energy over the least
# energy with this momentum, and the angle of the short axis to the momentum.
# %%
from statistics import NormalDist

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

apophis = polhode.Body(0.61, 0.965, 1.0)  # I1 : I2 : I3, long : middle : short axis
P_phi, P_psi = 27.38, 263.0  # h
longitude, latitude = np.radians([250.0, -75.0])  # of the pole, ecliptic
pole = [
    np.cos(latitude) * np.cos(longitude),
    np.cos(latitude) * np.sin(longitude),
    np.sin(latitude),
]
P_1 = 30.56  # h
published_ratio = 1.024  # to 0.013
# %% [markdown]
# ## Which axis precesses in 27.38 hours?
#
# A tumbling body has no single precession period. Its short axis goes round the
# momentum, and so does its long axis, but not at the same mean rate: while they do,
# the body rolls once in $P_\psi$, and in SAM
#
# $$ \frac{1}{P_\text{short}} = \frac{1}{P_\text{long}} + \frac{1}{P_\psi}. $$
#
# Authors write $P_\phi$ for either. [`TumblerState`][polhode.TumblerState] takes
# that of the *long* axis ([its convention](../guide/tumblers.md)). The period
# $P_\phi$ of Pravec et al. is that of the *short* axis, and the long axis, which
# needs longer, goes round in their $P_1$. So $P_1$ goes in, as in the scenario
# [apophis.toml](../../examples/apophis.toml), and $P_\phi$ has to come out.
#
# To see what is at stake, make the motion of the other reading, too: had the
# published $P_\phi$ been that of the long axis. Each reading is one motion, which
# has an energy and a range of angles.


# %%
def tumbling(long_axis_period):
    """The motion with this period of the long axis (h); phases 0 at t = 0."""
    state = polhode.TumblerState(
        long_axis_period, P_psi, pole, polhode.free.Regime.short_axis,
        phi0=0.0, psi0=0.0,
    )
    return polhode.FreeRotation(apophis, polhode.to_rotor(apophis, state))


def short_axis_angle(motion):
    """Least and greatest angle of the short axis to the momentum (deg)."""
    g = motion.at(np.linspace(0, P_psi, 2001)).g / motion.momentum  # body axes
    angle = np.degrees(np.arccos(g[:, 2]))
    return angle.min(), angle.max()


motion, other = tumbling(P_1), tumbling(P_phi)
print("               P_long     P_short     E/E0    short axis to momentum")
for name, m in (("P_1 long", motion), ("P_phi long", other)):
    P_long = 2 * np.pi / m.precession_rate_long
    P_short = 2 * np.pi / m.precession_rate_short
    ratio = m.energy / (m.momentum**2 / 2)  # I3 = 1
    least, most = short_axis_angle(m)
    print(f"{name:12} {P_long:6.2f} h   {P_short:6.2f} h   {ratio:.4f}", end="")
    print(f"    {least:.1f} to {most:.1f} deg")
print(f"published {P_1:9} h {P_phi:8} h   {published_ratio}")
# Prints:
#                  P_long     P_short     E/E0    short axis to momentum
#   P_1 long      30.56 h    27.38 h   1.0236    11.1 to 53.8 deg
#   P_phi long    27.38 h    24.80 h   1.0285    12.2 to 62.5 deg
#   published     30.56 h    27.38 h   1.024
# %% [markdown]
# With $P_1$ for the long axis, the short one precesses in the published 27.38 h,
# and the energy is the published 1.024. The energy of the other reading is off, if
# within the published error. The light curve leaves no choice: it shows mostly the
# long axis, for twice per turn the body is seen end on and is faint.
#
# ## What the telescope sees
#
# A uniform ellipsoid with these moments has semi-axes $a, b, c$ with
# $I_1 \propto b^2 + c^2$, and so on. Seen near opposition, from the direction $e$
# (a unit vector in body axes), the sunlit part is a disc of area
# $\pi \sqrt{b^2 c^2 e_1^2 + c^2 a^2 e_2^2 + a^2 b^2 e_3^2}$. Taking the brightness
# proportional to it is crude, but no better law moves a frequency.
#
# [`at`][polhode.FreeRotation] takes all times at once; `attitude_matrix` turns
# inertial components into body components. The observer is in the ecliptic, at
# longitude 120 degrees.
# %%
I1, I2, I3 = apophis.moments
axes2 = np.array([I2 + I3 - I1, I3 + I1 - I2, I1 + I2 - I3]) / 2  # a^2, b^2, c^2
observer = np.array([np.cos(np.radians(120)), np.sin(np.radians(120)), 0.0])
t = np.arange(0.0, 60 * P_psi, 0.5)


def magnitudes(motion):
    """Magnitudes at the times t, the mean of all set to 0."""
    e = polhode.charts.attitude_matrix(motion.at(t).q) @ observer
    area = np.sqrt(np.prod(axes2) * (e**2 / axes2).sum(axis=-1))
    mag = -2.5 * np.log10(area)
    return mag - mag.mean()


def spectrum(mag):
    """Frequencies (1/h) and relative amplitudes."""
    amplitude = np.abs(np.fft.rfft(mag * np.hanning(mag.size), 8 * mag.size))
    return np.fft.rfftfreq(8 * mag.size, t[1] - t[0]), amplitude / amplitude.max()


a, b, c = np.sqrt(axes2 / axes2[2])
print(f"a : b : c = {a:.2f} : {b:.2f} : {c:.0f}")
for name, m in (("P_1 long", motion), ("P_phi long", other)):
    mag = magnitudes(m)
    f, amplitude = spectrum(mag)
    strongest = f[amplitude.argmax()]
    print(f"{name:12} strongest at 2 / {2 / strongest:.2f} h,", end="")
    print(f" range {np.ptp(mag):.2f} mag")
# Prints:
#   a : b : c = 1.54 : 1.06 : 1
#   P_1 long     strongest at 2 / 30.56 h, range 0.45 mag
#   P_phi long   strongest at 2 / 27.38 h, range 0.46 mag
# %%
mag = magnitudes(motion)
f, amplitude = spectrum(mag)
with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.36 * figures.DOUBLE_COLUMN)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, width_ratios=[3, 2])
    first = t <= P_psi
    left.plot(t[first], mag[first], **figures.series(0).line)
    left.invert_yaxis()
    left.set_xlabel("$t$ (h)")
    left.set_ylabel("magnitude, mean 0")
    left.margins(x=0)
    shown = (f > 0) & (f < 0.1)
    right.plot(f[shown], amplitude[shown], **figures.series(0).line)
    for period, name in ((P_1, "$2/P_1$"), (P_phi, r"$2/P_\phi$")):
        right.axvline(
            2 / period,
            color=figures.style.GREY,
            linestyle=":",
            linewidth=0.8,
            zorder=0,
        )
        side = "right" if period == P_1 else "left"
        right.annotate(
            f" {name} ",
            (2 / period, 1.0),
            va="top",
            ha=side,
            color=figures.style.GREY,
        )
    right.set_xlabel("frequency (1/h)")
    right.set_ylabel("amplitude")
    right.set_ylim(0, 1.08)
    right.margins(x=0)
figures.save(figure, "apophis_light.png")
# Figure apophis_light.png: The light curve of the ellipsoid over one $P_\psi$, and
#   its spectrum over sixty.
# %% [markdown]
# The strongest frequency is twice that of the long axis in either motion. Observed
# is $2/P_1$, so the long axis is the one with $P_1$.
#
# ## The state, and the motion through it
#
# The motion is now complete but for two phases, $\phi$ of the long axis about the
# pole and $\psi$ of the roll, here set to 0 at $t = 0$. In SAM $\psi$ does not go
# round: it swings between $\pm\psi_\text{max}$. Seen from the body, the momentum
# draws a closed curve about the short axis in a time $P_\psi$, the *polhode
# period*.
# %%
g = motion.at(np.linspace(0, P_psi, 2001)).g / motion.momentum  # body axes
long_axis = np.degrees(np.arccos(g[:, 0]))
print(f"mode            {motion.regime.name}")
print(f"polhode period  {motion.polhode_period:.6f} h")
print(f"psi_max         {np.degrees(polhode.free.psi_max(motion)):.2f} deg")
print(f"long axis       {long_axis.min():.1f} to {long_axis.max():.1f} deg", end="")
print(" from the momentum")
m = motion.modulus
print(f"elliptic modulus: m = {m.m:.4f}, 1 - m = {m.m1:.4f}")
# Prints:
#   mode            short_axis
#   polhode period  263.000000 h
#   psi_max         53.84 deg
#   long axis       78.9 to 101.1 deg from the momentum
#   elliptic modulus: m = 0.6384, 1 - m = 0.3616
# %% [markdown]
# The short axis nods by tens of degrees, slowly; the long axis sweeps nearly across
# the momentum. The modulus says how far the motion is from the separatrix, where
# $1 - m$ vanishes and the swing would never end ([the wing nut](dzhanibekov.py)
# goes there).
#
# ## Sixteen years later
#
# Free rotation is known in closed form, so a state years later costs what a state
# tomorrow costs, and has no accumulated error. Where does the long axis point on
# the eve of the encounter of 2029, 16 years after the epoch (where the phases are
# set to 0)? The rows of the attitude matrix are the body axes in inertial
# components, here ecliptic ones; the first is the long axis.
# %%
epoch = np.datetime64("2013-01-05T00:00")
dates = np.array(
    ["2013-01-06T00:00", "2021-03-06T00:00", "2029-04-12T21:46"], dtype="datetime64"
)
hours = (dates - epoch) / np.timedelta64(1, "h")
states = motion.at(hours)
for date, x in zip(dates, polhode.charts.attitude_matrix(states.q)[:, 0]):
    lon, lat = np.degrees([np.arctan2(x[1], x[0]), np.arcsin(x[2])])
    print(f"{date}  long axis at longitude {lon:7.2f}, latitude {lat:6.2f} deg")

halfway = polhode.FreeRotation(apophis, motion.at(hours[2] / 2), t0=hours[2] / 2)
gap = np.abs(halfway.at(hours[2]).q - states[2].q).max()
print("stopped halfway and begun again: the same to 1e-11:", gap < 1e-11)
# Prints:
#   2013-01-06T00:00  long axis at longitude -119.95, latitude   6.26 deg
#   2021-03-06T00:00  long axis at longitude -155.38, latitude   3.59 deg
#   2029-04-12T21:46  long axis at longitude    8.72, latitude  -8.57 deg
#   stopped halfway and begun again: the same to 1e-11: True
# %% [markdown]
# ## How much of that is known?
#
# The formula is exact; the periods that went in are not. Pravec et al. give
# $P_1 = 30.56 \pm 0.01$ h and $P_\psi = 263 \pm 6$ h, three standard deviations
# each. Take 64 values of each, at equal steps of probability, and all pairs of
# them: 4096 bodies. They are one `TumblerState` of shape (64, 64), and one call
# makes their states.
#
# To follow them all at once, use a chart whose numbers do not change: Serret's
# elements ([charts](../guide/charts.md)) belong to a motion, and
# `to_rotor(body, elements, t)` is its state at any $t$.
# %%
sigma = np.array([NormalDist().inv_cdf((k + 0.5) / 64) for k in range(64)])
periods_long, periods_psi = P_1 + 0.01 / 3 * sigma[:, None], P_psi + 6 / 3 * sigma
published = polhode.TumblerState(
    periods_long, periods_psi, pole, polhode.free.Regime.short_axis,
    phi0=0.0, psi0=0.0,
)
ensemble = polhode.to_rotor(apophis, published)
elements = polhode.to_serret(apophis, ensemble)
G = elements.G
print(f"states {ensemble.shape}, momentum {G.min():.5f} to {G.max():.5f}")
# Prints:
#   states (64, 64), momentum 0.20270 to 0.20307
# %% [markdown]
# A second way needs no ensemble. [`state_transition`][polhode.FreeRotation] is the
# exact derivative $M(t)$ of the state with respect to that at the epoch: small
# changes $\delta\theta$ of the attitude (three angles about the body axes) and
# $\delta g$ of the momentum. A covariance $C$ at the epoch becomes $M C M^T$. It is
# right while errors are small; the ensemble says when they cease to be.
#
# Two questions differ here: where the long axis points, and the whole attitude.
# %%
def errors(t):
    """Of the ensemble at time t: of the attitudes, of the long axes (rad)."""
    now, there = polhode.to_rotor(apophis, elements, t), motion.at(t)
    attitude = 2 * np.arccos(np.minimum(1, np.abs(now.q @ there.q)))
    x, x0 = (polhode.charts.attitude_matrix(s.q)[..., 0, :] for s in (now, there))
    return attitude, np.arccos(np.clip(x @ x0, -1, 1))


# The covariance at the epoch, about the nominal state. When the body turns by a
# small angle, components in its axes turn the other way.
turned = (
    polhode.charts.attitude_matrix(ensemble.q)
    @ polhode.charts.attitude_matrix(motion.initial_state.q).T
)
turned = (turned - turned.swapaxes(-1, -2)) / 2
delta = np.stack([turned[..., 1, 2], turned[..., 2, 0], turned[..., 0, 1]], axis=-1)
delta = np.concatenate(
    [delta, ensemble.g - motion.initial_state.g], axis=-1
).reshape(-1, 6)
C = delta.T @ delta / len(delta)


def predicted(days):
    """The same by M C M^T: r.m.s. of attitude and long axis (deg) at these days."""
    M = motion.state_transition(24.0 * days)
    variance = np.diagonal(M @ C @ M.swapaxes(-1, -2), axis1=-2, axis2=-1)
    return np.degrees(
        [np.sqrt(variance[:, :3].sum(-1)), np.sqrt(variance[:, 1:3].sum(-1))]
    )


days = np.array([1, 3, 10, 30, 100, 365])
linear = predicted(days)
true = np.degrees(
    [[np.sqrt(np.mean(e**2)) for e in errors(24.0 * day)] for day in days]
).T

print("        whole attitude (deg)    long axis (deg)")
print("days    linear  ensemble        linear  ensemble")
for k, day in enumerate(days):
    print(f"{day:4}  {linear[0, k]:8.2f}  {true[0, k]:8.2f}", end="")
    print(f"      {linear[1, k]:8.2f}  {true[1, k]:8.2f}")
# Prints:
#           whole attitude (deg)    long axis (deg)
#   days    linear  ensemble        linear  ensemble
#      1      0.28      0.28          0.11      0.11
#      3      0.78      0.78          0.15      0.15
#     10      2.47      2.46          0.44      0.44
#     30      1.58      1.70          1.56      1.56
#    100     15.68     16.33          4.85      4.69
#    365     32.51     53.06         18.71     13.68
# %%
all_days = np.geomspace(1, 365, 4000)
with figures.style.style():
    figure, ax = plt.subplots(
        figsize=(figures.SINGLE_COLUMN, 0.75 * figures.SINGLE_COLUMN)
    )
    for k, name in enumerate(("whole attitude", "long axis")):
        look = figures.series(k)
        thin = {**look.line, "linewidth": 0.7}
        ax.loglog(
            all_days, predicted(all_days)[k], **thin, label=f"{name}, $M C M^T$"
        )
        ax.loglog(
            days,
            true[k],
            **look.point,
            markeredgecolor="white",
            label="4096 states",
        )
    ax.set_xlabel("days after the epoch")
    ax.set_ylabel("r.m.s. error (deg)")
    ax.legend()
figures.save(figure, "apophis_errors.png")
# Figure apophis_errors.png: How the published errors of the periods grow into
#   errors of the prediction.
# %% [markdown]
# The two ways agree for three months; then angles cease to be small. The error of
# the whole attitude swings with the body: an error of $P_\psi$ shows where $\psi$
# moves fast and hides where it turns back. After a year the roll is lost, but the
# long axis is still known to 14 degrees, because $P_1$, which the light curve gave
# with four digits, is its period. A prediction for 2029 needs later light curves
# than those of 2013; a fit to them takes the derivatives from `state_transition`.
#
# Next: [a body that flips](dzhanibekov.py), [one that is held](libration.py), the
# guide on [tumblers](../guide/tumblers.md), and the scenario
# [apophis.toml](../../examples/apophis.toml) for the command line.
