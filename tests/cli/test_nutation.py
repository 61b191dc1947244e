# SPDX-License-Identifier: MIT
"""polhode nutation, and files of kind nutation."""

import csv
import math
import pathlib
import re

import budgets
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = "l,lp,F,D,Om,period,dpsi_sin,dpsi_cos,deps_cos,deps_sin"


@pytest.fixture(scope="module")
def out(run):
    """out("nutation", ...) -> what it prints, of a run that succeeds."""

    def call(*arguments):
        done = run(*arguments)
        assert (done.returncode, done.stderr) == (0, "")
        return done.stdout

    return call


@pytest.fixture(scope="module")
def error(run):
    """error("nutation", ...) -> the message of a run that is refused."""

    def call(*arguments):
        done = run(*arguments)
        assert (done.returncode, done.stdout) == (2, "")
        return done.stderr

    return call


def rows_of(text):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return lines[0], [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)]


@pytest.fixture(scope="module")
def figure(out, tmp_path_factory):
    path = tmp_path_factory.mktemp("nutation") / "figure.csv"
    shown = out("nutation", "--axis", "figure", "--out", path)
    assert not pathlib.Path(f"{path}.part").exists()
    return shown, path.read_text()


def test_the_table(figure):
    shown, text = figure
    head, rows = rows_of(text)
    assert head == COLUMNS
    assert (rows[0]["Om"], rows[0]["l"]) == (1, 0)
    assert abs(rows[0]["period"] + 6798.38) < budgets.nutation_period
    assert abs(rows[0]["dpsi_sin"] + 17280.592) < budgets.nutation_published
    assert abs(rows[0]["deps_cos"] - 9227.910) < budgets.nutation_published
    names = head.split(",")[6:]
    sizes = [math.hypot(*(row[name] for name in names)) for row in rows]
    assert all(a >= b - budgets.nutation_digits for a, b in zip(sizes, sizes[1:]))
    assert len(sizes) > 400
    assert "precession on the ecliptic of date 50.30" in shown
    assert f"and {len(rows) - 20} smaller terms" in shown


def test_axes_parts_and_changes(out, figure):
    def table(*arguments):
        return rows_of(out("nutation", *arguments, "--out", "-"))

    key = COLUMNS.split(",")[:5]
    by_key = [
        {tuple(row[k] for k in key): row for row in rows}
        for rows in (rows_of(figure[1])[1], table("--axis", "momentum")[1],
                     table("--axis", "figure", "--part", "oppolzer")[1])
    ]
    for k, oppolzer in by_key[2].items():
        if k not in by_key[0] or k not in by_key[1]:
            continue
        for name in ("dpsi_sin", "deps_cos"):
            both = by_key[1][k][name] + oppolzer[name]
            assert abs(by_key[0][k][name] - both) < budgets.nutation_digits
    head, rows = table("--changes")
    assert head == COLUMNS + ",dpsi_sin_t,dpsi_cos_t,deps_cos_t,deps_sin_t"
    assert rows[0]["dpsi_sin_t"] == pytest.approx(-17.4666, rel=budgets.nutation_change)


def test_another_planet_with_an_equator_that_is_no_circle(out):
    head, rows = rows_of(out("nutation", "--planet", "venus", "--out", "-"))
    assert head.startswith("M,Ls,Phi,period,")
    assert {(row["M"], row["Ls"], row["Phi"]) for row in rows[:3]} == {
        (0, 2, 0), (0, 0, 2), (1, 0, 0),
    }  # fmt: skip


def test_the_relative_rate(out):
    inertial = out("nutation", "--axis", "rotation", "--lines", 0)
    assert "the rate relative to the ecliptic of date is another 511." in inertial
    relative = out("nutation", "--axis", "rotation", "--rate", "relative", "--lines", 0)
    assert "offset from the mean axis of momentum 0.511" in relative


