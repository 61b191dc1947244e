# SPDX-License-Identifier: MIT
"""Files of kind obliquity: what they give, and what is said of those that are wrong. Oracles:
La2004 for the Earth (typed in with its source in tests/unit/secular/shipped_orbit.cpp), the closed
form on an orbit that stays."""

import math
import subprocess

import budgets
import numpy
import pytest
from closeness import largest

HEAD = 'schema = 1\nkind = "obliquity"\nunits = { time = "kyr", angle = "deg" }\n'
EARTH = HEAD + """[planet]
name = "earth"
orbit = "earth"
tidal_drift = "-5.2e-4 1/Myr"
[orbit.earth]
kind = "shipped"
name = "earth"
[time]
stop = -1000
step = 100
[method]
kind = "splitting"
scheme = "order8"
step = 2
[output]
columns = ["obliquity", "eccentricity", "spin", "andoyer"]
"""
TABLE = """[planet]
precession_rate = "20 deg/kyr"
pole = { obliquity = 30, precession = 40 }
orbit = "mine"
[orbit.mine]
kind = "elements"
file = "mine.txt"
columns = ["t", "a", "e", "i", "Omega", "varpi"]
units = ["kyr", "au", "1", "deg", "deg", "deg"]
axes = "inertial"
[time]
stop = 50
step = 10
"""
ROWS = [(t, 1.5, 0.3, 5.0, 70.0, 200.0) for t in range(-10, 61, 2)]


def written(rows=ROWS, head="# t a e i Omega varpi"):
    return "\n".join([head, *(" ".join(map(repr, row)) for row in rows)]) + "\n"


@pytest.fixture
def mine(run, table, tmp_path):
    """mine(text, rows) -> the names and rows of its output, or what was said."""

    def go(text=HEAD + TABLE, rows=None, **files):
        (tmp_path / "mine.txt").write_text(rows or written(), encoding="utf-8")
        for name, content in files.items():
            (tmp_path / f"{name}.txt").write_text(content, encoding="utf-8")
        path = tmp_path / "planet.toml"
        path.write_text(text, encoding="utf-8")
        out = tmp_path / "planet.csv"
        out.unlink(missing_ok=True)
        done = run("run", path, "--out", out)
        if done.returncode != 0:
            return done.stderr
        return table(out.read_text(encoding="utf-8"))

    return go


def test_the_earth_is_that_of_la2004(mine):
    names, rows = mine(EARTH)
    assert names == ["t", "obliquity", "eccentricity", "sx", "sy", "sz", "I", "h", "H"]
    first, last = rows[0], rows[-1]
    assert (first[0], last[0]) == (0.0, -1000.0)
    assert abs(first[1] - 23.4392911) < budgets.shipped_orbit_100_kyr
    assert abs(last[1] - math.degrees(0.4123891471500025)) < budgets.shipped_orbit_1_myr
    assert abs(last[2] - 0.03575988082961842) < budgets.shipped_orbit_recent
    for _, _, _, x, y, z, I, h, H in rows:
        assert abs(math.hypot(x, y, z) - 1) < budgets.secular_rounding
        assert abs(math.cos(math.radians(I)) - z) < budgets.secular_rounding and z == H
        across = math.sin(math.radians(I)) * math.sin(math.radians(h))
        assert abs(across - x) < budgets.secular_rounding


def test_an_orbit_that_stays_has_a_closed_form(mine):
    names, rows = mine()
    assert names == ["t", "obliquity", "precession", "climatic_precession"]
    for t, obliquity, precession, climatic in rows:
        assert abs(obliquity - 30) < budgets.spin_axes_deg
        turned = math.remainder(precession - 40 - 20 * t, 360)
        assert abs(turned) < budgets.spin_axes_deg
        # the pericentre from the moving equinox: varpi + precession, along equinoctial axes
        expected = 0.3 * math.sin(math.radians(200 + 40 + 20 * t))
        assert abs(climatic - expected) < budgets.spin_axes_deg


