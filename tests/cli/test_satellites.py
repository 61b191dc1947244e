# SPDX-License-Identifier: MIT
"""Satellites and tides in files of kind obliquity. Oracles: the formulas, restated here from their
papers, and a plain integration of them."""

import json
import math

import budgets
import numpy
import pytest
from closeness import largest

DAY, YEAR, GM, R, FACTOR = 86400.0, 365.25 * 86400, 398600.4418, 6378.1366, 0.3307  # km, s
MASS, DISTANCE, E = 0.0123, 384399.0, 0.00327
HEAD = """schema = 1
kind = "obliquity"
units = { time = "Myr", angle = "deg", length = "km" }
"""
PLANET = """[planet]
ellipticity = 0.00327
rotation_period = "1 d"
orbital_period = "365.25 d"
gm = "398600.4418 km3/s2"
radius = 6378.1366
inertia_factor = 0.3307
pole = { obliquity = 30, precession = 40 }
orbit = "mine"
"""
MOON = """[[planet.satellite]]
kind = "outer"
mass = 0.0123
distance = 384399
eccentricity = 0.0549
inclination = 5.15
"""
ORBIT = """[orbit.mine]
kind = "series"
ellipse_file = "ellipse.txt"
plane_file = "plane.txt"
columns = ["frequency", "amplitude", "phase"]
units = ["arcsec/yr", "1", "deg"]
axes = "inertial"
[time]
stop = -400
step = 100
"""
TIDES = '[planet.tides]\nk2 = 0.305\nlag = "638 s"\n'
COLUMNS = '[output]\ncolumns = ["spin", "tides"]\n'
TURN = 2 * math.pi
N, W = TURN / YEAR, TURN / DAY


@pytest.fixture
def mine(run, table, tmp_path):
    """mine(text, command) -> the names and rows of its output, what `info` says, or the refusal."""
    (tmp_path / "ellipse.txt").write_text("0 0.2 30\n", encoding="utf-8")
    (tmp_path / "plane.txt").write_text("0 0.05 70\n", encoding="utf-8")

    def go(text, command="run"):
        path, out = tmp_path / "planet.toml", tmp_path / "planet.csv"
        path.write_text(text, encoding="utf-8")
        out.unlink(missing_ok=True)
        done = run(command, path, *(["--out", out] if command == "run" else ["--json"]))
        if done.returncode != 0:
            return done.stderr
        return table(out.read_text(encoding="utf-8")) if command == "run" else done.stdout

    return go


def constant(said):
    """deg/Myr, out of what `info` says."""
    return json.loads(said)["precession_constant"]["value"]


STAR = math.degrees(1.5 * N**2 * E / W) * 1e6 * YEAR


def test_a_moon_far_outside_pulls_as_the_star_does(mine):
    moon = (1.5 * MASS * GM / DISTANCE**3 * E / W * (1 - 0.0549**2) ** -1.5
            * (1 - 1.5 * math.sin(math.radians(5.15)) ** 2))
    expected = STAR + math.degrees(moon) * 1e6 * YEAR
    found = constant(mine(HEAD + PLANET + MOON + ORBIT, "info"))
    assert abs(found / expected - 1) < budgets.satellite_constant
    # its share is the same where the constant is given
    rows = mine(HEAD + PLANET + MOON + ORBIT)[1]
    given = PLANET.replace("ellipticity = 0.00327",
                           f'precession_constant = "{found!r} deg/Myr"')
    for a, b in zip(rows, mine(HEAD + given + MOON + ORBIT)[1], strict=True):
        assert largest(abs(x - y) for x, y in zip(a, b, strict=True)) < budgets.spin_axes_deg


