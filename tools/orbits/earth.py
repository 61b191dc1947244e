#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The orbit of the Earth over the past 400,000 years from a plain REBOUND run: the table of
docs/tutorials/milankovitch.py. Gravity alone; planets.c has relativity and the Moon, too.

    earth.py STATES > docs/tutorials/earth-nbody.txt       (needs rebound and numpy; minutes)

STATES is what states.py writes. Lines "t k h q p", means over 500 years of the heliocentric
elements of the Earth-Moon barycentre: t in years after J2000, k = e cos(varpi), h = e sin(varpi), q
= sin(i/2) cos(Omega), p = sin(i/2) sin(Omega), along the ecliptic of J2000."""

import math
import sys

import numpy
import rebound

YEAR, MEAN = 365.25, 500.0  # days, years


def samples(states, years):
    """Elements every ten years or so, up to that time."""
    sim = rebound.Simulation()
    sim.integrator = "whfast"
    for gm, x, y, z, vx, vy, vz in states:
        sim.add(m=gm, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
    sim.move_to_com()
    sim.dt = math.copysign(5.0, years)  # days
    rows = []
    for t in numpy.arange(0, abs(years), 9.7):
        sim.integrate(math.copysign(t, years) * YEAR, exact_finish_time=0)
        o = sim.particles[3].orbit(primary=sim.particles[0])
        tilt = math.sin(o.inc / 2)
        rows.append([sim.t / YEAR, o.e * math.cos(o.pomega), o.e * math.sin(o.pomega),
                     tilt * math.cos(o.Omega), tilt * math.sin(o.Omega)])  # fmt: skip
    return rows


def main():
    states = numpy.loadtxt(sys.argv[1])
    rows = numpy.array(samples(states, 5e3) + samples(states, -403e3)[1:])
    print("# t (yr) k h q p: the Earth-Moon barycentre, ecliptic-J2000 (tools/orbits/earth.py)")
    for middle in numpy.arange(4500.0, -402.1e3, -MEAN):
        near = rows[abs(rows[:, 0] - middle) < MEAN / 2]
        print(f"{middle:.0f}", *(f"{x:.7f}" for x in near[:, 1:].mean(0)))


if __name__ == "__main__":
    main()
