# SPDX-License-Identifier: MIT
"""Orbit Ephemeris Messages: read_oem against the package `oem`, and as the orbit of a scenario."""

import gzip

import budgets
import numpy as np
import oem
import polhode
import pytest
from closeness import assert_allclose
from polhode import ephemeris
from rejections import rejected

HEAD = "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2029-01-01T00:00:00\nORIGINATOR = NOBODY\n"
GM = 398600.4418
ORBIT = polhode.KeplerOrbit(polhode.KeplerElements(
    gm=GM, pericentre=7000.0, eccentricity=0.1, inclination=1.0, node=0.3, argument=2.0,
))
STEP = 60.0  # s


def meta(first, last, frame="EME2000", system="TDB", more=""):
    return (f"META_START\nOBJECT_NAME = SAT\nOBJECT_ID = 2029-001A\nCENTER_NAME = EARTH\n"
            f"REF_FRAME = {frame}\nTIME_SYSTEM = {system}\nSTART_TIME = {date(first)}\n{more}"
            f"STOP_TIME = {date(last)}\nMETA_STOP\n")


def date(t):
    """t s after 2029-04-11T21:46:00."""
    moment = np.datetime64("2029-04-11T21:46:00.000", "ms") + np.timedelta64(round(1000 * t), "ms")
    return str(moment)


def position(t):
    return np.array(ORBIT.position(t))


def velocity(t, h=0.5):
    """Sixth-order differences of positions."""
    weights = zip((1, 2, 3), (0.75, -0.15, 1 / 60), strict=True)
    return sum(w * (position(t + k * h) - position(t - k * h)) for k, w in weights) / h


def rows(first, last):
    lines = []
    for t in np.arange(first, last + STEP / 2, STEP):
        numbers = " ".join(repr(float(x)) for x in (*position(t), *velocity(t)))
        lines.append(f"{date(t)} {numbers}\n")
    return "".join(lines)


COVARIANCE = "COVARIANCE_START\nEPOCH = " + date(0) + "\nCOV_REF_FRAME = EME2000\n" + "".join(
    " ".join(["1.0e-3"] * k) + "\n" for k in range(1, 7)) + "COVARIANCE_STOP\n"
TWO = (HEAD + meta(0, 1200) + "COMMENT a thruster fires behind this\n" + rows(0, 1200) + COVARIANCE
       + meta(1200, 9000) + rows(1200, 9000))


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "sat.oem"
    file.write_text(TWO, encoding="ascii")
    return file


def test_a_packed_message_with_a_byte_order_mark_is_the_same(path, tmp_path):
    packed = tmp_path / "sat.oem.gz"
    packed.write_bytes(gzip.compress(b"\xef\xbb\xbf" + path.read_bytes()))
    for one, other in zip(ephemeris.read_oem(path).segments, ephemeris.read_oem(packed).segments,
                          strict=True):
        assert np.array_equal(one.position, other.position)
    there, here = (polhode.load(scenario(tmp_path, file.name)).orbits["earth"].position(50.0)
                   for file in (packed, path))
    assert np.array_equal(there, here)


def test_the_package_oem_reads_the_same(path):
    ours = ephemeris.read_oem(path)
    theirs = oem.OrbitEphemerisMessage.open(path)
    assert ours.version == theirs.header["CCSDS_OEM_VERS"] == "2.0"
    segments = list(theirs.segments)
    assert [len(s) for s in ours.segments] == [21, 131] == [len(list(s)) for s in segments]
    for mine, other in zip(ours.segments, segments, strict=True):
        states = list(other)
        assert np.array_equal(mine.position, [s.position for s in states])
        assert np.array_equal(mine.velocity, [s.velocity for s in states])
        assert mine.frame == other.metadata["REF_FRAME"]
        assert mine.object_id == other.metadata["OBJECT_ID"]
        passed = [(s.epoch - segments[0].metadata["START_TIME"]).sec
                  if isinstance(segments[0].metadata["START_TIME"], type(s.epoch))
                  else (s.epoch - next(iter(segments[0])).epoch).sec for s in states]
        assert_allclose(mine.t, passed, atol=budgets.oem_times)


def scenario(tmp_path, file="sat.oem", axes="equator-J2000", epoch="2029-04-11T22:26:00 TDB",
             stop=100, more=""):
    text = f"""schema = 1
[units]
time = "min"
length = "km"
[body]
moments = [1, 2, 2.5]
[state]
epoch = "{epoch}"
axes = "{axes}"
[state.attitude-rate]
quaternion = [1, 0, 0, 0]
omega_body = [0.01, 0.02, 0.1]
[orbit.earth]
kind = "table"
gm = "{GM} km3/s2"
file = "{file}"
{more}
[[perturbation]]
kind = "gravity-gradient"
orbit = "earth"
[time]
stop = {stop}
step = 10
"""
    path = tmp_path / "a.toml"
    path.write_text(text, encoding="utf-8")
    return path


KEPLER = f"""gm = "{GM} km3/s2"
pericentre = 7000.0
eccentricity = 0.1
inclination = 1.0
node = 0.3
pericentre_argument = 2.0
epoch = -40
"""


@pytest.mark.parametrize("times", [(0, 4900), (0, 2500, 5000)])
def test_a_few_rows_that_are_too_far_apart_are_rejected(tmp_path, times):
    lines = [" ".join([date(t), *(repr(float(x)) for x in (*position(t), *velocity(t)))])
             for t in times]
    text = HEAD + meta(times[0], times[-1]) + "\n".join(lines) + "\n"
    (tmp_path / "sat.oem").write_text(text, encoding="ascii")
    with pytest.raises(polhode.ScenarioError, match="rows that are too far apart"):
        polhode.load(scenario(tmp_path, epoch="2029-04-11T21:46:00 TDB", stop=80))


