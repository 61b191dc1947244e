# SPDX-License-Identifier: MIT
"""The columns that observers look for: pole, tumbler, axes of the body, dates."""

import datetime
import math

import budgets
import h5py
import numpy
import pytest
from closeness import assert_allclose

DEGREE = math.pi / 180
OBLIQUITY = 84381.448 / 3600 * DEGREE  # of the ecliptic of J2000, by hand
# Pravec et al. (2014), Icarus 233, 48: P_1 of the long axis, P_phi of the short axis, P_psi; hours
P_LONG, P_SHORT, P_PSI = 30.56, 27.38, 263.0
TUMBLER = """[units]
time = "h"
angle = "deg"
[body]
moments = [0.61, 0.965, 1.0]
[state]
epoch = "{epoch}"
axes = "{axes}"
[state.tumbler]
precession_period = 30.56
rotation_period = 263
pole = {{ {pole} }}
mode = "SAM"
"""


@pytest.fixture
def columns(run, tmp_path):
    """columns(text of a scenario, "pole", ...) -> its columns by name, dates as text."""

    def call(text, *groups, time="stop = 100\nstep = 2.5", extra=""):
        path = tmp_path / "body.toml"
        listed = ", ".join(f'"{group}"' for group in groups)
        path.write_text(f"schema = 1\n{text}\n{extra}[time]\n{time}\n"
                        f"[output]\ncolumns = [{listed}]\n", "utf-8")
        done = run.ok("run", path)
        lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
        cells = [line.split(",") for line in lines[1:]]
        found = {}
        for i, name in enumerate(lines[0].split(",")):
            column = [row[i] for row in cells]
            found[name] = column if name == "date" else numpy.array([float(x) for x in column])
        return found

    return call


def tumbler(epoch="2013-01-05T00:00:00 UTC", axes="ecliptic-J2000",
            pole="longitude = 250, latitude = -75"):
    return TUMBLER.format(epoch=epoch, axes=axes, pole=pole)


def test_pole_is_what_observers_gave(columns):
    c = columns(tumbler(), "pole")
    assert list(c) == ["t", "pole_lon", "pole_lat"]
    assert_allclose(c["pole_lon"], 250, rtol=budgets.observer_columns)
    assert_allclose(c["pole_lat"], -75, rtol=budgets.observer_columns)
    assert len(set(c["pole_lon"])) == 1  # of a free motion it is constant, to the bit


def test_pole_on_the_equator_has_right_ascension_and_declination(columns):
    c = columns(tumbler(axes="equator-J2000"), "pole")
    assert list(c) == ["t", "pole_ra", "pole_dec"]
    # the ecliptic direction turned by hand
    lon, lat = 250 * DEGREE, -75 * DEGREE
    x, y, z = math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)
    c1, s1 = math.cos(OBLIQUITY), math.sin(OBLIQUITY)
    y, z = c1 * y - s1 * z, s1 * y + c1 * z
    assert_allclose(c["pole_ra"], math.atan2(y, x) / DEGREE % 360, rtol=budgets.observer_columns)
    assert_allclose(c["pole_dec"], math.asin(z) / DEGREE, rtol=budgets.observer_columns)


def test_tumbler_gives_the_published_periods_of_apophis(columns):
    c = columns(tumbler(), "tumbler", "euler")
    assert list(c)[1:6] == ["P_phi", "P_psi", "P_short", "psi_max", "mode"]
    assert_allclose(c["P_phi"], P_LONG, rtol=budgets.observer_columns)
    assert_allclose(c["P_psi"], P_PSI, rtol=budgets.observer_columns)
    assert numpy.all(abs(c["P_short"] - P_SHORT) < budgets.published_hours)
    assert numpy.all(c["mode"] == 1)


def test_psi_max_is_the_largest_psi_of_the_rows(columns):
    c = columns(tumbler(), "tumbler", "g", time="stop = 263\ncount = 4001")
    # psi of the tumbler axes: (intermediate, short) are body axes 2 and 3
    psi = numpy.degrees(numpy.arctan2(c["g2"], c["g3"]))
    largest = numpy.max(numpy.abs(psi))
    step = numpy.max(numpy.abs(numpy.diff(psi)))
    assert largest <= c["psi_max"][0] * (1 + budgets.observer_columns)
    assert largest > c["psi_max"][0] - step


