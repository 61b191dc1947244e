# SPDX-License-Identifier: MIT
"""Orbit Ephemeris Messages: read_oem beside the package `oem`, and as the orbit of a scenario."""

import budgets
import numpy as np
import oem
import polhode
import pytest
from closeness import assert_allclose

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


def test_the_package_oem_reads_the_same(path):
    ours = polhode.read_oem(path)
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


def test_the_orbit_of_a_scenario(path, tmp_path):
    """t = 0 is 40 min after the first row; the second segment holds all of the run."""
    [term] = polhode.load(scenario(tmp_path)).system.terms
    for t in (0.0, 12.3, 99.9):
        assert_allclose(term.orbit.position(t), position(2400.0 + 60.0 * t), rtol=budgets.oem_orbit)


def test_the_ecliptic_and_another_time_scale(path, tmp_path):
    ecliptic = polhode.load(scenario(tmp_path, axes="ecliptic-J2000")).system.terms[0].orbit
    angle = np.radians(84381.448 / 3600)
    x, y, z = position(2400.0)
    turned = [x, np.cos(angle) * y + np.sin(angle) * z, np.cos(angle) * z - np.sin(angle) * y]
    assert_allclose(ecliptic.position(0.0), turned, rtol=budgets.oem_orbit)
    # TT = TAI + 32.184 s, exactly; TDB is within 2 ms of TT
    file = tmp_path / "tai.oem"
    file.write_text(TWO.replace("= TDB", "= TAI"), encoding="ascii")
    tt = "2029-04-11T22:26:32.184 TT"
    orbit = polhode.load(scenario(tmp_path, "tai.oem", epoch=tt)).system.terms[0].orbit
    assert_allclose(orbit.position(0.0), position(2400.0), rtol=budgets.oem_orbit)


@pytest.mark.parametrize("options, message", [
    ({"stop": 200}, "expected one with all of the run"),
    ({"epoch": "2029-04-11T21:56:00 TDB"}, "2029-04-11T21:46:00.000 to 2029-04-11T22:06:00.000"),
    ({"axes": "inertial"}, "an OEM has axes"),
    ({"more": 'time_unit = "s"'}, "an OEM says this itself"),
    ({"file": "none.oem"}, "cannot be read"),
])
def test_what_does_not_fit_the_run(path, tmp_path, options, message):
    with pytest.raises(polhode.ScenarioError, match=message):
        polhode.load(scenario(tmp_path, **options))


@pytest.mark.parametrize("old, new, line, message", [
    ("CCSDS_OEM_VERS = 2.0", "CCSDS_AEM_VERS = 2.0", 1, "expected CCSDS_OEM_VERS"),
    ("CENTER_NAME = EARTH\n", "", 11, "no CENTER_NAME"),
    ("TIME_SYSTEM = TDB", "TIME_SYSTEM = UT1", 12, "TIME_SYSTEM: got"),
    (date(60), date(0), 15, "not later than"),
    (date(60), "soon", 15, "expected a date such as"),
    ("COVARIANCE_STOP\n", "", 202, "ends before COVARIANCE_STOP"),
])
def test_what_is_wrong_in_a_file_is_told_with_its_line(path, old, new, line, message):
    assert old in TWO
    path.write_text(TWO.replace(old, new, 1), encoding="ascii")
    with pytest.raises(polhode.DomainError) as error:
        polhode.read_oem(path)
    assert f"sat.oem:{line}: " in str(error.value) and message in str(error.value)


def test_a_frame_that_turns_is_refused(path, tmp_path):
    path.write_text(TWO.replace("EME2000", "ITRF2000"), encoding="ascii")
    with pytest.raises(polhode.ScenarioError, match="expected EME2000, ICRF or GCRF"):
        polhode.load(scenario(tmp_path))