def last_attitude(path):
    run = polhode.load(path).run()
    return run.groups["q"][-1]


def same_attitude(q, p):
    assert_allclose(q * np.sign(q @ p), p, atol=budgets.oem_run)


@pytest.fixture
def by_elements(tmp_path):
    """The attitude after a run with the orbit as elements; the message begins 40 min before."""
    path = scenario(tmp_path)
    text = path.read_text(encoding="utf-8")
    head, tail = text.split('kind = "table"\n')
    rest = tail.split("[[perturbation]]")[1]
    path.write_text(f"{head}{KEPLER}[[perturbation]]{rest}", encoding="utf-8")
    q = last_attitude(path)
    path.write_text(path.read_text(encoding="utf-8").replace("epoch = -40", "epoch = -41"),
                    encoding="utf-8")
    # a minute along the orbit shows
    assert np.abs(last_attitude(path) - q).max() > 100 * budgets.oem_run
    return q


def test_the_orbit_of_a_scenario(path, tmp_path, by_elements):
    file = scenario(tmp_path)
    same_attitude(last_attitude(file), by_elements)
    assert "ccsds502" in {citation.key for citation in polhode.load(file).citations}


def test_the_ecliptic(path, tmp_path, by_elements):
    """The same motion in other axes: all of it turned about axis 1."""
    half = np.radians(84381.448 / 3600) / 2
    c, s = float(np.cos(half)), float(np.sin(half))
    file = scenario(tmp_path, axes="ecliptic-J2000")
    text = file.read_text(encoding="utf-8").replace("[1, 0, 0, 0]", f"[{c!r}, {-s!r}, 0, 0]")
    file.write_text(text, encoding="utf-8")
    w, x, y, z = by_elements
    same_attitude(last_attitude(file), np.array([c * w + s * x, c * x - s * w, c * y + s * z,
                                                 c * z - s * y]))


@pytest.mark.parametrize("system, epoch", [
    ("TAI", "2029-04-11T22:26:32.184 TT"),  # TT = TAI + 32.184 s
    ("GPS", "2029-04-11T22:26:51.184 TT"),  # TAI = GPS + 19 s
    ("UTC", "2029-04-11T22:27:09.184 TT"),  # TAI = UTC + 37 s
    ("TT", "JD 2462238.434722222222 TT"),
    ("UTC", '2029-04-11T22:26:00.25 UT1"\ndut1 = "0.25 s'),
])
def test_another_time_scale(path, tmp_path, by_elements, system, epoch):
    file = tmp_path / "other.oem"
    file.write_text(TWO.replace("= TDB", f"= {system}"), encoding="ascii")
    same_attitude(last_attitude(scenario(tmp_path, "other.oem", epoch=epoch)), by_elements)


def test_clocks_of_two_scales_may_show_the_same_end(path, tmp_path):
    """In April the last date in TDB is 1.6 ms before the same date in TT."""
    scene = polhode.load(scenario(tmp_path, epoch="2029-04-11T22:26:00 TT", stop=110))
    run = scene.run()
    assert run.t[-1] == 110 and np.isfinite(run.groups["q"]).all()
    assert scene.orbits["earth"].last_time < 110
    with pytest.raises(polhode.ScenarioError, match="expected one with all of the run"):
        polhode.load(scenario(tmp_path, epoch="2029-04-11T22:26:00.010 TDB", stop=110))


@pytest.mark.parametrize("options, message", [
    ({"stop": 200}, "expected one with all of the run"),
    ({"epoch": "2029-04-11T21:56:00 TDB"}, "2029-04-11T21:46:00.000 to 2029-04-11T22:06:00.000"),
    ({"axes": "inertial"}, "an OEM has axes"),
    ({"more": 'time_unit = "s"'}, "an OEM says this itself"),
    ({"file": "none.oem"}, "cannot be read"),
])
def test_what_does_not_fit_the_run(path, tmp_path, options, message):
    rejected(polhode.ScenarioError, message, polhode.load, scenario(tmp_path, **options))


@pytest.mark.parametrize("old, new, line, message", [
    ("CCSDS_OEM_VERS = 2.0", "CCSDS_AEM_VERS = 2.0", 1, "expected CCSDS_OEM_VERS"),
    ("CENTER_NAME = EARTH\n", "", 11, "no CENTER_NAME"),
    ("TIME_SYSTEM = TDB", "TIME_SYSTEM = UT1", 12, "TIME_SYSTEM: got"),
    (date(60), date(0), 15, "not later than"),
    (date(60), "soon", 15, "expected a date such as"),
    ("COVARIANCE_STOP\n", "", 183, "ends before COVARIANCE_STOP"),
    (date(60), "2029-04-10T23:59:60", 15, "expected a date such as"),  # no leap second in TDB
])
def test_what_is_wrong_in_a_file_is_told_with_its_line(path, old, new, line, message):
    assert old in TWO
    path.write_text(TWO.replace(old, new, 1), encoding="ascii")
    with pytest.raises(polhode.DomainError) as error:
        ephemeris.read_oem(path)
    assert f"sat.oem:{line}: " in str(error.value) and message in str(error.value)


def test_a_frame_that_turns_is_refused(path, tmp_path):
    path.write_text(TWO.replace("EME2000", "ITRF2000"), encoding="ascii")
    rejected(polhode.ScenarioError, "sat.oem:8: REF_FRAME = ITRF2000; expected EME2000, ICRF",
             polhode.load, scenario(tmp_path))