def test_tumbler_of_a_long_axis_mode_and_of_a_pure_spin(columns):
    lam = tumbler().replace('mode = "SAM"', 'mode = "LAM"')
    c = columns(lam, "tumbler")
    assert numpy.all(c["mode"] == -1) and numpy.all(numpy.isnan(c["psi_max"]))
    spin = ("[body]\nmoments = [2.0, 3.0, 4.0]\n[state.attitude-rate]\n"
            "quaternion = [1, 0, 0, 0]\nomega_body = [0.0, 0.0, 0.5]\n")
    c = columns(spin, "tumbler")
    assert numpy.all(c["mode"] == 0) and numpy.all(numpy.isnan(c["psi_max"]))
    # Euler's limit of small wobbles: w sqrt((C - A)(C - B)/(A B))
    assert_allclose(c["P_psi"], 2 * math.pi / (0.5 * math.sqrt(2 * 1 / (2 * 3))),
                    rtol=budgets.observer_columns)


def test_periods_follow_the_state_of_a_perturbed_run(columns):
    torque = ('[[perturbation]]\nkind = "constant-torque"\ntorque = [0.0, 0.0, 1e-5]\n'
              'axes = "body"\n')
    text = tumbler()
    c = columns(text, "tumbler", "pole", "g", "q", time="stop = 100\nstep = 50", extra=torque)
    assert c["P_phi"][-1] < c["P_phi"][0]  # the body is spun up
    # each row is the start of a free motion with these periods
    for k in (1, 2):
        momentum = ", ".join(repr(float(c[f"g{i}"][k])) for i in (1, 2, 3))
        again = columns('[units]\ntime = "h"\nangle = "deg"\n[body]\nmoments = [0.61, 0.965, 1.0]\n'
                        "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\n"
                        f"momentum_body = [{momentum}]\n", "tumbler", time="at = [0.0]")
        for name in ("P_phi", "P_psi", "P_short", "psi_max"):
            assert_allclose(c[name][k], again[name][0], rtol=budgets.observer_columns)
    # and its pole that of the momentum, by the matrix of the quaternion
    w, x, y, z = (c[name] for name in ("qw", "qx", "qy", "qz"))
    g1, g2, g3 = (c[name] for name in ("g1", "g2", "g3"))
    gx = (1 - 2 * (y * y + z * z)) * g1 + 2 * (x * y - w * z) * g2 + 2 * (x * z + w * y) * g3
    gy = 2 * (x * y + w * z) * g1 + (1 - 2 * (x * x + z * z)) * g2 + 2 * (y * z - w * x) * g3
    assert_allclose(c["pole_lon"], numpy.degrees(numpy.arctan2(gy, gx)) % 360,
                    rtol=budgets.observer_columns)


@pytest.mark.parametrize("body", ["moments = [1.0, 2.0, 2.5]",
                                  "tensor = [[2.0, 0.1, 0.2], [0.1, 2.5, -0.1], [0.2, -0.1, 1.5]]"])
