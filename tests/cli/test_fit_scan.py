# SPDX-License-Identifier: MIT
"""`polhode fit` of light curves by a scan: the template that begins one, several nights joined and
by themselves, and scenarios of solutions in other folders."""

import json

import budgets
import numpy
import pytest
from fit_files import FREE_LIGHT as FREE
from fit_files import TUMBLER, fitted, refused, rows

NIGHT = """
[[observation]]
kind = "light-curve"
file = "night.csv"
times = "at-body"
session_column = ["session"]
to_sun = [1, 0.2, 0.3]
to_observer = [0.8, 0.6, 0.1]
sigma = 0.02
"""
# Two nights of two hours, twelve hours apart.
HEAD = TUMBLER.replace("stop = 120\ncount = 81", "stop = 840\nstep = 1.5")
SESSIONS = "[simulate]\nsessions = [0, 120, 720, 840]\n"
SCAN = """
[fit]
from = "search"
starts = 60
[fit.scan]
order = 2
shortest = 8
longest = 40
pairs = 1
labels = 20
"""
VECTORS = ["--set", "observation[0].to_sun=[1, 0.2, 0.3]",
           "--set", "observation[0].to_observer=[0.8, 0.6, 0.1]"]


@pytest.fixture
def nights(run, fit_file, tmp_path):
    path = fit_file(NIGHT, FREE, SCAN, SESSIONS, head=HEAD)
    run.ok("simulate", path, "--into", tmp_path)
    return path


def test_the_template_of_light_curves_is_fitted(run, tmp_path):
    """What `polhode init light-curve` prints finds the body that it simulates."""
    text = run("init", "light-curve").stdout
    assert "[fit.scan]\n" in text and "radar" not in text and "attitudes.csv" not in text
    path = tmp_path / "mine.toml"
    path.write_text(text)
    run.ok("simulate", path, "--into", tmp_path, *VECTORS)
    assert (tmp_path / "night.csv").exists()
    less = ["--set", "fit.scan.order=2", "--set", "fit.scan.longest=40", "--set",
            "fit.scan.pairs=2", "--set", "fit.starts=400"]
    first = fitted(run, path, *less)["solutions"][0]
    truth = json.loads(run("info", path, "--json").stdout)["precession_period"]["value"]
    one = first["precession_period"]
    assert abs(one["value"] - truth) < 5 * one["error"] and one["error"] < 0.05
    assert first["chi_square"] < 1.5 * first["degrees_of_freedom"]


@pytest.mark.parametrize(("kind", "file"), [
    ("attitude", "attitudes.csv"), ("direction", "directions.csv"), ("rate", "rates.csv"),
])
def test_templates_name_a_file_of_what_was_observed(run, kind, file):
    text = run("init", kind).stdout
    assert f'file = "{file}"\n' in text and "[fit.scan]" not in text


def test_separate_sessions_come_to_what_one_grid_does(run, nights):
    """The lowest minimum of both is one, to what the refinement leaves; of far fewer pairs."""
    joined = fitted(run, nights)["scan"]
    separate = fitted(run, nights, "--set", "fit.scan.sessions=separate")["scan"]
    assert (joined["sessions"], separate["sessions"]) == ("joined", "separate")
    best, other = joined["minima"][0], separate["minima"][0]
    assert best["resolved"] and other["resolved"]
    assert other["chi_square"] == pytest.approx(best["chi_square"], rel=budgets.cli_fit_starts)
    for key in ("period_1", "period_2"):
        assert other[key] == pytest.approx(best[key], rel=budgets.cli_scan_periods)
    assert separate["separate_sessions"] == 2 and separate["windows"] == 20
    pairs = 2 * separate["frequencies"]**2 + separate["pairs_in_windows"]
    assert pairs < 0.1 * joined["frequencies"]**2
    # the grid of the longest session, 7 times as coarse as that of both
    assert separate["step"] == pytest.approx(1 / (8 * 120), rel=budgets.cli_carried)


def test_separate_sessions_are_told_and_fitted(run, nights, tmp_path):
    out = tmp_path / "landscape.csv"
    change = ["--set", "fit.scan.sessions=separate", "--set", "fit.scan.windows=7"]
    text = run("fit", nights, *change, "--landscape", out).stdout
    assert "2 sessions of 97 by 97 frequencies" in text
    assert "pairs of frequencies in 7 windows about the lowest minima of their sum" in text
    assert "the sum of 2 sessions with series of their own" in out.read_text()
    first = fitted(run, nights, *change)["solutions"][0]
    one = first["precession_period"]
    assert abs(one["value"] - 12) < 5 * one["error"] and one["error"] < 0.01


