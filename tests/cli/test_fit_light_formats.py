# SPDX-License-Identifier: MIT
"""One night in every form that `polhode fit` reads: magnitudes, dates, Julian dates, fluxes of the
distances of the time, ALCDEF. The fit is the same, since the light is."""

import datetime
import math

import budgets
import numpy
import pytest
from fit_files import ORBITS, TUMBLING, fitted, refused, rows

HEAD = f"""schema = 1
kind = "fit"
[units]
time = "min"
angle = "deg"
length = "au"
[body]
moments = [0.5625, 1.2025, 1.36]
[state]
epoch = "2013-01-05T00:00:00 UTC"
axes = "ecliptic-J2000"
{TUMBLING}[time]
start = -60
stop = 180
count = 161
[simulate]
sessions = [0, 120]
[free]
unknowns = ["attitude", "rate", "shape"]
"""
TABLE = """
[[observation]]
kind = "light-curve"
file = "%s"
times = "at-body"
"""
VECTORS = "to_sun = [1, 0.2, 0.3]\nto_observer = [0.8, 0.6, 0.1]\n"
SLOPE = 0.4 * numpy.log(10)  # of a flux by its magnitude, over the flux
JULIAN = 2456297.5  # of the epoch
TT = 67.184 / 60  # TT - UTC, min


@pytest.fixture
def night(run, fit_file, tmp_path):
    """Columns of a simulated night, and what a fit of them comes to."""
    table = TABLE % "night.csv" + VECTORS + "sigma = 0.02\n"
    path = fit_file(table, head=HEAD)
    run.ok("simulate", path, "--into", tmp_path)
    read = fit_file(TABLE % "night.csv" + VECTORS + 'sigma_columns = ["sigma"]\n', head=HEAD)
    return rows(tmp_path / "night.csv"), fitted(run, read)["solutions"][0]


def write(path, **columns):
    lines = [",".join(columns)] + [
        ",".join(x if isinstance(x, str) else repr(float(x)) for x in row)
        for row in zip(*columns.values(), strict=True)]
    path.write_text("\n".join(lines) + "\n")


def same(run, path, expected):
    found = fitted(run, path)["solutions"][0]
    assert found["chi_square"] == pytest.approx(expected["chi_square"], rel=budgets.cli_fit_starts)
    assert found["precession_period"]["value"] == pytest.approx(
        expected["precession_period"]["value"], rel=budgets.cli_fit_starts)


def test_magnitudes_are_fluxes(run, night, fit_file, tmp_path):
    light, expected = night
    write(tmp_path / "m.csv", t=light["t"], magnitude=3 - 2.5 * numpy.log10(light["flux"]),
          error=light["sigma"] / light["flux"] / SLOPE)
    table = (TABLE % "m.csv" + VECTORS + 'brightness = "magnitude"\nsigma_columns = ["error"]\n')
    same(run, fit_file(table, head=HEAD, name="m.toml"), expected)


@pytest.mark.parametrize(("form", "scale", "time"), [
    ("MJD", "TT", lambda t: JULIAN - 2400000.5 + (t + TT) / 1440),
    ("JD", "UTC", lambda t: JULIAN + t / 1440),
    ("date", "UTC", lambda t: [
        (datetime.datetime(2013, 1, 5) + datetime.timedelta(minutes=x)).isoformat() for x in t]),
])
def test_times_are_dates(run, night, fit_file, tmp_path, form, scale, time):
    light, expected = night
    write(tmp_path / "d.csv", t=time(light["t"]), flux=light["flux"],
          error=light["sigma"])
    table = (TABLE % "d.csv" + VECTORS + 'sigma_columns = ["error"]\n'
             f'time_format = "{form}"\ntime_scale = "{scale}"\n')
    found = fitted(run, fit_file(table, head=HEAD, name="d.toml"))["solutions"][0]
    # a Julian date in double has 0.04 ms
    assert found["chi_square"] == pytest.approx(expected["chi_square"], rel=budgets.cli_julian)


