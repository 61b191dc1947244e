# SPDX-License-Identifier: MIT
"""Dates, tables of positions and planets from Python; the Earth under Sun and Moon."""

import copy
import datetime
import math
import pickle
import warnings

import astropy.time
import budgets
import numpy as np
import pandas as pd
import polhode
import pytest
from closeness import assert_allclose
from polhode import ephemeris
from rejections import rejected
from scenario_texts import ROOT


def test_dates_change_their_scale():
    leap = ephemeris.calendar_date("UTC", 2016, 12, 31, 23, 59, 60.0)
    new_year = ephemeris.calendar_date(ephemeris.TimeScale.UTC, 2017, 1, 1)
    assert_allclose(
        ephemeris.seconds_between(leap, new_year), 1.0, atol=budgets.date_second
    )
    assert leap.to("TT").scale == ephemeris.TimeScale.TT
    assert leap.to("TT").to("UTC").calendar[:5] == (2016, 12, 31, 23, 59)
    assert_allclose(leap.to("TT").to("UTC").calendar[5], 60.0, atol=1e3 * budgets.date_second)
    later = ephemeris.date_after(new_year, 69.184)
    assert_allclose(
        ephemeris.seconds_between(new_year, later), 69.184, atol=budgets.date_second
    )
    assert pickle.loads(pickle.dumps(leap)) == leap != new_year
    assert repr(ephemeris.Date("TT", 2451545)) == "Date('TT', 2451545.0, 0.0)"
    assert ephemeris.calendar_date("UTC", 1950, 1, 1).is_dubious and not new_year.is_dubious
    for wrong in ((2015, 12, 31, 23, 59, 60.0), (2015, 2, 29), (2015, 13, 1)):
        rejected(ValueError, "must be one of the calendar", ephemeris.calendar_date, "UTC", *wrong)
    rejected(ValueError, "UT1 - UTC must be given", new_year.to, "UT1")
    rejected(ValueError, "expected one of UTC TAI", ephemeris.Date, "GPS", 2451545)


def test_dates_are_texts_too():
    """As the epoch of a scenario is one."""
    text = "2016-12-31T23:59:60.5 UTC"
    assert ephemeris.Date(text) == ephemeris.calendar_date(
        "UTC", 2016, 12, 31, 23, 59, 60.5
    )
    assert ephemeris.Date("JD 2456297.5 TDB") == ephemeris.Date("TDB", 2456297, 0.5)
    text = "2029-04-13T21:46:00 UTC"
    there = ephemeris.planetary_position("moon", "earth", ephemeris.Date(text))
    assert np.array_equal(there, ephemeris.planetary_position("moon", "earth", text))
    for wrong, what in (
        ("2013-02-30 UTC", "no such day in the calendar: day 30 must be from 1 to 28"),
        ("2013-13-01 UTC", "no such day in the calendar: month 13 must be from 1 to 12"),
        ("2013-01-05", "time scale is missing"),
        ("JD 2456297.5Z", "is not a time scale"),
    ):
        rejected(ValueError, f'Date: got "{wrong}"; .*{what}', ephemeris.Date, wrong)
    for day, fraction in ((math.nan, 0), (2451545, math.inf)):
        with pytest.raises(ValueError, match="Date: day .* and fraction .* must be finite"):
            ephemeris.Date("TT", day, fraction)
    rejected(
        ValueError, "its month 13 from 1 to 12", ephemeris.calendar_date, "TT", 2013, 13, 1
    )


