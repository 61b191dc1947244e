# SPDX-License-Identifier: MIT
"""The wing nut of Dzhanibekov: why it flips, when next, what ruins a simulation."""

# %% [markdown]
# # The wing nut and the separatrix
#
# In 1985 the cosmonaut Vladimir Dzhanibekov spun a wing nut off its bolt. It flew
# on, spinning, and after some turns flipped over, spun on, and flipped back, again
# and again. Tennis rackets do the same ([Ashbaugh et al.
# 1991](../references.bib#ashbaugh1991)). This page says why, when exactly the next
# flip is, how long the nut can be made to wait, and why this harmless looking
# motion breaks integrators.
#
# Our nut is a brass plate with the moments of inertia of
# [wing-nut.toml](../../examples/wing-nut.toml). It turns once per second about the
# axis of the *intermediate* moment $I_2$, but for an error: its angular momentum is
# off that axis by a small angle $\varepsilon$, the *tilt*. Time is in seconds.
# %%
import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

nut = polhode.Body(30.53, 83.87, 113.3)  # g cm2
I1, I2, I3 = nut.moments
omega = 2 * np.pi  # rad/s


def thrown(tilt, direction=0.0):
    """Momentum off axis 2 by a tilt (rad), towards axis 1, or axis 3 for pi/2."""
    g = [
        np.sin(tilt) * np.cos(direction),
        np.cos(tilt),
        np.sin(tilt) * np.sin(direction),
    ]
    return polhode.RotorState([1, 0, 0, 0], I2 * omega * np.array(g))


motion = polhode.FreeRotation(nut, thrown(np.radians(0.1)))
print(
    f"{motion.regime.name}, repeats in the body after {motion.polhode_period:.6f} s"
)
# Prints:
#   long_axis, repeats in the body after 6.345538 s
# %% [markdown]
# ## Why it flips
#
# In space the momentum stands still. Seen from the body it moves: with $g$ its body
# components, Euler's equations are $\dot g = g \times I^{-1} g$, and they keep two
# things, the length $G$ of $g$ and the energy $T = \frac{1}{2} \sum g_k^2 / I_k$.
# So the tip of $g$ draws the curve in which a sphere and an ellipsoid cross: a
# *polhode*. About the axes of the greatest and the least moment polhodes are small
# closed curves, so that spin there is stable. At axis 2 they cross like the lines
# of an X: near it
#
# $$ \dot g_1 = \omega \left(\frac{I_2}{I_3} - 1\right) g_3, \qquad
#    \dot g_3 = \omega \left(1 - \frac{I_2}{I_1}\right) g_1, $$
#
# and both components grow like $e^{\lambda t}$ with
# $\lambda = \omega \sqrt{(I_2 - I_1)(I_3 - I_2) / (I_1 I_3)}$. The momentum leaves
# along one arm of the X, runs round to the other side of the body, and arrives at
# the *negative* axis 2. As it is fixed in space, it is the body that has turned
# over.
# %%
rate = omega * np.sqrt((I2 - I1) * (I3 - I2) / (I1 * I3))
print(
    f"lambda = {rate:.4f} / s: a tilt grows tenfold every {np.log(10) / rate:.3f} s"
)
# Prints:
#   lambda = 4.2328 / s: a tilt grows tenfold every 0.544 s
# %%
t = np.linspace(0.0, 16.0, 3001)
g = motion.at(t).g / motion.momentum
size = (figures.DOUBLE_COLUMN, 0.42 * figures.DOUBLE_COLUMN)
with figures.style.style():
    figure, (left, right) = plt.subplots(1, 2, figsize=size, width_ratios=[2, 3])
    figures.momentum_sphere(nut, trace=g, short_axis=3, long_axis=3, ax=left)
    for k in range(3):
        right.plot(t, g[:, k], label=f"$g_{k + 1}/G$", **figures.series(k).line)
    right.set_xlabel("$t$ (s)")
    right.set_ylabel("momentum in the body")
    right.margins(x=0)
    right.legend(loc="upper right", ncols=3, bbox_to_anchor=(1.0, 1.12))
figures.save(figure, "dzhanibekov_flips.png")
# Figure dzhanibekov_flips.png: The momentum in the body. Left, its polhode on the
#   sphere $|g| = G$, close to the separatrix; right, its components: most of the
#   time the nut spins about axis 2.
# %% [markdown]
# ## When does it flip next?
#
# A flip is the moment at which $g_2 = 0$. There is no need to search for it:
# Sadov's angle variable $\phi_l$ ([variable sets](../guide/charts.md)) moves at an
# even rate $n_l$, goes round once in a polhode period, and $g_2$ vanishes where
# $\phi_l$ is a multiple of $\pi$. So each flip is a division, the millionth like
# the first, and flips are half a polhode period apart.
# %%
n = polhode.free.sadov_frequencies(motion).n_l  # rad/s
phi = polhode.to_sadov(motion, 0.0).phi_l
phi *= np.sign(n)  # counted along the motion
number = np.array([1, 2, 3, 4, 1_000_000])
flips = ((np.floor(phi / np.pi) + number) * np.pi - phi) / abs(n)
at_flip = motion.at(flips)
for k, time, miss in zip(number, flips, np.abs(at_flip.g[:, 1]) / motion.momentum):
    print(f"flip {k:8} at {time:18.6f} s, |g_2|/G below 1e-8: {miss < 1e-8}")