def test_satellites_in_the_equator_are_carried_along(mine):
    inner = MOON.replace('"outer"', '"inner"').replace("384399", "40000").split("ecc")[0]
    ratio, motion = 40000 / R, math.sqrt(GM * (1 + MASS) / 40000**3)
    q, momentum = 0.5 * MASS * ratio**2, MASS * ratio**2 * motion / W
    factor = (1 + q / (E * FACTOR)) / (1 + momentum / FACTOR)
    found = constant(mine(HEAD + PLANET + inner + ORBIT, "info"))
    assert abs(found / (STAR * factor) - 1) < budgets.satellite_constant


def plain(rates, alpha, moon_share, start, stop, steps=8000):
    """s, w and a of the equations that the library states, by Runge and Kutta's method."""
    star, moon, month, momentum = rates
    e2, half = 0.04, 0.05
    inclination, node = 2 * math.asin(half), math.radians(70)
    n = numpy.array([math.sin(inclination) * math.sin(node),
                     -math.sin(inclination) * math.cos(node), math.cos(inclination)])
    f = (1 + 3 * e2 + 3 / 8 * e2**2) / (1 - e2) ** 4.5
    g = (1 + 7.5 * e2 + 45 / 8 * e2**2 + 5 / 16 * e2**3) / (1 - e2) ** 6

    def change(y):
        s, w, a = y[:3], W * y[3], y[4]
        c = s @ n
        k = numpy.array([star, moon / a**6])
        drag, drive = k @ [f, 1], k @ [g * N, month / a**1.5]
        turn = alpha * y[3] * ((1 - e2) ** -1.5 + moon_share / a**3) * c
        ds = turn * numpy.cross(s, n) + (drive / w - drag * c / 2) * (n - c * s)
        dw = drive * c - drag * w * (1 + c * c) / 2
        da = 2 * math.sqrt(a) * k[1] * (w * c - month / a**1.5) / momentum
        return numpy.array([*ds, dw / W, da])

    y, h = numpy.array([*start, 1.0, 1.0]), stop / steps
    for _ in range(steps):
        k1 = change(y)
        k2 = change(y + h / 2 * k1)
        k3 = change(y + h / 2 * k2)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + change(y + h * k3))
    return y


def test_tides_are_those_of_the_equations(mine):
    slow = PLANET.replace("ellipticity = 0.00327", 'precession_constant = "9 deg/Myr"')
    moon = MOON.split("ecc")[0]
    names, rows = mine(HEAD + slow + TIDES + moon + ORBIT + COLUMNS)
    assert names == ["t", "sx", "sy", "sz", "rotation_rate", "satellite_distance"]
    k = 3 * 0.305 * 638 / FACTOR
    month = math.sqrt(GM * (1 + MASS) / DISTANCE**3)
    rates = [k * N**4 * R**3 / GM, k * MASS**2 * GM * R**3 / DISTANCE**6, month,
             MASS / (1 + MASS) * month * (DISTANCE / R) ** 2 / FACTOR]
    share = MASS * GM / DISTANCE**3 / N**2
    alpha = math.radians(9) / (1e6 * YEAR) / (1 + share)
    end = plain(rates, alpha, share, rows[0][1:4], -400e6 * YEAR)
    assert largest(abs(a - b) for a, b in zip(end, rows[-1][1:], strict=True)) < budgets.tidal_file
    assert rows[-1][4] > 1.1 and rows[-1][5] < 0.96
    adaptive = HEAD + slow + TIDES + moon + ORBIT + COLUMNS
    splitting = mine(adaptive + '[method]\nkind = "splitting"\nscheme = "order8"\nstep = 2\n')[1]
    assert largest(abs(a - b) for a, b in zip(end, splitting[-1][1:], strict=True)
                   ) < budgets.tidal_file