def test_sessions_join_one_by_one(run, nights, tmp_path):
    """From a scan and search of the first night, and from its solution."""
    change = ["--set", "fit.sessions=one-by-one"]
    found = tmp_path / "found.toml"
    done = run.ok("fit", nights, *change, "--json", "--solution", found)
    report = json.loads(done.stdout)
    first, second = report["joined_sessions"]
    assert (first["session"], second["session"]) == (1, 2)
    assert first["distance"] == 0 and abs(second["distance"] - 720) < 20
    assert second["counts"] > first["solutions"]
    best = report["solutions"][0]
    assert len(best["factors"]) == 2 and best["degrees_of_freedom"] == 162 - 8 - 2
    one = best["precession_period"]
    assert abs(one["value"] - 12) < 5 * one["error"] and one["error"] < 0.01
    text = run("fit", found, *change).stdout
    assert "sessions one by one: a fit for each count of turns; solutions and the lowest" in text
    again = fitted(run, found, *change)["solutions"][0]
    assert again["chi_square"] == pytest.approx(best["chi_square"], rel=budgets.cli_fit_starts)


def test_what_cannot_join_is_refused(run, nights):
    text = nights.read_text().replace("[fit]\n", '[fit]\nsessions = "one-by-one"\n')
    path = nights.with_name("bad.toml")
    for shape in "", '[light]\nshape = "convex"\n':
        path.write_text(text.replace('session_column = ["session"]\n', "") + shape)
        message = refused(run, path)
        assert 'fit.sessions: got "one-by-one"; expected more than one session: ' in message


def test_too_many_pairs_are_told_with_the_key_to_take(run, nights, fit_file):
    narrow = nights.read_text().replace("shortest = 8\nlongest = 40", "shortest = 0.5")
    path = nights.with_name("wide.toml")
    path.write_text(narrow)
    message = refused(run, path)
    assert "expected at most 1e8 pairs of frequencies; periods of 0.5 min to 840 min" in message
    assert ": set fit.scan.sessions = \"separate\", which scans session by session first" in message
    one = nights.with_name("one.toml")
    one.write_text(narrow.replace('session_column = ["session"]\n', ""))
    message = refused(run, one)
    assert "say so by session_column or a table [[observation]] for each, and set" in message
    many = nights.with_name("many.toml")
    many.write_text(narrow.replace("shortest = 0.5", (
        'shortest = 0.1\nsessions = "separate"\nwindows = 30')))
    message = refused(run, many)
    assert "fit.scan.windows: got 30; expected at most 1e8 pairs of frequencies; " in message
    assert "2 sessions of " in message and "lower fit.scan.windows" in message


@pytest.mark.parametrize(("change", "expected"), [
    ("windows = 5", 'fit.scan.windows: got 5; expected fit.scan.sessions = "separate" as well'),
    ('sessions = "separate"\nwindows = 0', "expected a whole number from 1 to 10000"),
    ("order = 7", "fit.scan.order: got 7; expected a lower one: 162 points do not determine 226"),
    ('order = 5\nsessions = "separate"',
     "fit.scan.order: got 5; expected a lower one: 81 points of the longest session do not "
     "determine 121 coefficients"),
    ('sessions = "split"', 'expected "joined" or "separate"'),
    ('sessions = "separate"\nshortest = 150',
     "shortest is below the longest; the data give 6 min to 120 min"),
])
def test_bad_scans_of_sessions_are_refused(run, nights, change, expected):
    path = nights.with_name("bad.toml")
    limits = "" if "shortest" in change else "shortest = 8\n"
    path.write_text(nights.read_text().replace("shortest = 8\nlongest = 40\n", limits).replace(
        "order = 2\n", "" if "order" in change else "order = 2\n").replace(
        "pairs = 1\n", "pairs = 1\n" + change + "\n"))
    message = refused(run, path)
    assert expected in message, message


def test_pairs_that_are_not_shown_are_counted(run, nights):
    more = ["--set", "fit.scan.pairs=3", "--set", "fit.starts=60"]
    text = run("fit", nights, *more).stdout
    readings = len(fitted(run, nights, *more)["periods"])
    assert f" more; --json has all {readings} readings\n" in text


def test_a_solution_in_another_folder_is_fitted_again(run, fit_file, tmp_path):
    """It names what it reads from where it lies; in the folder of the file nothing changes."""
    path = fit_file(NIGHT, FREE, head=TUMBLER)
    run.ok("simulate", path, "--into", tmp_path)
    (tmp_path / "of it").mkdir()
    here, there = tmp_path / "here.toml", tmp_path / "of it" / "there.toml"
    first, = fitted(run, path, "--solution", here)["solutions"]
    fitted(run, path, "--solution", there)
    assert 'file = "night.csv"\n' in here.read_text()
    assert here.read_text() == there.read_text().replace('"../night.csv"', '"night.csv"')
    again, = fitted(run, there)["solutions"]
    assert again["chi_square"] == pytest.approx(first["chi_square"], rel=budgets.cli_fit_starts)
    # from the folder that it lies in, and named without it
    run.ok("fit", "there.toml", "--json", "--solution", "next.toml", cwd=there.parent)
    assert 'file = "../night.csv"\n' in there.with_name("next.toml").read_text()
    run.ok("fit", path, "--solution", "other.toml", cwd=there.parent)
    assert 'file = "../night.csv"\n' in there.with_name("other.toml").read_text()
    # what begins at the root stays
    root = tmp_path / "root.toml"
    root.write_text(path.read_text().replace('"night.csv"', f'"{tmp_path}/night.csv"'))
    fitted(run, root, "--solution", there)
    assert f'file = "{tmp_path}/night.csv"\n' in there.read_text()