print(f"half a polhode period     {motion.polhode_period / 2:.6f} s")
# Prints:
#   flip        1 at           1.586385 s, |g_2|/G below 1e-8: True
#   flip        2 at           4.759154 s, |g_2|/G below 1e-8: True
#   flip        3 at           7.931923 s, |g_2|/G below 1e-8: True
#   flip        4 at          11.104692 s, |g_2|/G below 1e-8: True
#   flip  1000000 at     3172767.499223 s, |g_2|/G below 1e-8: True
#   half a polhode period     3.172769 s
# %% [markdown]
# ## How long can it be made to wait?
#
# Throw the nut more carefully. With half the tilt it takes longer to leave axis 2,
# but only by $\ln 2 / \lambda$, and as much again to arrive: a thousandfold care
# buys no more than $2 \ln 1000 / \lambda$. In the closed form this is the logarithm
# in the complete elliptic integral, $K \approx \ln(4 / \sqrt{1 - m})$: half a
# period is $2K/\mu$, with a rate $\mu$ that tends to $\lambda$ and a complement
# $1 - m$ of the modulus that goes like $\varepsilon^2$.
#
# `FreeRotation` gets $1 - m$ from products, never by subtracting from 1, so that a
# tilt is not lost in rounding: the formula goes on far below what any hand or any
# atom can do.
# %%
tilts = np.array([1e-1, 1e-2, 1e-3, 1e-6, 1e-9, 1e-12, 1e-50, 1e-100])
halves = np.array(
    [polhode.FreeRotation(nut, thrown(x)).polhode_period / 2 for x in tilts]
)
for tilt, half in zip(tilts, halves):
    print(f"tilt {tilt:6.0e} rad: a flip every {half:10.4f} s")
slope = (halves[-1] - halves[-2]) / 50
print(f"for each factor of ten   {slope:.6f} s more")
print(f"2 ln(10) / lambda        {2 * np.log(10) / rate:.6f} s")
# Prints:
#   tilt  1e-01 rad: a flip every     1.2499 s
#   tilt  1e-02 rad: a flip every     2.3477 s
#   tilt  1e-03 rad: a flip every     3.4359 s
#   tilt  1e-06 rad: a flip every     6.6999 s
#   tilt  1e-09 rad: a flip every     9.9638 s
#   tilt  1e-12 rad: a flip every    13.2278 s
#   tilt  1e-50 rad: a flip every    54.5712 s
#   tilt 1e-100 rad: a flip every   108.9704 s
#   for each factor of ten   1.087984 s more
#   2 ln(10) / lambda        1.087984 s
# %% [markdown]
# ## Exactly between
#
# A nut tilted towards axis 1 and one tilted towards axis 3 do different things
# after leaving: the first circles about axis 1 (long-axis mode), the second about
# axis 3 (short-axis mode). Between them lies the *separatrix*, where
# $2 T I_2 = G^2$: two great circles of the sphere above. A state on them left axis
# 2 at $t = -\infty$, flips once, and never again:
#
# $$ g_2 = G \tanh(\lambda t), \qquad
#    g_1 = G \sqrt{\frac{I_1 (I_3 - I_2)}{I_2 (I_3 - I_1)}}
#    \operatorname{sech}(\lambda t), $$
#
# and so for $g_3$. What says how far a state is from there is the sign and the size
# of $D_2 = G^2 - 2 T I_2$: above 0 in short-axis mode, below in long-axis mode. Few
# states in floating point have $D_2 = 0$; for moments 3 : 4 : 6 one of them is
# $g = (1, 0, 1)$.
# %%
lucky = polhode.Body(3.0, 4.0, 6.0)
on_it = polhode.FreeRotation(
    lucky, polhode.RotorState([1, 0, 0, 0], [1.0, 0.0, 1.0])
)
G = on_it.momentum
grow = G / 4 * np.sqrt((4 - 3) * (6 - 4) / (3 * 6))
times = np.linspace(-40, 40, 9)
gap = np.abs(on_it.at(times).g[:, 1]) - np.abs(G * np.tanh(grow * times))
print(f"{on_it.regime.name}, period {on_it.polhode_period}")
print("|g_2| is G |tanh(lambda t)| to 1e-14:", np.abs(gap).max() < 1e-14)
# Prints:
#   separatrix, period inf
#   |g_2| is G |tanh(lambda t)| to 1e-14: True
# %% [markdown]
# ## What a simple integrator does there
#
# Game engines and many simulators keep the angular momentum in space and turn the
# body by its angular velocity times the step: seen from the body, $g$ turns by
# $-\omega h$. That keeps $G$ to rounding, but not $T$, and next to the separatrix a
# small error of $T$ is an error of kind. Take a nut tilted towards axis 3, by one
# degree, for a minute: exactly; by steps with the $\omega$ of their beginning
# (first order); by steps with the $\omega$ of their middle (second order); and by
# polhode's own integrator, which does without the closed form and is what one uses
# when torques act.