def test_what_a_name_knows_is_what_is_written_out(mine):
    """The Earth by its name, without and with a unit of length, and with its Moon written out."""
    text = (HEAD + '[planet]\nname = "earth"\npole = { obliquity = 23, precession = 0 }\n'
            'orbit = "mine"\nprecession_rate = "50 arcsec/yr"\n' + TIDES + ORBIT + COLUMNS)
    text = text.replace("stop = -400\nstep = 100", "stop = -1\nstep = 0.5")
    rows = mine(text)[1]
    moon = ('[[planet.satellite]]\nkind = "outer"\nmass = 0.0123000371\ndistance = 384399\n')
    numbers = ('gm = "398600.4418 km3/s2"\nradius = 6378.1366\n'
               'inertia_factor = 0.33069758\nrotation_period = "86164.1003 s"\n'
               'orbital_period = "365.256363 d"\n')
    bare = mine(text.replace(', length = "km"', ""))[1]
    assert largest(abs(a - b) for a, b in zip(rows[-1], bare[-1], strict=True)) < budgets.tidal_file
    written = mine(text.replace('name = "earth"\n', numbers).replace(ORBIT[:12], moon + ORBIT[:12])
                   )[1]
    # the tides alone: the share of the Moon in the precession is another
    assert largest(abs(a - b) for a, b in zip(rows[-1][4:], written[-1][4:], strict=True)
                   ) < budgets.tidal_file


def test_the_tides_of_a_map_cell_are_those_of_the_run(mine, run, table, tmp_path):
    text = HEAD + PLANET + TIDES + MOON + ORBIT.replace("-400\nstep = 100", "-1\nstep = 0.1")
    rows = mine(text + COLUMNS)[1]
    path = tmp_path / "map.toml"
    path.write_text(text + '[map]\nkind = "column"\ncolumn = "rotation_rate"\n[[map.axis]]\n'
                    'key = "planet.tides.k2"\nfrom = 0\nto = 0.305\ncount = 2\n', encoding="utf-8")
    run.ok("map", path, "--out", tmp_path / "map.csv")
    cells = table((tmp_path / "map.csv").read_text(encoding="utf-8"))[1]
    assert cells[0][1:] == [1, 1, 1]
    assert cells[1][1:] == [1, rows[-1][4], rows[-1][4]]


@pytest.mark.parametrize(("old", "new", "said"), [
    ('"1 d"', '"-1 d"', "expected a positive one next to a table planet.tides"),
    ("orbit =", "tidal_drift = 1\norbit =", "expected none next to a table planet.tides"),
    ("orbit =", "satellites = 1\norbit =", "expected none next to tables planet.satellite"),
    ("[planet.tides]", MOON + "[planet.tides]", "expected one outer satellite next to"),
    ("0.0549", "1.2", "expected a number from 0 to below 1"),
    ('"outer"', '"inner"', 'a key of kind "outer"'),
    ('"outer"', '"near"', 'expected "outer" or "inner"'),
    ("mass = 0.0123", "mass = -1", "positive"),
    ("k2 = 0.305", "k2 = -1", "k2"),
    ("gm = ", "# ", "expected a key gm or the name of a planet"),
    ("ellipticity = 0.00327\n", "precession_constant = 2\nellipticity = 1\n",
     "expected none next to precession_constant"),
    ('orbital_period = "365.25 d"', "", "got no orbital_period"),
])
def test_what_is_wrong_is_named(mine, old, new, said):
    text = HEAD + PLANET + TIDES + MOON + ORBIT
    assert old in text
    message = mine(text.replace(old, new, 1))
    assert isinstance(message, str) and said in message, message


def test_what_needs_another_table_says_so(mine):
    message = mine(HEAD + PLANET + MOON + ORBIT + COLUMNS)
    assert "expected a table planet.tides for the columns tides" in message
    constant_given = PLANET.replace("ellipticity = 0.00327", "precession_constant = 9")
    inner = MOON.split("ecc")[0].replace('"outer"', '"inner"')
    message = mine(HEAD + constant_given + inner + ORBIT)
    assert "expected no inner satellite next to precession_constant" in message
    message = mine(HEAD + constant_given.replace("orbital_period", "# ") + MOON + ORBIT)
    assert "expected a key orbital_period or the name of a planet" in message