def test_tables_are_orbits():
    t = np.linspace(0, 10, 101)
    x = np.column_stack([np.cos(t), np.sin(t), 0.1 * t])
    v = np.column_stack([-np.sin(t), np.cos(t), np.full_like(t, 0.1)])
    for orbit in (polhode.TableOrbit(t, x), polhode.TableOrbit(t, x, v, order=8)):
        s = np.linspace(0, 10, 37)
        assert_allclose(orbit.position(s)[:, 0], np.cos(s), atol=budgets.python_table)
        assert_allclose(orbit.velocity(s)[:, 0], -np.sin(s), atol=budgets.python_table_slope)
        assert orbit.position(5.0).shape == (3,) and np.isnan(orbit.position(10.1)).all()
        assert np.array_equal(orbit.positions, x) and np.array_equal(orbit.times, t)
        for same in (pickle.loads(pickle.dumps(orbit)), copy.copy(orbit)):
            assert np.array_equal(same.position(s), orbit.position(s))
        term = polhode.GravityGradient(orbit, 1.0)
        assert term.orbit is orbit
    assert (orbit.order, orbit.has_velocities, orbit.is_evenly_spaced) == (8, True, True)
    assert repr(orbit) == "TableOrbit(101 rows from 0.0 to 10.0, order=8)"
    for arguments, what in (((t[::-1], x), "must be after"),
                            ((t, x[:50]), "positions: expected the shape"),
                            ((t[:3], x[:3]), "3 rows must be 4 at least"),
                            ((t, x, v[:, :2]), "velocities")):
        rejected(ValueError, what, polhode.TableOrbit, *arguments)


def test_tables_of_few_rows_or_with_a_gap_are_judged():
    def circle(t, order=0, velocities=True):
        x = np.column_stack([np.cos(t), np.sin(t), 0 * t])
        return polhode.TableOrbit(t, x, x[:, [1, 0, 2]] * [-1, 1, 0] if velocities else None, order)

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert circle(np.array([0.0, 0.0108])).interpolation_error > 0
    for t in (np.array([0.0, 5.4]), np.arange(3) * 3.2, np.array([0.0, 2 * np.pi])):
        with pytest.warns(UserWarning, match="TableOrbit: rows that are too far apart: between"):
            circle(t)
    with pytest.warns(UserWarning, match="error cannot be estimated from so few rows"):
        assert np.isnan(circle(np.arange(3) * 0.1, 2, velocities=False).interpolation_error)
    least = budgets.table_orbit_estimate_coarse
    long = 0.01 * np.delete(np.arange(100002), np.s_[20000:21000])
    with pytest.warns(UserWarning, match="too far apart"):
        assert circle(long, velocities=False).interpolation_error > least


def test_a_run_that_leaves_its_table_fails_with_a_sentence():
    t = np.linspace(0, 10, 101)
    orbit = polhode.TableOrbit(t, np.column_stack([np.cos(t), np.sin(t), 0 * t]))
    system = polhode.System(polhode.Body(1, 2, 2.7), terms=[polhode.GravityGradient(orbit, 1.0)])
    start = polhode.RotorState([0.5, 0.5, -0.5, 0.5], [0.8, 1.9, 0.3])
    for method in (polhode.Adaptive(), polhode.Splitting(0.07), polhode.VariationOfConstants()):
        assert polhode.integrate(polhode.Problem(system, start, 0, 10, method)).outcome.ok
        with pytest.warns(RuntimeWarning, match='"GravityGradient" is not .*finite.*stop before'):
            run = polhode.integrate(polhode.Problem(system, start, 0, 12, method))
        assert not run.outcome.ok and run.t[-1] <= 10


def test_planets_are_where_their_tables_put_them():
    epoch = ephemeris.calendar_date("UTC", 2020, 2, 3)
    orbit = ephemeris.planetary_orbit("moon", "earth", epoch, 0, 10 * 86400)
    for t in (0.0, 12345.6, 864000.0):
        truth = ephemeris.planetary_position(
            "moon", "earth", ephemeris.date_after(epoch, t)
        )
        assert_allclose(orbit.position(t), truth, atol=budgets.ephemeris_orbit * 4e5)
    assert_allclose(ephemeris.planetary_gm("earth"), 398600.4, rtol=budgets.ephemeris_gm)
    with pytest.raises(ValueError, match="1000 to 3000"):
        ephemeris.planetary_position(
            "moon", "sun", ephemeris.calendar_date("TT", 800, 1, 1)
        )
    rejected(
        ValueError, "must not both be mars", ephemeris.planetary_position, "mars", "mars", epoch
    )


@pytest.fixture(scope="module")
def earth():
    return polhode.load(ROOT / "examples/earth.toml").run()