# %%
def turned(g, angle):
    """g after a turn by the vector angle."""
    size = np.linalg.norm(angle)
    axis = angle / size
    along = axis * (axis @ g)
    return along + (g - along) * np.cos(size) + np.cross(axis, g) * np.sin(size)


def stepped(g, h, seconds, order):
    """The momenta after 0, 1, 2, ... steps."""
    path = [g]
    for _ in range(round(seconds / h)):
        middle = g if order == 1 else turned(g, -h / 2 * g / nut.moments)
        g = turned(g, -h * middle / nut.moments)
        path.append(g)
    return np.array(path)


def distance(g):
    """D2 / G^2, the signed distance from the separatrix."""
    return 1 - I2 * (g**2 / nut.moments).sum(-1) / (g**2).sum(-1)


start = thrown(np.radians(1.0), np.pi / 2)
exact = polhode.FreeRotation(nut, start)
runs = {
    "first order, 60 steps/s": stepped(start.g, 1 / 60, 60, order=1),
    "second order, 60 steps/s": stepped(start.g, 1 / 60, 60, order=2),
    "second order, 240 steps/s": stepped(start.g, 1 / 240, 60, order=2),
}
problem = polhode.Problem(polhode.System(nut), start, 0.0, 60.0)
runs["polhode.integrate"] = polhode.integrate(problem).g
runs["exact"] = exact.at(np.linspace(0, 60, 3601)).g

print(f"{'at the start':26} {'D2/G^2':>32} = {distance(start.g):9.2e}")
for name, g in runs.items():
    count = np.count_nonzero(np.diff(np.sign(g[:, 1])))
    gain = (g[-1] ** 2 / nut.moments).sum() / (g[0] ** 2 / nut.moments).sum()
    print(f"{name:26} {count:4} flips, T times {gain:.4f},", end="")
    print(f" D2/G^2 = {distance(g[-1]):9.2e}")
# Prints:
#   at the start                                         D2/G^2 =  7.91e-05
#   first order, 60 steps/s     216 flips, T times 2.7474, D2/G^2 = -1.75e+00
#   second order, 60 steps/s     45 flips, T times 1.0335, D2/G^2 = -3.34e-02
#   second order, 240 steps/s    23 flips, T times 1.0003, D2/G^2 = -1.86e-04
#   polhode.integrate            24 flips, T times 1.0000, D2/G^2 =  7.91e-05
#   exact                        24 flips, T times 1.0000, D2/G^2 =  7.91e-05
# %%
looks = {
    "exact": figures.series(0),
    "second order, 240 steps/s": figures.series(1),
    "first order, 60 steps/s": figures.series(3),
}
with figures.style.style():
    size = (figures.DOUBLE_COLUMN, 0.5 * figures.DOUBLE_COLUMN)
    figure, (upper, lower) = plt.subplots(2, 1, figsize=size, sharex=True)
    for name, look in looks.items():
        g = runs[name]
        t = np.linspace(0, 60, len(g))
        if not name.startswith("first"):
            upper.plot(t, g[:, 1] / np.linalg.norm(g, axis=1), **look.line)
        lower.plot(t, 1e4 * distance(g), label=name, **look.line)
    lower.axhline(0, color=figures.style.GREY, linewidth=0.5)
    lower.set_ylim(-3, 2)
    lower.legend(loc="upper right", ncols=3)
    upper.set_ylabel("$g_2/G$")
    lower.set_ylabel("$10^4 D_2/G^2$")
    lower.set_xlabel("$t$ (s)")
    lower.margins(x=0)
    lower.set_xlim(0, 60)
figures.save(figure, "dzhanibekov_steps.png")
# Figure dzhanibekov_steps.png: Above, momentum along axis 2, exact and with 240
#   steps per second of second order. Below, the distance from the separatrix, which
#   is constant in truth: the steps carry the nut across 0, from short-axis to
#   long-axis mode.
# %% [markdown]
# The simple steps do not only flip at wrong times: they change the *mode*. With 60
# steps per second of first order the nut ends as a spin about axis 1, with nearly
# three times its energy, made from nothing. More steps only postpone it, because
# the distance to the separatrix that a run must resolve shrinks with the square of
# the tilt. How another engine fares is in the [gallery](../gallery/index.md); the
# errors of polhode's integrators are under [perturbed
# rotation](../accuracy/perturbed-rotation.md).
#
# In code of your own: [next_flip.cpp](../../examples/next_flip.cpp) does the flips
# in C++, the scenario [wing-nut.toml](../../examples/wing-nut.toml) runs on the
# command line, and [regimes](../theory/regimes.md) has the closed forms in every
# mode.