@pytest.mark.parametrize(("columns", "row"), [
    ('["t", "k", "h", "q", "p"]', lambda t, a, e, i, node, varpi: (
        t, e * math.cos(math.radians(varpi)), e * math.sin(math.radians(varpi)),
        math.sin(math.radians(i / 2)) * math.cos(math.radians(node)),
        math.sin(math.radians(i / 2)) * math.sin(math.radians(node)))),
    ('["t", "-", "e", "i", "Omega", "omega"]',
     lambda t, a, e, i, node, varpi: (t, 7.0, e, i, node, varpi - node)),
])
def test_elements_of_any_kind_are_one_orbit(mine, columns, row):
    expected = mine()[1]
    count = columns.count('"') // 2
    units = ["kyr", "1", "1", "1", "1"] if count == 5 else ["kyr", "1", "1", "deg", "deg", "deg"]
    text = (HEAD + TABLE).replace('["t", "a", "e", "i", "Omega", "varpi"]', columns)
    text = text.replace('["kyr", "au", "1", "deg", "deg", "deg"]', str(units).replace("'", '"'))
    found = mine(text, written([row(*one) for one in ROWS], head="# a table"))[1]
    for a, b in zip(expected, found, strict=True):
        assert largest(abs(x - y) for x, y in zip(a, b, strict=True)) < budgets.spin_axes_deg


def test_times_may_fall_and_count_backwards(mine):
    expected = mine()
    text = (HEAD + TABLE).replace('axes =', 'time_direction = "before-present"\naxes =')
    backwards = written([(-row[0], *row[1:]) for row in ROWS])
    assert mine(text, backwards) == expected
    assert mine(HEAD + TABLE, written(ROWS[::-1])) == expected


def test_a_series_is_the_orbit_of_its_terms(mine):
    series = """kind = "series"
ellipse_file = "ellipse.txt"
plane_file = "plane.txt"
columns = ["-", "frequency", "amplitude", "phase"]
units = ["1", "arcsec/yr", "1", "deg"]
amplitude_unit = 1e-8
axes = "inertial"
"""
    text = HEAD + TABLE
    before, after = text.split("kind = \"elements\"\n")
    text = before + series + after[after.index("[time]"):]
    half = math.sin(math.radians(2.5))
    found = mine(text, ellipse="1 0.0 30000000 200\n", plane=f"1 0.0 {half * 1e8!r} 70\n")
    for a, b in zip(mine()[1], found[1], strict=True):
        assert largest(abs(x - y) for x, y in zip(a, b, strict=True)) < budgets.spin_axes_deg


def test_physical_data_and_constants_agree(mine):
    rate = 'precession_rate = "20 deg/kyr"'
    constant = 20 / math.cos(math.radians(30)) * (1 - 0.09) ** 1.5
    by_constant = (HEAD + TABLE).replace(rate, f"precession_constant = {constant!r}")
    day, year = 24.0, 600.0  # h, d
    ellipticity = (math.radians(constant) / (365.25e3 * 86400)) / (
        1.5 * (2 * math.pi / (year * 86400)) ** 2 * (day * 3600) / (2 * math.pi))
    physical = (HEAD + TABLE).replace(
        rate, f'ellipticity = {ellipticity!r}\nrotation_period = "{day} h"\n'
        f'orbital_period = "{year} d"')
    expected = mine()[1]
    for text in (by_constant, physical):
        for a, b in zip(expected, mine(text)[1], strict=True):
            assert largest(abs(x - y) for x, y in zip(a, b, strict=True)) < budgets.spin_axes_deg


def test_insolation_is_a_column(mine):
    text = EARTH.replace("[orbit.earth]", "[planet.insolation]\nlatitude = 65\nlongitude = 90\n"
                         "flux = 1361\n[orbit.earth]").replace('"spin", "andoyer"', '"insolation"')
    rows = mine(text)[1]
    # 479 W/m2 at 65 N at the June solstice: Berger & Loutre (1991), for 1360 W/m2
    assert abs(rows[0][3] - 479) < 2.5


