# SPDX-License-Identifier: MIT
"""Orbits as users have them: elements that change, elements over ages, ephemerides of far years,
and the frames that follow them."""

import csv
import json
import math

import budgets
import pytest
from closeness import assert_allclose

HEAD = """schema = 1
units = { time = "d", length = "km", angle = "deg" }
[body]
moments = [1, 2, 2.5]
[state]
epoch = "2000-06-28T00:00:00 UTC"
axes = "ecliptic-J2000"
[state.attitude-rate]
quaternion = [1, 0, 0, 0]
omega_body = [0.1, 0, 3]
"""
TIME = "[time]\nstop = 5\nstep = 1\n"
KEPLER = """[orbit.sun]
gm = "398600.4418 km3/s2"
semi_major_axis = 8000
eccentricity = 0.1
inclination = 50
"""
EPHEMERIS = '[orbit.sun]\nkind = "ephemeris"\ntarget = "sun"\ncentre = "earth"\n'
PLANE = '[frame.orbit-plane]\norbit = "sun"\n'
VERTICAL = '[frame.local-vertical]\norbit = "sun"\n'
GRAVITY = '[[perturbation]]\nkind = "gravity-gradient"\norbit = "sun"\n'


@pytest.fixture
def said(run, tmp_path):
    """said(text) -> the refusal of a scenario, or what `info` says as a table."""

    def of(text):
        (tmp_path / "a.toml").write_text(text, encoding="utf-8")
        done = run("info", tmp_path / "a.toml", "--json")
        return json.loads(done.stdout) if done.returncode == 0 else done.stderr

    return of


@pytest.fixture
def rows(run, tmp_path):
    """The columns of a run, by name."""

    def of(text):
        (tmp_path / "a.toml").write_text(text, encoding="utf-8")
        run.ok("run", tmp_path / "a.toml", "--out", tmp_path / "a.csv")
        lines = (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()
        table = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        return {name: [float(row[name]) for row in table] for name in table[0]}

    return of


@pytest.mark.parametrize(("rate", "time", "what"), [
    ('"0.1 1/d"', "stop = 10\nstep = 1", "the eccentricity reaches 1 at t = 9 d, 2000-07-07T00:00 "
     "UTC; expected 0 to below 1 all along the run"),
    ('"-0.1 1/d"', "stop = 5\nstep = 1", "the eccentricity reaches 0 at t = 1 d, 2000-06-29T00:00"),
    ('"0.1 1/d"', "stop = -5\nstep = -1", "the eccentricity reaches 0 at t = -1 d, 2000-06-27"),
    ('"0.1 deg/d"', "stop = 5\nstep = 1", "orbit.sun.eccentricity_rate"),
])  # fmt: skip
def test_an_eccentricity_that_leaves_the_ellipse_is_refused_with_the_date(said, rate, time, what):
    text = said(HEAD + KEPLER + f"eccentricity_rate = {rate}\n[time]\n{time}\n")
    assert isinstance(text, str), text
    assert what in text and text.count("\n") == 1 and "eccentricity_rate" in text


def test_an_orbit_that_sinks_into_its_body_gets_a_note(said):
    """6000 km at the end, 7200 km at the epoch; of 8000 km the axis."""
    rate = 'eccentricity_rate = "0.03 1/d"\n'
    note = said(HEAD + KEPLER + rate + TIME)["orbit_sun_note"]
    assert "6000 km from the centre, is inside the Earth (6371 km)" in note
    assert "orbit_sun_note" not in said(HEAD + KEPLER + rate + "[time]\nstop = 2\nstep = 1\n")
    assert "orbit_sun_note" not in said(HEAD + KEPLER + TIME)


def test_a_hyperbola_keeps_its_eccentricity(said):
    text = HEAD + KEPLER.replace("semi_major_axis", "pericentre").replace("= 0.1", "= 1.1") + TIME
    assert "expected 0 for a hyperbola" in said(text.replace(
        "inclination = 50", 'inclination = 50\neccentricity_rate = "1e-3 1/d"'))  # fmt: skip


def test_rates_of_elements_act(rows):
    """The frame of the plane says what inclination and node are."""
    text = (HEAD + KEPLER + 'inclination_rate = "1 deg/d"\nnode_rate = 3\n' + PLANE + TIME +
            '[output]\ncolumns = ["q", "q_inertial"]\n')  # fmt: skip
    c = rows(text)
    names = [n for n in c if n[0] in "qQ"]
    q, p = ([[c[n][k] for n in own] for k in (0, -1)] for own in (names[:4], names[4:]))
    for k, (node, i) in enumerate(((0.0, 50.0), (15.0, 55.0))):
        # q_IS = q_inertial q*
        turn = product(p[k], [q[k][0], *(-x for x in q[k][1:])])
        half_n, half_i = math.radians(node / 2), math.radians(i / 2)
        there = [math.cos(half_n) * math.cos(half_i), math.cos(half_n) * math.sin(half_i),
                 math.sin(half_n) * math.sin(half_i), math.sin(half_n) * math.cos(half_i)]
        sign = math.copysign(1.0, sum(a * b for a, b in zip(turn, there, strict=True)))
        assert_allclose([sign * x for x in turn], there, atol=budgets.numpy_formula)


def product(p, q):
    return [p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3],
            p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1]]