def test_axes_are_the_columns_of_the_matrix_of_the_attitude(columns, body):
    text = (f"[body]\n{body}\n[frame.precessing]\naxis = [1, 2, 2]\nrate = 0.3\n"
            "[state.attitude-rate]\nquaternion = [0.8, 0.0, 0.6, 0.0]\n"
            "omega_body = [0.1, 0.2, 1]\n")
    c = columns(text, "axis1", "axis2", "axis3", "q_inertial")
    w, x, y, z = (c[name] for name in ("Qw", "Qx", "Qy", "Qz"))
    matrix = {"axis1": (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
              "axis2": (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
              "axis3": (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))}
    for axis, expected in matrix.items():
        for i, name in enumerate("xyz"):
            assert_allclose(c[f"{axis}_{name}"], expected[i], atol=budgets.observer_columns)


def test_dates_count_from_the_epoch(columns):
    c = columns(tumbler("2013-01-05T18:30:00 TT"), "date", time="start = -1\nstop = 2\nstep = 0.3")
    start = datetime.datetime(2013, 1, 5, 18, 30)
    for t, date in zip(c["t"], c["date"], strict=True):
        expected = start + datetime.timedelta(microseconds=round(t * 3.6e9))
        assert date == expected.isoformat()


def test_dates_know_leap_seconds(columns):
    c = columns(tumbler("2016-12-31T23:59:58 UTC").replace('"h"', '"s"'), "date",
                time="stop = 4\nstep = 0.5")
    assert c["date"][:5] == ["2016-12-31T23:59:58", "2016-12-31T23:59:58.500000",
                             "2016-12-31T23:59:59", "2016-12-31T23:59:59.500000",
                             "2016-12-31T23:59:60"]
    assert c["date"][6:] == ["2017-01-01T00:00:00", "2017-01-01T00:00:00.500000",
                             "2017-01-01T00:00:01"]


def test_julian_dates_of_utc_divide_a_day_with_a_leap_second_into_86401_s(columns):
    """As ERFA and astropy do: .0 is half a second after noon. Rows have the dates asked for."""
    asked = ["2016-12-31T13:00:00", "2016-12-31T23:59:60", "2017-01-01T00:00:00"]
    c = columns(tumbler("JD 2457754.0 UTC"), "date", time=f"at = {[0, *asked]}")
    assert c["date"] == ["2016-12-31T12:00:00.500000", *asked]
    assert_allclose(c["t"] * 3600, [0, 3599.5, 43199.5, 43200.5], rtol=budgets.numpy_formula)


def test_dates_in_tdb_differ_from_tt_by_what_it_differs(columns):
    # TDB - TT = 1.657 ms sin g + 0.014 ms sin 2g, g the mean anomaly of the Earth: The Astronomical
    # Almanac, page B7; t counts TT.
    days = [0.0, 91.0, 182.0, 273.0]
    at = ", ".join(str(24.0 * day) for day in days)
    c = columns(tumbler("2013-01-05T00:00:00 TDB"), "date", time=f"at = [{at}]")

    def offset(day):
        g = (357.53 + 0.98560028 * (4753 - 0.5 + day)) * DEGREE  # from 2000-01-01T12:00
        return 0.001657 * math.sin(g) + 0.000014 * math.sin(2 * g)

    for day, date in zip(days, c["date"], strict=True):
        even = datetime.datetime(2013, 1, 5) + datetime.timedelta(days=day)
        seconds = (datetime.datetime.fromisoformat(date) - even).total_seconds()
        assert abs(seconds - (offset(day) - offset(0))) < budgets.tdb_by_one_term


def test_hdf5_and_events_hold_the_same_dates(run, tmp_path):
    path, csv, h5, events = (tmp_path / name for name in ("b.toml", "b.csv", "b.h5", "e.csv"))
    path.write_text("schema = 1\n" + tumbler() + '[[event]]\ncolumn = "pole_lon"\nvalue = 250\n'
                    '[[event]]\ncolumn = "axis3_z"\n[time]\nstop = 200\nstep = 0.7\n'
                    '[output]\ncolumns = ["date", "tumbler"]\n', "utf-8")
    run.ok("run", path, "--out", csv, "--out", h5, "--events", events)
    rows = [line.split(",") for line in csv.read_text().splitlines() if line[0] != "#"][1:]
    with h5py.File(h5) as file:
        assert list(file["date"].attrs["columns"]) == ["date"]
        assert list(file["date"].attrs["units"]) == ["UTC"]
        assert file["date"].shape == (len(rows),)
        assert [date.decode() for date in file["date"][:]] == [row[1] for row in rows]
        assert file["tumbler"].shape == (len(rows), 5)
    found = [line.split(",") for line in events.read_text().splitlines() if line[0] != "#"]
    assert found[0][:4] == ["name", "t", "direction", "date"]
    assert len(found) > 3
    for row in found[1:]:
        even = datetime.datetime(2013, 1, 5) + datetime.timedelta(hours=float(row[1]))
        seconds = (datetime.datetime.fromisoformat(row[3]) - even).total_seconds()
        assert abs(seconds) < budgets.event_date


def test_refusals_say_what_is_missing(run, tmp_path):
    path = tmp_path / "b.toml"
    end = '[time]\nstop = 1\nstep = 1\n[output]\ncolumns = ["date"]\n'
    undated = tumbler().replace('epoch = "2013-01-05T00:00:00 UTC"\n', "")
    ut1 = tumbler("2013-01-05 UT1").replace("axes", 'dut1 = "-0.1 s"\naxes', 1)
    far = "[time]\nat = [1e9]\n[output]\ncolumns = [\"date\"]\n"
    equator = '[[event]]\ncolumn = "pole_ra"\n'
    for text, message in [
        ("schema = 1\n" + undated + end, "expected epoch in [state] for date"),
        ("schema = 1\n" + ut1 + end, "UT1, which does not run evenly"),
        ("schema = 1\n" + tumbler() + far, "expected the years 0 to 9999"),
        ("schema = 1\n" + tumbler() + equator + end, "expected pole_lon or pole_lat with axes"),
        ("schema = 1\n" + tumbler() + equator.replace("pole_ra", "date") + end,
         "event[0].column: got \"date\"; expected a column such as"),
    ]:
        path.write_text(text, "utf-8")
        done = run("run", path)
        assert done.returncode == 2 and message in done.stderr, (message, done.stderr)
        assert len(done.stderr.splitlines()) == 1