def test_fluxes_of_the_time_have_their_distances(run, night, fit_file, tmp_path):
    """Distances that change by a factor of two, and fluxes with them; without the key the fit is
    another one."""
    light, expected = night
    r, d = 1 + light["t"] / 120, 0.1 + light["t"] / 600
    sun, eye = (numpy.array(v) / numpy.linalg.norm(v) for v in ([1, 0.2, 0.3], [0.8, 0.6, 0.1]))
    write(tmp_path / "f.csv", t=light["t"], flux=light["flux"] / (r * d)**2,
          error=light["sigma"] / (r * d)**2,
          **{f"sun_{a}": r * x for a, x in zip("xyz", sun)},
          **{f"observer_{a}": d * x for a, x in zip("xyz", eye)})
    table = (TABLE % "f.csv" + 'sigma_columns = ["error"]\nof_the_time = true\n'
             'sun_columns = ["sun_x", "sun_y", "sun_z"]\n'
             'observer_columns = ["observer_x", "observer_y", "observer_z"]\n')
    same(run, fit_file(table, head=HEAD, name="f.toml"), expected)
    plain = fit_file(table.replace("= true", "= false"), head=HEAD, name="plain.toml")
    done = run("fit", plain, "--json")
    assert done.returncode != 0 or "chi_square" in done.stdout and (
        fitted(run, plain)["solutions"][0]["chi_square"] > 10 * expected["chi_square"])


ALCDEF = """STARTMETADATA
OBJECTNUMBER=99942
OBJECTNAME=Tumbler
SESSIONDATE=2013-01-05
SESSIONTIME=01:00:00
FILTER=C
MAGBAND=C
DIFFERMAGS=TRUE
STANDARD=NONE
LTCAPP=%s
LTCDAYS=-0.005
REDUCEDMAGS=POINT
DELIMITER=PIPE
ENDMETADATA
"""


def test_alcdef_through_a_scenario(run, fit_file, tmp_path):
    """As columns at the observer, with vectors and light time of orbits."""
    orbits = 'orbit = "body"\nobserver_orbit = "earth"\n'
    observed = (TABLE % "seen.csv").replace("at-body", "at-observer") + orbits
    path = fit_file(observed + "sigma = 0.02\n", ORBITS, head=HEAD)
    run.ok("simulate", path, "--into", tmp_path)
    own = fit_file(observed + 'sigma_columns = ["sigma"]\n', ORBITS, head=HEAD, name="own.toml")
    expected = fitted(run, own)["solutions"][0]
    light = rows(tmp_path / "seen.csv")
    data = "".join(
        f"DATA={JULIAN + t / 1440!r}|{-2.5 * math.log10(flux)!r}|{float(s / flux / SLOPE)!r}\n"
        for t, flux, s in zip(*(light[n].tolist() for n in ("t", "flux", "sigma")), strict=True))
    table = (observed.replace("seen.csv", "seen.alcdef")
             + 'format = "alcdef"\ntime_format = "JD"\ntime_scale = "UTC"\n'
             "sigma = 0.5\n")  # of points without an error, which there are not
    read = fit_file(table, ORBITS, head=HEAD, name="alcdef.toml")
    (tmp_path / "seen.alcdef").write_text(ALCDEF % "NONE" + data + "ENDDATA\n")
    found = fitted(run, read)["solutions"][0]
    assert found["chi_square"] == pytest.approx(expected["chi_square"], rel=budgets.cli_julian)
    (tmp_path / "seen.alcdef").write_text(ALCDEF % "POINT" + data + "ENDDATA\n")
    assert 'expected "at-body", as the file says of its times' in refused(run, read)
    # its own errors, dates that the format implies, and EPOCH of the star it was compared with
    (tmp_path / "seen.alcdef").write_text((ALCDEF % "NONE").replace(
        "FILTER=C", "EPOCH=2013.0\nEPOCH=J2000.0\nFILTER=C") + data + "ENDDATA\n")
    bare = fit_file(observed.replace("seen.csv", "seen.alcdef") + 'format = "alcdef"\n', ORBITS,
                    head=HEAD, name="bare.toml")
    found = fitted(run, bare)["solutions"][0]
    assert found["chi_square"] == pytest.approx(expected["chi_square"], rel=budgets.cli_julian)