@pytest.mark.parametrize("tides", ["tidal_drift = 0", 'tides = { k2 = 0.3, lag = "600 s" }'])
def test_a_stopped_run_goes_on(run, table, tmp_path, polhode, tides):
    path, out = tmp_path / "planet.toml", tmp_path / "planet.csv"
    text = EARTH.replace('tidal_drift = "-5.2e-4 1/Myr"', tides)
    path.write_text(text.replace("step = 100", "step = 0.01").replace("step = 2", "step = 0.01"),
                    encoding="utf-8")
    process = subprocess.Popen([str(polhode), "run", str(path), "--out", str(out), "--checkpoint",
                                "0.02 s"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        process.wait(0.3)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    again = run("run", path, "--out", out, *([] if out.exists() else ["--resume"]))
    if again.returncode != 0:  # killed before the first checkpoint, or complete
        assert "resume" in again.stderr or "exists" in again.stderr
        run("run", path, "--out", out, "--restart")
    rows = table(out.read_text(encoding="utf-8"))[1]
    whole = tmp_path / "whole.csv"
    run.ok("run", path, "--out", whole)
    assert rows == table(whole.read_text(encoding="utf-8"))[1]


@pytest.mark.parametrize(("old", "new", "said"), [
    ('"1", "deg", "deg", "deg"]', '"1", "deg", "deg"]', "expected 6 units, one for each of"),
    ('"a", "e"', '"a", "x"', 'expected words out of "t", "a", "e"'),
    ('"a", "e"', '"a", "ecc"', 'got "ecc"; did you mean "e"?'),
    ('"i", "Omega"', '"inc", "Omega"', 'got "inc"; did you mean "i"?'),
    ('"Omega", "varpi"', '"Omega", "pomega"', 'got "pomega"; did you mean "varpi"?'),
    ('"Omega", "varpi"', '"node", "varpi"', 'got "node"; did you mean "Omega"?'),
    ('"a", "e"', '"e", "e"', 'got "e" twice'),
    ('"a", "e"', '"a", "-"', "expected t, e, i, Omega and one of omega and varpi"),
    ('"kyr", "au"', '"deg", "au"', '"deg" is not a unit of time'),
    ("stop = 50", "stop = 500", "its orbit covers the times -10 to 60 kyr"),
    ('orbit = "mine"', 'orbit = "mars"', "expected the name of an orbit of this file: mine"),
    ('kind = "elements"', 'kind = "kepler"', "with kind = \"kepler\""),
    ("obliquity = 30", "obliquity = 190", "expected an angle from 0 to 180 deg"),
    ("pole = { obliquity = 30, precession = 40 }", "", "expected a key pole, or the name"),
    ("pole = { obliquity = 30, precession = 40 }", "pole = { ra = 1, dec = 2 }",
     "ra and dec need an orbit along axes of J2000"),
    ('precession_rate = "20 deg/kyr"', "", "expected precession_rate, precession_constant"),
    ('precession_rate = "20 deg/kyr"', 'precession_rate = 1\nprecession_constant = 2',
     "expected one of it and precession_rate"),
    ("obliquity = 30", "obliquity = 90", "at an obliquity of 90 deg no rate"),
    ('axes = "inertial"', 'axes = "inertial"\n[output]\ncolumns = ["omega"]',
     'expected columns of kind "obliquity"'),
    ('axes = "inertial"', 'axes = "inertial"\n[output]\ncolumns = ["insolation"]',
     "expected a table planet.insolation"),
    ('axes = "inertial"', 'axes = "inertial"\nattitude = [0, 0, 0, 0]', "attitude"),
    ('orbit = "mine"', 'orbit = "mine"\nJ = "20 deg"', "expected none next to precession_rate"),
    ('orbit = "mine"', 'orbit = "mine"\ntidal_drift = -0.03', "turns the torques round"),
])
def test_what_is_wrong_is_named(mine, old, new, said):
    text = HEAD + TABLE
    assert old in text
    message = mine(text.replace(old, new, 1))
    assert isinstance(message, str) and said in message, message


@pytest.mark.parametrize(("rows", "said"), [
    ([*ROWS[:9], ROWS[8], *ROWS[9:]], "mine.txt:11: time 6 comes twice"),
    ([*ROWS[:9], ROWS[4], *ROWS[9:]], "mine.txt:11: time -2 turns back"),
    ([*ROWS[:20], (300, *ROWS[0][1:]), (302, *ROWS[0][1:])], "mine.txt:22: a gap of 272"),
    ([*ROWS[:9], (8, 1.5, 1.2, 5, 70, 200), *ROWS[10:]], "mine.txt:11: orbit_elements: got "
     "eccentricity 1.2"),
    ([*ROWS[:9], (8, 1.5, 0.2, 185, 70, 200), *ROWS[10:]], "mine.txt:11: an inclination of 180"),
    ([*ROWS[:9], *ROWS[12:]], "mine.txt:11: a gap of 8 before this row"),
    ([ROWS[0]], "row"),
    ([], "expected a table with rows; this file has none"),
    ([(-t, *rest) for t, *rest in ROWS], 'time_direction = "before-present"'),
])
def test_rows_that_are_wrong_are_named(mine, rows, said):
    message = mine(HEAD + TABLE, written(rows))
    assert isinstance(message, str) and said in message, message


def test_intervals_may_grow(mine):
    """A table of any cadence, as long as the cadence does not jump back."""
    slow = [*ROWS[:11], *((t, *ROWS[0][1:]) for t in (14, 20, 30, 40, 50, 60))]
    assert isinstance(mine(HEAD + TABLE, written(slow)), tuple)


def test_events_are_refused_by_their_option(run, tmp_path):
    path = tmp_path / "earth.toml"
    path.write_text(EARTH, encoding="utf-8")
    assert "expected no --events, since this kind" in run.rejected("run", path, "--events",
                                                                   tmp_path / "events.csv")


def test_an_axis_of_a_map_is_in_the_unit_of_its_key(run, table, tmp_path):
    """The rate has a unit of its own, the pole that of the file."""
    head = EARTH.replace("tidal_drift", 'precession_rate = "50 arcsec/yr"\n# ')
    head = head.replace("orbit = ", "pole = { obliquity = 23, precession = 0 }\norbit = ")
    axes = ""
    for key, first in (("precession_rate", 50), ("pole.obliquity", 23)):
        axes += (f'[[map.axis]]\nkey = "planet.{key}"\nfrom = {first}\nto = {first + 1}\n'
                 "count = 2\n")
    path, out = tmp_path / "map.toml", tmp_path / "map.csv"
    path.write_text(head + '[map]\nkind = "column"\ncolumn = "sz"\n' + axes, encoding="utf-8")
    run.ok("map", path, "--out", out)
    text = out.read_text(encoding="utf-8")
    assert "planet.precession_rate [arcsec/yr]" in text and "planet.pole.obliquity [deg]" in text
    for rate, obliquity, *found in table(text)[1]:
        path.write_text(head.replace("50 arcsec", f"{rate} arcsec").replace(
            "obliquity = 23", f"obliquity = {obliquity}"), encoding="utf-8")
        rows = table(run("run", path).stdout)[1]
        assert found[2] == rows[-1][5]


@pytest.mark.parametrize(("step", "stop", "said"), [
    (20, -20000, "needs rows at most 11.8 apart; got 20"),
    (1, -100, "needs rows over 235.9 or more; got 101"),
])
def test_rows_that_show_no_frequency_make_no_map(run, tmp_path, step, stop, said):
    text = EARTH.replace("stop = -1000\nstep = 100", f"stop = {stop}\nstep = {step}")
    path = tmp_path / "map.toml"
    path.write_text(text + '[map]\nkind = "frequency"\n[[map.axis]]\nkey = "planet.J"\n'
                    "from = 0\nto = 0\ncount = 1\n", encoding="utf-8")
    done = run("map", path, "--out", tmp_path / "map.csv")
    assert said in done.stdout + done.stderr, done.stdout + done.stderr


def test_other_kinds_refuse_what_is_not_theirs(run, scenario):
    assert "obliquity is one of kind" in run.rejected("info", scenario(columns='"q", "obliquity"'))
    path = scenario()
    path.write_text(path.read_text(encoding="utf-8") +
                    '[orbit.earth]\nkind = "shipped"\nname = "earth"\n', encoding="utf-8")
    assert "expected a kind with positions" in run.rejected("info", path)


def test_a_template_runs(run, tmp_path):
    text = run("init", "obliquity").stdout
    path = tmp_path / "new.toml"
    path.write_text(text, encoding="utf-8")
    done = run.ok("run", path, "--out", tmp_path / "new.csv")
    assert "obliquity at t = 0" in done.stdout
    assert "[laskar1993]" in run("cite", path).stdout


def test_a_planet_is_caught_in_a_cassini_state_and_escapes(run, table, root):
    """Precession and node: any angle between them, then next to 0, then any again."""
    names, rows = table(run("run", root / "examples/migrating-exoplanet.toml").stdout)
    planet = dict(zip(names, numpy.array(rows, dtype=float).T))
    orbit = numpy.loadtxt(root / "examples/migrating-exoplanet.csv", delimiter=",")
    node = numpy.interp(planet["t"], orbit[:, 0], numpy.unwrap(orbit[:, 3], period=360))
    angle = (planet["precession"] + node + 180) % 360 - 180

    def swing(first, last):
        return numpy.abs(angle[(planet["t"] >= first) & (planet["t"] <= last)]).max()

    assert swing(0, 90e3) > 170 and swing(350e3, 600e3) > 170
    assert swing(150e3, 250e3) < 60
    assert planet["obliquity"][:400].max() < 45 and planet["obliquity"][-1000:].min() > 58
    assert numpy.ptp(planet["obliquity"][-1000:]) < 1