@pytest.mark.parametrize(("arguments", "message"), [
    (("--axis", "pole"), "--axis: pole not in {momentum,figure,rotation}"),
    (("--obliquity", "23.4"), '--obliquity: got "23.4"; expected a positive angle'),
    (("--epoch", "today"), '--epoch: got "today"'),
    (("--ellipticity", 2), "ellipticity 2 must be in"),
    (("--order", 3), "order 3 must be 1 or 2"),
    (("--planet", "mars", "--satellite-mass", 0.1), "mars has no satellite here"),
    (("--axis", "figure", "--rate", "relative"), "a relative rate has the axis of rotation"),
    (("--axis", "momentum", "--part", "oppolzer"), "Oppolzer terms are those of figure"),
    (("--out", "/nowhere/at/all.csv"), "/nowhere/at/all.csv"),
])
def test_what_is_refused(error, arguments, message):
    assert message in error("nutation", *arguments)


SCENARIO = """schema = 1
kind = "nutation"
units = { time = "d", angle = "mas" }
[nutation]
planet = "earth"
[time]
start = -100
stop = 100
step = 50
"""


def test_a_scenario_evaluates_the_table(out, figure, tmp_path):
    (tmp_path / "n.toml").write_text(SCENARIO)
    out("run", tmp_path / "n.toml", "--out", tmp_path / "n.csv")
    _, at = rows_of((tmp_path / "n.csv").read_text())
    assert [row["t"] for row in at] == [-100, -50, 0, 50, 100]
    # Simon et al. (1994) at J2000: l, l', F, D, Om
    arguments = [134.9633964, 357.5291092, 93.2720950, 297.8501921, 125.04455936]
    _, terms = rows_of(figure[1])
    longitude = sum(
        term["dpsi_sin"] * math.sin(theta) + term["dpsi_cos"] * math.cos(theta)
        for term in terms
        for theta in [
            math.radians(sum(term[k] * x for k, x in zip(("l", "lp", "F", "D", "Om"), arguments)))
        ]
    )
    assert abs(at[2]["dpsi_figure"] - longitude) < budgets.nutation_sum
    assert abs(at[2]["dpsi_relative"] - at[2]["dpsi_rotation"] - 0.5114) < budgets.nutation_period


def test_info_says_what_the_theory_finds(out, tmp_path):
    (tmp_path / "n.toml").write_text(SCENARIO)
    info = out("info", tmp_path / "n.toml")
    assert "dynamical ellipticity H" in info
    found = re.search(r"precession in longitude +(\S+) mas/d", info)
    # 50.306 arcsec a year
    assert abs(float(found[1]) - 50306.407 / 365.25) < budgets.nutation_period
    assert "[kinoshita1977]" in out("cite", tmp_path / "n.toml")


@pytest.mark.parametrize(("old", "new", "message"), [
    ('"earth"', '"pluto"', 'expected "earth", "venus" or "mars"'),
    ('planet = "earth"', 'planet = "mars"\nsatellite_mass = 0.1', "mars has no satellite"),
    ('planet = "earth"', 'planet = "earth"\nepoch = "noon"', "n.toml:6:9: nutation.epoch"),
    ('planet = "earth"', 'planet = "earth"\nellipticity = 0.9',
     "n.toml:6:15: nutation.ellipticity: got 0.9; PlanetNutation: ellipticity 0.9 must be in"),
    ('planet = "earth"', 'planet = "earth"\nobliquity = "0.01 deg"',
     "n.toml:6:13: nutation.obliquity: got \"0.01 deg\"; PlanetNutation: obliq"),
    ("[time]", '[output]\ncolumns = ["obliquity"]\n[time]', "expected none"),
])
def test_scenarios_that_are_refused(error, tmp_path, old, new, message):
    assert SCENARIO.count(old) == 1
    (tmp_path / "n.toml").write_text(SCENARIO.replace(old, new))
    assert message in error("run", tmp_path / "n.toml")


def test_init_writes_one_that_runs(out, tmp_path):
    (tmp_path / "own.toml").write_text(out("init", "nutation"))
    text = (tmp_path / "own.toml").read_text()  # terms of 5 days to 18 years, of mas to arcseconds
    assert '\ntime = "d"\nangle = "arcsec"\n' in re.sub("#.*\n", "", text)
    out("run", tmp_path / "own.toml", "--out", tmp_path / "own.csv")
    assert len(rows_of((tmp_path / "own.csv").read_text())[1]) > 1