@pytest.mark.parametrize("frame", [PLANE + 'axis_1 = "shortest-turn"\n', PLANE, VERTICAL])
def test_frames_of_an_ephemeris(said, rows, frame):
    moon = EPHEMERIS.replace('"sun"\nc', '"moon"\nc')
    assert said(HEAD + moon + frame + TIME)["frame"].endswith("of orbit sun")
    assert len(rows(HEAD + moon + GRAVITY + frame + TIME)["t"]) == 6


def test_a_frame_of_two_straight_lines_is_refused(said):
    table = ('[orbit.sun]\nkind = "table"\ntimes = [0, 5, 10]\nx = [1, 0, -1]\ny = [0, 1, 0]\n'
             "z = [0, 0, 0]\norder = 2\n")
    for frame in (PLANE, VERTICAL):
        assert "table of order 2; expected 4 or more" in said(HEAD + table + frame + TIME)


@pytest.mark.parametrize(("year", "note"), [
    (2000, None), (1850, "; outside 1900 to 2100, off by up to some 1 arcsec"),
    (1050, "; outside 1900 to 2100, off by up to some 1 arcsec"), (950, ValueError),
])  # fmt: skip
def test_far_years_have_their_error(said, year, note):
    text = said(HEAD.replace("2000-06-28T00:00:00 UTC", f"{year:04}-06-28 TT") + EPHEMERIS + TIME)
    if note is ValueError:
        assert "must be in the years 1000 to 3000" in text
    else:
        assert ("outside" in text["orbit_sun"]) == (note is not None)
        assert (note or "") in text["orbit_sun"]


def test_far_years_of_a_near_planet_have_the_error_of_its_nearest(said):
    """Mars in a run of two years: at the opposition some 4 times what the Sun would see."""
    head = HEAD.replace("2000-06-28T00:00:00 UTC", "2650-01-01 TT")
    mars = EPHEMERIS.replace('"sun"\nc', '"mars"\nc')
    text = said(head + mars + "[time]\nstop = 800\nstep = 100\n")["orbit_sun"]
    assert 60 < float(text.rpartition("up to some ")[2].partition(" arcsec")[0]) < 180


ELEMENTS = """[orbit.sun]
kind = "elements"
file = "e.csv"
columns = ["t", "e", "i", "Omega", "varpi"]
units = ["d", "1", "deg", "deg", "deg"]
axes = "ecliptic-J2000"
gm = "132712440041.28 km3/s2"
semi_major_axis = "1 au"
mean_longitude = 30
"""


def test_elements_over_ages_feed_a_rotation(rows, tmp_path):
    """As a Kepler orbit of the same elements does, whose rates are those of the rows."""
    lines = [f"{t},{0.2 + 1e-5 * t!r},{5 + 1e-3 * t!r},{100 - 2e-3 * t!r},{150 + 3e-3 * t!r}"
             for t in range(-100, 801, 50)]
    (tmp_path / "e.csv").write_text("t,e,i,Omega,varpi\n" + "\n".join(lines), encoding="utf-8")
    kepler = """[orbit.sun]
gm = "132712440041.28 km3/s2"
semi_major_axis = "1 au"
eccentricity = 0.2
eccentricity_rate = "1e-5 1/d"
inclination = 5
inclination_rate = 1e-3
node = 100
node_rate = -2e-3
pericentre_argument = 50
pericentre_rate = 5e-3
mean_anomaly = -120
mean_anomaly_rate = -3e-3
"""  # lambda = varpi + M advances by n alone
    rest = (GRAVITY + "[time]\nstop = 700\nstep = 100\n"
            '[output]\ncolumns = ["q"]\n')
    one, other = rows(HEAD + ELEMENTS + rest), rows(HEAD + kepler + rest)
    for name in one:
        assert_allclose(one[name], other[name], atol=budgets.elements_run)


@pytest.mark.parametrize(("change", "what"), [
    (('gm = "132712440041.28 km3/s2"\n', ""), "there is no gm"),
    (('semi_major_axis = "1 au"\n', ""), "there is no semi_major_axis"),
    (('"1 au"', "-1"), "orbit.sun.semi_major_axis: "),
    (('axes = "ecliptic-J2000"\ng', 'axes = "inertial"\ng'), "orbit.sun.axes: "),
    (("step = 1", "step = 300"), None),
    (("stop = 5", "stop = 500"), "it covers t = -100 d, 2000-03-20"),
    (("[time]\nstop = 5\nstep = 1\n", ""), "expected a table [time]"),
])  # fmt: skip
def test_elements_of_a_rotation_that_lack_something(said, tmp_path, change, what):
    lines = [f"{t},0.2,5,100,150" for t in range(-100, 301, 50)]
    (tmp_path / "e.csv").write_text("t,e,i,Omega,varpi\n" + "\n".join(lines), encoding="utf-8")
    text = HEAD + ELEMENTS + TIME.replace("\n\n", "\n")
    assert change[0] in text
    answer = said(text.replace(*change))
    if what is None:
        assert answer["orbit_sun"].startswith("elements e.csv, 9 rows")
    else:
        assert what in answer and answer.count("\n") == 1