def test_alcdef_is_simulated(run, fit_file, tmp_path):
    """The same light as in columns, and a fit reads it."""
    observed = (TABLE % "seen.csv").replace("at-body", "at-observer") + (
        'orbit = "body"\nobserver_orbit = "earth"\nsigma = 0.02\nbrightness = "magnitude"\n')
    path = fit_file(observed, ORBITS, head=HEAD)
    run.ok("simulate", path, "--into", tmp_path)
    light = rows(tmp_path / "seen.csv")
    table = observed.replace("seen.csv", "seen.alcdef").replace(
        'brightness = "magnitude"', 'format = "alcdef"')
    own = fit_file(table, ORBITS, head=HEAD, name="own.toml")
    run.ok("simulate", own, "--into", tmp_path)
    data = numpy.array([line.removeprefix("DATA=").split("|") for line in (
        tmp_path / "seen.alcdef").read_text().splitlines() if line.startswith("DATA=")], float)
    assert data[:, 0] == pytest.approx(JULIAN + light["t"] / 1440, abs=budgets.cli_julian_day)
    assert data[:, 1] == pytest.approx(light["magnitude"], abs=budgets.light_magnitude)
    assert data[:, 2] == pytest.approx(light["sigma"], rel=budgets.light_flux)
    assert fitted(run, own)["solutions"][0]["chi_square"] < 1.5 * len(data)


def test_files_as_they_are(run, night, fit_file, tmp_path):
    """Out of order, a point twice, an error that is missing: the key that mends each."""
    light, expected = night
    lines = [f"{t!r};{f!r};{s!r};A night" for t, f, s in zip(
        *(light[n].tolist() for n in ("t", "flux", "sigma")), strict=True)]
    table = (TABLE % "odd.csv" + VECTORS + 'columns = ["t", "f"]\nsigma_columns = ["e"]\n'
             'session_column = ["night"]\n')

    def file_of(rows, keys=""):
        (tmp_path / "odd.csv").write_text("\n".join(["t;f;e;night", *rows]) + "\n")
        return fit_file(table + keys, head=HEAD, name="odd.toml")

    same(run, file_of(lines), expected)
    turned = lines[40:] + lines[:40]
    assert "sort = true sorts them" in refused(run, file_of(turned))
    same(run, file_of(turned, "sort = true\n"), expected)
    twice = [*lines[:20], lines[19], *lines[20:]]
    said = refused(run, file_of(twice))
    assert "odd.csv:22: light curve 1, point 21" in said
    assert "stand twice, here and in point 20" in said and "leave_out = [22] leaves it out" in said
    same(run, file_of(twice, "leave_out = [22]\n"), expected)
    empty = [*lines[:3], lines[3].replace("0.02", ""), *lines[4:]]
    assert "sigma gives points without an error one" in refused(run, file_of(empty))
    assert lines[3].count("0.02") == 1
    found = fitted(run, file_of(empty, "sigma = 0.02\n"))["solutions"][0]
    assert found["chi_square"] == pytest.approx(expected["chi_square"], rel=budgets.cli_julian)
    assert "expected one above 0 for a fit" in refused(run, file_of(lines, "sigma = 0\n"))


@pytest.mark.parametrize(("keys", "first"), [
    ('time_format = "JD"\ntime_scale = "UTC"\ncolumns = ["when", "light"]\n', str(JULIAN)),
    ('time_format = "date"\ntime_scale = "UTC"\n', "2013-01-05T00:00:00"),
    ('brightness = "magnitude"\n', "0"),
])
def test_a_file_that_was_fitted_can_be_simulated(run, fit_file, tmp_path, keys, first):
    """In its own columns and dates, without noise, with sessions as dates; and is fitted again."""
    head = HEAD.replace("sessions = [0, 120]",
                        'sessions = ["2013-01-05T00:00:00", "2013-01-05T02:00:00"]')
    table = TABLE % "sim.csv" + VECTORS + keys
    run.ok("simulate", fit_file(table + "sigma = 0\n", head=head), "--into", tmp_path)
    row = next(x for x in (tmp_path / "sim.csv").read_text().splitlines()[1:]
               if x.startswith("1,"))
    assert row.split(",")[1].startswith(first)
    solution = fitted(run, fit_file(table + "sigma = 0.02\n", head=head))["solutions"][0]
    assert solution["chi_square"] < budgets.cli_light_of_itself


