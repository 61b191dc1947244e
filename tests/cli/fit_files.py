# SPDX-License-Identifier: MIT
"""Files of kind "fit", and what comes of them."""

import json

import numpy

HEAD = """schema = 1
title = "A tumbler"
kind = "fit"
[units]
time = "h"
angle = "deg"
[body]
moments = [1, 2.2, 2.6]
[state]
epoch = "2013-01-05T00:00:00 UTC"
axes = "ecliptic-J2000"
[state.attitude-rate]
euler = { phi = 20, theta = 60, psi = 110 }
omega_body = [3, 4, 12]
[time]
stop = 60
step = 1.5
"""
FREE = """
[free]
unknowns = ["attitude", "rate", "moments"]
"""
# What light curves are of.
TUMBLING = """[state.tumbler]
mode = "LAM"
precession_period = 12
rotation_period = 20
pole = { longitude = 50, latitude = 40 }
phi0 = 20
psi0 = 70
"""
TUMBLER = f"""schema = 1
kind = "fit"
[units]
time = "min"
angle = "deg"
[body]
moments = [0.5625, 1.2025, 1.36]  # of the ellipsoid 1 : 0.6 : 0.45
{TUMBLING}[time]
stop = 120
count = 81
"""
FREE_LIGHT = """
[free]
unknowns = ["attitude", "rate", "shape"]
"""
NIGHT = """
[[observation]]
kind = "light-curve"
file = "night.csv"
times = "at-body"
to_sun = [1, 0.2, 0.3]
to_observer = [0.8, 0.6, 0.1]
sigma = 0.02
"""
ORBITS = """
[orbit.body]
kind = "kepler"
semi_major_axis = 1.2
eccentricity = 0.2
gm = "1.32712440018e11 km3/s2"
[orbit.earth]
kind = "ephemeris"
target = "earth"
centre = "sun"
"""


def fitted(run, path, *arguments):
    done = run.ok("fit", path, "--json", *arguments)
    return json.loads(done.stdout)


def rows(path):
    lines = [one for one in path.read_text().splitlines() if not one.startswith("#")]
    names = lines[0].split(",")
    numbers = numpy.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    return dict(zip(names, numbers.T, strict=True))


def refused(run, path, command="fit"):
    arguments = ["--into", path.parent / "new"] if command == "simulate" else []
    done = run(command, path, *arguments)
    assert done.returncode == 2 and done.stdout == "", done.stderr
    assert len(done.stderr.splitlines()) == 1
    return done.stderr