def nutation(run, squared):
    """Rate and the terms of 18.6, 9.3, 1, 0.5 yr of the figure axis, arcsec: by least squares, with
    the arguments of Sun and Moon (Simon et al. 1994)."""
    year = run.t / 365.25
    T = year / 100
    psi = 3600 * (180 - np.degrees(np.unwrap(np.radians(run["h_f"]))))
    node = np.radians(125.04455501 - 1934.1361849 * T)
    anomaly = np.radians(357.52910918 + 35999.0502909 * T)
    longitude = np.radians(280.46646 + 36000.76983 * T)
    columns = [f(x) for x in (node, 2 * node, anomaly, 2 * longitude) for f in (np.cos, np.sin)]
    columns += [np.ones_like(year), year - year.mean()]
    columns += [(year - year.mean()) ** 2] if squared else []
    both = np.column_stack([psi, 3600 * run["I_f"]])
    return np.linalg.lstsq(np.column_stack(columns), both, rcond=None)[0]


@pytest.mark.parametrize("squared", [False, True])
def test_the_earth_precesses_and_nutates(earth, squared):
    """REN-2000 (Souchay et al. 1999), with the same (C - A)/C."""
    assert earth.t[-1] > 37.2 * 365.25
    of_psi, of_eps = nutation(earth, squared).T
    assert abs(of_psi[9] - 50.40) < budgets.published_precession * 50.40
    assert abs(of_psi[1] + 17.2806) < budgets.published_nutation * 17.2806
    assert abs(of_eps[0] - 9.2279) < budgets.published_nutation * 9.2279
    # out of phase: nothing in a rigid body
    assert abs(of_psi[0]) < budgets.published_nutation * 17.2806
    assert abs(of_eps[1]) < budgets.published_nutation * 9.2279


def test_the_precession_is_that_of_the_averaged_torque(earth):
    """First order, closed form: 3/2 H/omega cos(eps) sum gm/a^3 (1 - e^2)^(-3/2), of the Moon times
    1 - 3/2 sin^2 i; good to the evection and the variation."""
    H, spin, eps = 0.0032737548, 7.292115e-5, np.radians(84381.4 / 3600)
    n_sun, n_moon = 2 * np.pi / (365.256363 * 86400), 2 * np.pi / (27.321662 * 86400)
    ratio = ephemeris.planetary_gm("moon") / (
        ephemeris.planetary_gm("moon") + ephemeris.planetary_gm("earth")
    )
    strength = n_sun**2 * (1 - 0.0167086**2) ** -1.5 + ratio * n_moon**2 * (
        1 - 0.0549006**2
    ) ** -1.5 * (1 - 1.5 * np.sin(np.radians(5.1454)) ** 2)
    rate = 1.5 * H / spin * np.cos(eps) * strength * 365.25 * 86400
    of_psi = nutation(earth, False)[:, 0]
    assert_allclose(of_psi[9], np.degrees(rate) * 3600, rtol=budgets.averaged_precession)



UTC = datetime.timezone.utc


class Time:
    """As astropy has it, as far as a Date looks."""

    def __init__(self, jd1, jd2, scale, shape=()):
        self.jd1, self.jd2, self.scale, self.shape = jd1, jd2, scale, shape

    def __repr__(self):
        return "<Time>"


def test_dates_of_datetimes():
    """A time zone makes it UTC; without one the scale must be said."""
    there = ephemeris.calendar_date("UTC", 2029, 4, 13, 21, 46, 1.25)
    utc = datetime.datetime(2029, 4, 13, 21, 46, 1, 250000, UTC)
    west = utc.astimezone(datetime.timezone(datetime.timedelta(hours=-5)))
    assert ephemeris.Date(utc) == ephemeris.Date(west) == ephemeris.Date(west, "UTC") == there
    naive = utc.replace(tzinfo=None)
    for scale in ("UTC", "TAI", "TT", "TDB", ephemeris.TimeScale.UT1):
        assert ephemeris.Date(naive, scale) == ephemeris.calendar_date(
            scale, 2029, 4, 13, 21, 46, 1.25)
    stamp = pd.Timestamp("2029-04-13T21:46:01.000000250", tz="UTC")
    assert_allclose(ephemeris.seconds_between(
        ephemeris.Date(stamp), there
    ), 0.24999975,
                    atol=budgets.date_second)
    assert np.array_equal(ephemeris.planetary_position("moon", "earth", utc),
                          ephemeris.planetary_position("moon", "earth", there))
    rejected(
        ValueError, "has no time zone; expected tzinfo=.*utc, or a scale", ephemeris.Date, naive
    )
    with pytest.raises(ValueError, match="has a time zone and hence is UTC; expected no scale"):
        ephemeris.Date(utc, "TDB")
    rejected(
        ValueError, "no time zone", ephemeris.planetary_position, "moon", "earth", naive
    )
    with pytest.raises(TypeError, match=r"Date: instant: got datetime.date\(2029, 4, 13\); exp"):
        ephemeris.Date(utc.date())