@pytest.mark.parametrize("separator", [",", ";"])
def test_rows_as_observers_leave_them(run, night, fit_file, tmp_path, separator):
    """An empty error at the end of a row, and rows without numbers, which are left out."""
    light, expected = night
    lines = [f"{t!r},{f!r},{s!r}" for t, f, s in zip(
        *(light[n].tolist() for n in ("t", "flux", "sigma")), strict=True)]
    table = TABLE % "bare.csv" + VECTORS + 'columns = ["t", "f"]\nsigma_columns = ["e"]\n'

    def file_of(rows, keys=""):
        text = "\n".join(["t,f,e", *rows]) + "\n"
        (tmp_path / "bare.csv").write_text(text.replace(",", separator))
        return fit_file(table + keys, head=HEAD, name="bare.toml")

    empty = [*lines[:3], lines[3].replace("0.02", ""), *lines[4:]]
    assert empty[3].endswith(",")
    assert "sigma gives points without an error one" in refused(run, file_of(empty))
    found = fitted(run, file_of(empty, "sigma = 0.02\n"))["solutions"][0]
    assert found["chi_square"] == pytest.approx(expected["chi_square"], rel=budgets.cli_julian)
    bad = [*lines[:10], "3,nan,0.02", *lines[10:20], "clouds,,", *lines[20:]]
    assert 'bare.csv:12: column f: "nan" is not a finite number' in refused(run, file_of(bad))
    same(run, file_of(bad, "leave_out = [12, 23]\n"), expected)
    assert "line 1 has none" in refused(run, file_of(bad, "leave_out = [1, 12, 23]\n"))


def test_light_time_at_the_ends_of_a_table(run, fit_file, tmp_path):
    """Times at the observer lie behind the end of a table that has all times at the body."""
    t = numpy.linspace(0, 120, 25)
    write(tmp_path / "body.csv", t=t, x=1.2 * numpy.cos(1e-5 * t), y=1.2 * numpy.sin(1e-5 * t),
          z=0 * t)
    orbits = ORBITS + '[orbit.rows]\nkind = "table"\nfile = "body.csv"\n'
    head = HEAD.replace("start = -60\nstop = 180", "start = 0\nstop = 120")

    def file_of(body, observer):
        return fit_file((TABLE % "ends.csv").replace("at-body", "at-observer")
                        + f'orbit = "{body}"\nobserver_orbit = "{observer}"\nsigma = 0.02\n',
                        orbits, head=head, name="ends.toml")

    path = file_of("rows", "earth")
    run.ok("simulate", path, "--into", tmp_path)
    found = fitted(run, path)["solutions"][0]
    assert 0.4 < found["chi_square"] / found["degrees_of_freedom"] < 1.7
    lines = (tmp_path / "body.csv").read_text().splitlines()
    (tmp_path / "short.csv").write_text("\n".join(lines[:21]))  # to 95 min
    short = ["--set", "time.stop=90", "--set", 'orbit.rows.file="short.csv"']
    assert 'observation[0].orbit: got "rows"; it covers the times 0 to 95 min; ' \
        "expected all when light leaves, 0 to 120\n" in run("fit", path, *short).stderr
    said = refused(run, file_of("body", "rows"), "simulate")
    assert 'observation[0].observer_orbit: got "rows"; it covers the times 0 to 120 min; ' \
        "expected all when light arrives, " in said


def test_light_of_an_ephemeris_that_ends_with_the_run(run, fit_file, tmp_path):
    """Light that leaves at the last row arrives after it."""
    head = HEAD.replace("start = -60\nstop = 180", "start = 0\nstop = 120")
    table = (TABLE % "late.csv").replace("at-body", "at-observer") + (
        'orbit = "body"\nobserver_orbit = "earth"\nsigma = 0.02\n')
    path = fit_file(table, ORBITS, head=head)
    run.ok("simulate", path, "--into", tmp_path)
    found = fitted(run, path)["solutions"][0]
    assert 0.4 < found["chi_square"] / found["degrees_of_freedom"] < 1.7
