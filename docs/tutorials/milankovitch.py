# SPDX-License-Identifier: MIT
"""Milankovitch: from an N-body run to the sunlight of the ice ages."""

# %% [markdown]
# # Milankovitch from an N-body run
#
# Ice ages follow the summer sun of the north. How much of it there was is celestial
# mechanics: the planets change the orbit of the Earth, Sun and Moon turn its axis,
# and both together say how far the Sun stood above 65 degrees north at midsummer.
# This page starts from an orbit that an N-body program made and ends at that curve.
#
# ## The orbit: REBOUND
#
# Any integrator of planets will do. Here it is
# [REBOUND](https://rebound.readthedocs.io): the Sun and eight planets from the
# states of JPL's DE440, gravity alone, 400,000 years back in steps of five days. It
# takes a minute (the whole program is `tools/orbits/earth.py`):
#
# ```text
# step, year = 5, 1461 / 4                    # days
# sim = rebound.Simulation()
# sim.integrator = "whfast"
# for gm, x, y, z, vx, vy, vz in states:      # barycentric; au, days
#     sim.add(m=gm, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
# sim.move_to_com()
# sim.dt = -step
# for t in range(0, 403_000, 10):             # years
#     sim.integrate(-t * year, exact_finish_time=0)
#     o = sim.particles[3].orbit(primary=sim.particles[0])
#     ...                                     # o.e, o.pomega, o.inc, o.Omega
# ```
#
# The elements of one moment tremble with the pull of Venus and Jupiter. What turns
# the axis over ages are their means, and so the program averages over 500 years
# before it writes a row. It averages e cos(varpi) and its like, not e and varpi,
# which have no mean where the orbit is nearly a circle. The result is
# [earth-nbody.txt](earth-nbody.txt).
# %%
import warnings

import numpy as np
import polhode
from polhode import figures

t, k, h, q, p = np.loadtxt("earth-nbody.txt").T[:, ::-1]  # rising times, years
eccentricity, inclination = np.hypot(k, h), 2 * np.arcsin(np.hypot(q, p))
node, pericentre = np.arctan2(p, q), np.arctan2(h, k)
orbit = polhode.secular.ElementTable(
    t, eccentricity, inclination, node, pericentre - node)
largest = eccentricity.max()
print(f"{len(t)} rows from {t[0]:.0f} to {t[-1]:.0f}, e up to {largest:.3f}")
# Prints:
#   814 rows from -402000 to 4500, e up to 0.050
# %% [markdown]
# ## The axis
#
# `planet_rates` knows the precession constant of the Earth, the share of the Moon
# included; the pole of J2000 starts the axis. The motion is averaged over days and
# years, so that a step is a thousand years.
# %%
ages = np.arange(0.0, -400001.0, -1000.0)
axis = polhode.secular.spin_history(
    orbit, polhode.secular.planet_rates("earth"),
    polhode.secular.planet_pole("earth"), ages, polhode.Splitting(1000, "order8"))
tilt = np.degrees(axis.obliquity)
print(f"obliquity now {tilt[0]:.3f} deg")
high = np.argmax(tilt[ages > -20e3])
print(f"largest of 20,000 years: {tilt[high]:.2f} deg, {-ages[high]:.0f} years ago")
print(f"over all: {tilt.min():.2f} to {tilt.max():.2f} deg")
# Prints:
#   obliquity now 23.439 deg
#   largest of 20,000 years: 24.23 deg, 9000 years ago
#   over all: 22.08 to 24.46 deg
# %% [markdown]
# ## The sunlight
#
# The mean of a day depends on the latitude, on where the Earth stands in its year,
# and on how far the Sun is then, which is what climatic precession tells: e times
# the sine of the longitude of the pericentre from the equinox.
# %%
june = polhode.secular.daily_insolation(
    axis.obliquity, axis.pericentre, axis.eccentricity,
    latitude=np.radians(65), longitude=np.pi / 2, flux=1361.0)
print(f"65 degrees north, midsummer: now {june[0]:.0f} W/m2")
print(f"from {june.min():.0f} ({-ages[june.argmin()]:.0f} years ago) "
      f"to {june.max():.0f} ({-ages[june.argmax()]:.0f} years ago)")


def draw():
    with figures.style.style():
        size = (figures.SINGLE_COLUMN, 4.4)
        panels = figures.style.panels(None, 3, 1, size, sharex=True)
        for ax, y, label in zip(
                panels.flat, (tilt, axis.climatic_precession, june),
                ("obliquity (deg)", r"e sin $\varpi$", r"June, 65 N (W/m$^2$)")):
            ax.plot(ages / 1e3, y, lw=0.8)
            ax.set_ylabel(label)
        panels.flat[1].invert_yaxis()
        ax.set_xlabel("time (kyr)")
        return panels


figures.save(draw(), "milankovitch.png")
# Figure milankovitch.png: Obliquity, climatic precession (upside down: northern
#   summers are warm above) and the sunlight of midsummer at 65 degrees north over
#   the past 400,000 years.
# Prints:
#   65 degrees north, midsummer: now 478 W/m2
#   from 431 (231000 years ago) to 552 (220000 years ago)
# %% [markdown]
# ## The periods
#
# Milankovitch's periods come out of the curve itself. The spectrum of the obliquity
# has its cycle of some 41,000 years; climatic precession has two next to 22,000
# years, which so short a time hardly parts (polhode warns of that), and the one of
# 19,000 years.
# %%
warnings.simplefilter("ignore", RuntimeWarning)  # of lines that are too close


def periods(x, lines):
    of = polhode.analysis.spectrum(x, 1.0, lines=lines)
    return [f"{2 * np.pi / abs(nu):.1f}" for nu in of.frequency]


print("obliquity:          ", *periods(tilt, 1), "kyr")
print("climatic precession:", *periods(axis.climatic_precession, 3), "kyr")
# Prints:
#   obliquity:           40.5 kyr
#   climatic precession: 23.2 19.0 21.2 kyr
# %% [markdown]
# ## How good is a minute's N-body run?
#
# The orbit that polhode brings along has relativity and the pull of the Moon, and
# was filtered with more care (`data/orbits/README.md`). On it the obliquity is that
# of the published La2004 to [a small part of a
# degree](../guide/obliquity.md#the-orbits-that-come-along) over a million years.
# The difference is what gravity alone leaves out:
# %%
better = polhode.secular.spin_history(
    polhode.secular.shipped_orbit("earth"), polhode.secular.planet_rates("earth"),
    polhode.secular.planet_pole("earth"), ages, polhode.Splitting(1000, "order8"))
apart = np.abs(np.degrees(better.obliquity - axis.obliquity))
light = polhode.secular.daily_insolation(
    better.obliquity, better.pericentre, better.eccentricity,
    np.radians(65), np.pi / 2, 1361.0)
for age in (100, 200, 400):
    print(f"{age} kyr: obliquity within {apart[:age + 1].max():.3f} deg, "
          f"sunlight within {np.abs(light - june)[:age + 1].max():.1f} W/m2")
# Prints:
#   100 kyr: obliquity within 0.001 deg, sunlight within 1.3 W/m2
#   200 kyr: obliquity within 0.002 deg, sunlight within 2.8 W/m2
#   400 kyr: obliquity within 0.006 deg, sunlight within 5.5 W/m2
# %% [markdown]
# The same from a file, without a line of Python, is
# [earth-obliquity.toml](../../examples/earth-obliquity.toml); your own table goes
# into [`[orbit.NAME]`](../guide/obliquity.md#your-own-orbit).