@pytest.mark.parametrize(("text", "calendar"), [
    ("2029-04-13T21:46:59.999999999", (2029, 4, 13, 21, 46, 59.999999999)),
    ("1929-02-28T23:59:59.5", (1929, 2, 28, 23, 59, 59.5)),
    ("-4000-03-01T00:00:01", (-4000, 3, 1, 0, 0, 1.0)),
    ("2029-04-13", (2029, 4, 13, 0, 0, 0.0)),
    ("2029-04", (2029, 4, 1, 0, 0, 0.0)),
    ("2029", (2029, 1, 1, 0, 0, 0.0)),
])
def test_dates_of_datetime64(text, calendar):
    """NumPy's instants have no scale."""
    instant = np.datetime64(text)
    for scale in ("TT", "TDB"):
        assert ephemeris.Date(instant, scale) == ephemeris.calendar_date(scale, *calendar)
    with pytest.raises(ValueError, match=r"has no scale; expected one: Date\(instant, \"UTC\"\)"):
        ephemeris.Date(instant)


@pytest.mark.parametrize(("call", "error", "message"), [
    (lambda: ephemeris.Date(np.datetime64("NaT"), "TT"), ValueError, "NaT.*; expected a date"),
    (lambda: ephemeris.Date(np.datetime64("20000-01-01"), "TT"), ValueError,
     "expected a year from -4799 to 9999"),
    (lambda: ephemeris.Date(np.array(["2029-04-13"], "datetime64[s]"), "TT"), TypeError,
     "Date: instant: got array"),
])  # fmt: skip
def test_datetime64_that_is_no_date(call, error, message):
    rejected(error, message, call)


def test_dates_of_the_time_of_astropy():
    """Of whatever has jd1, jd2 and scale; astropy's own has the Julian dates of ERFA, too."""
    assert ephemeris.Date(Time(2462240.0, 0.25, "tdb")) == ephemeris.Date("TDB", 2462240.0, 0.25)
    assert ephemeris.Date(Time(2462240.0, 0.25, "utc"), "UTC") == ephemeris.Date(
        "UTC", 2462240.0, 0.25)
    leap = astropy.time.Time("2016-12-31T23:59:60.5", scale="utc")
    assert_allclose(ephemeris.seconds_between(
        ephemeris.Date(leap), ephemeris.Date("2016-12-31T23:59:60.5 UTC")), 0.0,
        atol=budgets.date_second)
    assert np.array_equal(ephemeris.j2000_from_teme(leap), ephemeris.j2000_from_teme(
        ephemeris.Date(leap)))
    for time, said in (
        (Time(2462240.0, 0.0, "tcb"), "<Time> in the scale tcb; expected utc, tai, tt, tdb or ut1"),
        (Time([2462240.0], [0.0], "tdb", (1,)), "<Time>, an array; expected one instant"),
        (Time(math.nan, 0.0, "tdb"), "<Time>; expected a date"),
    ):
        rejected(ValueError, said, ephemeris.Date, time)
    with pytest.raises(ValueError, match="<Time>, whose scale is TDB; expected no other scale"):
        ephemeris.Date(Time(2462240.0, 0.0, "tdb"), "UTC")


def test_a_text_may_have_its_scale_beside_it():
    assert ephemeris.Date("2029-04-13T21:46", "TDB") == ephemeris.Date(
        "2029-04-13T21:46:00 TDB"
    )