def chi_square_of_series(light, pair, order):
    """By least squares of numpy: 2 pi (j / P1 + k / P2) t for half of the plane of j and k, and a
    constant of each session, in parts of its mean flux, whose errors are 2 %."""
    t = light["t"]
    sessions = [light["session"] == n for n in sorted(set(light["session"]))]
    values = light["flux"] / sum(light["flux"][one].mean() * one for one in sessions)
    columns = list(sessions)
    for j in range(order + 1):
        for k in range(-order, order + 1):
            if j > 0 or k > 0:
                angle = 2 * numpy.pi * (j / pair[0] + k / pair[1]) * t
                columns += [numpy.cos(angle), numpy.sin(angle)]
    matrix = numpy.array(columns).T
    found, _, rank, _ = numpy.linalg.lstsq(matrix, values, rcond=None)
    return ((values - matrix @ found)**2).sum() / 0.02**2, len(t) - rank


def test_chosen_pairs_have_the_chi_square_of_their_series(run, nights, tmp_path):
    """At published periods, whatever a scan finds: order of its own, without a scan as well."""
    at = ["--set", "fit.scan.at=[11.97, 19.9, 31, 17.3]"]
    light = rows(tmp_path / "night.csv")
    own = ["--set", "fit.from=start", "--set", "fit.starts=", "--set", "fit.scan.at_order=3"]
    for order, more in ((2, []), (3, own)):
        found = fitted(run, nights, *at, *more)
        assert ("scan" in found) == (order == 2)
        chosen = found["chosen_pairs"]
        assert [one["order"] for one in chosen] == [order, order]
        for one, pair in zip(chosen, ((11.97, 19.9), (31, 17.3)), strict=True):
            chi_square, freedom = chi_square_of_series(light, pair, order)
            assert (one["period_1"], one["period_2"]) == pytest.approx(
                pair, rel=budgets.cli_rounding)
            assert one["chi_square"] == pytest.approx(chi_square, rel=budgets.cli_series)
            assert one["degrees_of_freedom"] == freedom
            assert one["minimum"]["chi_square"] < one["chi_square"]
    text = run("fit", nights, *at).stdout
    assert "pairs of fit.scan.at, order 2, and the minimum next to each" in text
    assert f"{chi_square_of_series(light, (31, 17.3), 2)[0]:.5g} (" in text


def test_chosen_pairs_are_told_where_a_scan_resolves_nothing(run, nights):
    done = run("fit", nights, "--set", "fit.scan.at=[12, 20]", "--set", "fit.scan.shortest=36",
               "--set", "fit.scan.longest=39")
    assert done.returncode == 1 and "no solution: no minimum of the scan" in done.stderr
    assert "lowest minima of the scan" in done.stdout and "pairs of fit.scan.at" in done.stdout


def test_the_minimum_next_to_a_chosen_pair_is_that_of_the_scan(run, nights):
    """From periods that a scan found, rounded."""
    best = fitted(run, nights)["scan"]["minima"][0]
    pair = f"[{best['period_1']:.5g}, {best['period_2']:.5g}]"
    one, = fitted(run, nights, "--set", f"fit.scan.at={pair}")["chosen_pairs"]
    assert one["minimum"]["chi_square"] == pytest.approx(best["chi_square"],
                                                         rel=budgets.cli_fit_starts)
    assert one["minimum"]["converged"] and one["minimum"]["resolved"]


@pytest.mark.parametrize(("change", "expected"), [
    ("at = [12, 20, 7]", "fit.scan.at: got [12, 20, 7]; expected pairs of periods"),
    ("at = [12, -20]", "fit.scan.at: got [12, -20]; expected a positive time"),
    ("at_order = 2", "fit.scan.at_order: got 2; expected fit.scan.at as well"),
    ("at = [12, 20]\nat_order = 10", "fit.scan.at_order: got 10; expected a whole number from 1"),
    ("at = [12, 20]\nat_order = 9", "fit.scan.at: got [12, 20]; "),
])
def test_bad_chosen_pairs_are_refused(run, nights, change, expected):
    path = nights.with_name("bad.toml")
    path.write_text(nights.read_text().replace("pairs = 1\n", "pairs = 1\n" + change + "\n"))
    message = refused(run, path)
    assert expected in message, message


def test_ten_thousand_points_get_the_advice_to_bin(run, fit_file, tmp_path):
    scan = SCAN.replace("order = 2\nshortest = 8", "order = 1\nshortest = 30")
    path = fit_file(NIGHT.replace('session_column = ["session"]\n', ""), FREE, scan,
                    head=TUMBLER.replace("count = 81", "count = 10000"))
    assert run("simulate", path, "--into", tmp_path).returncode == 0
    done = run("fit", path, "--scan-only")
    assert done.returncode == 0, done.stderr
    advice = "10000 points: means of neighbouring points, a hundredth of a period apart, would give"
    assert advice in " ".join(done.stdout.split())
