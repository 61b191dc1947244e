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


def fitted(run, path, *arguments):
    done = run("fit", path, "--json", *arguments)
    assert done.returncode == 0, done.stderr
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
