# SPDX-License-Identifier: MIT
"""Searches of `polhode fit` for the motion behind light curves, and scans of their frequencies."""

import json
import re
import signal
import subprocess
import time

import budgets
import numpy
import pytest
from closeness import assert_allclose, smallest
from fit_files import FREE_LIGHT as FREE
from fit_files import NIGHT, TUMBLER, fitted, rows

SEARCH = """
[fit]
from = "search"
starts = 60
within_factor = 1.5
[[fit.periods]]
mode = "LAM"
precession_period = 12
rotation_period = 20
"""


def test_a_search_finds_the_images_whatever_the_threads(run, night, fit_file):
    path = fit_file(NIGHT, FREE, SEARCH, head=TUMBLER, name="search.toml")
    one = run.ok("fit", path, "--json", "--threads", "1")
    assert run("fit", path, "--json", "--threads", "3").stdout == one.stdout
    found = json.loads(one.stdout)
    first = found["solutions"][0]
    assert first["beside"] == "first" and first["mode"] == "LAM"
    images = {s["image"] for s in found["solutions"] if s["beside"] == "image" and s["of"] == 1}
    assert images == {"normal", "bisector", "difference"}
    best = fitted(run, night)["solutions"][0]["chi_square"]
    assert first["chi_square"] == pytest.approx(best, rel=budgets.cli_fit_starts)
    text = run("fit", path).stdout
    assert "pairs of periods by what an ellipsoid comes to" in text
    assert "image (normal) of 1" in text


def test_a_search_under_a_robust_loss_says_what_it_minimised(run, night, fit_file):
    path = fit_file(NIGHT, FREE, SEARCH + '[fit.scan]\norder = 2\n', head=TUMBLER,
                    name="robust.toml")
    huber = ["--set", 'fit.loss="huber"', "--set", "fit.starts=20"]
    found = fitted(run, path, *huber)
    costs = [s["cost"] for s in found["solutions"]]
    # but for images, which have one cost
    assert_allclose(costs, sorted(costs), rtol=budgets.cli_fit_images)
    assert costs[-1] <= 1.5 * costs[0] < 1.5 * found["solutions"][0]["chi_square"]
    assert found["periods"][0]["cost"] == pytest.approx(costs[0], rel=budgets.cli_fit_images)
    assert found["solutions"][0]["sentence"].endswith(": the lowest loss")
    text = run("fit", path, *huber).stdout
    assert "pairs of periods by the loss that an ellipsoid comes to\n        loss" in text
    assert f"   1{costs[0]:>12.5g}" in text and "        loss  mode" in text


@pytest.mark.parametrize("loss", ["huber", "cauchy"])
def test_points_three_times_too_bright_hide_nothing(run, night, fit_file, tmp_path, loss):
    """One in twelve: the true periods come before the alias, the pole among the images."""
    table = tmp_path / "night.csv"
    comments = [x for x in table.read_text().splitlines() if x.startswith("#")]
    header, *lines = [x for x in table.read_text().splitlines() if not x.startswith("#")]
    column = header.split(",").index("flux")
    for at in range(4, len(lines), 12):
        part = lines[at].split(",")
        part[column] = str(3 * float(part[column]))
        lines[at] = ",".join(part)
    table.write_text("\n".join([*comments, header, *lines]) + "\n")
    other = SEARCH + '[[fit.periods]]\nmode = "LAM"\nprecession_period = 12\nrotation_period = 11\n'
    path = fit_file(NIGHT, FREE, other, head=TUMBLER, name="bad.toml")
    found = fitted(run, path, "--set", f'fit.loss="{loss}"')
    first = found["solutions"][0]
    assert abs(first["rotation_period"]["value"] - 20) < 4 * first["rotation_period"]["error"]
    assert first["error_factor"] < 1.5 and first["chi_square"] > 1e4
    off = [numpy.hypot((s["pole"]["longitude"] - 50) * numpy.cos(numpy.radians(40)),
                       s["pole"]["latitude"] - 40) / s["pole"]["error_major"]
           for s in found["solutions"]]
    assert smallest(off) < 4


def test_pairs_beyond_the_limit_are_told(run, night, fit_file):
    """Their own best ellipsoid: its periods, which it left, its pole and the mirror pole."""
    other = SEARCH + '[[fit.periods]]\nmode = "LAM"\nprecession_period = 12\nrotation_period = 11\n'
    path = fit_file(NIGHT, FREE, other.replace("1.5", "1.1"), head=TUMBLER, name="pairs.toml")
    found = fitted(run, path)
    right, alias = found["periods"]
    first = found["solutions"][0]
    assert alias["chi_square"] > 1.1 * first["chi_square"]
    assert all(abs(s["rotation_period"]["value"] - 20) < 1 for s in found["solutions"])
    assert alias["found"]["rotation_period"] not in (11, 20)
    assert right["found"]["rotation_period"] == pytest.approx(
        first["rotation_period"]["value"], rel=budgets.cli_fit_starts)
    of_pair = right["found"]
    told = {(round(of_pair[m + "longitude"], 2), round(of_pair[m + "latitude"], 2))
            for m in ("", "mirror_")}
    assert len(told) == 2 and told <= {
        (round(s["pole"]["longitude"], 2), round(s["pole"]["latitude"], 2))
        for s in found["solutions"]}
    text = run("fit", path).stdout
    assert f"{alias['chi_square']:>12.5g}   LAM" in text and "mirror" in text


def test_a_scan_has_a_landscape(run, night, fit_file, tmp_path):
    scan = ('[fit]\nfrom = "search"\nstarts = 1\n[fit.scan]\norder = 2\nshortest = 5\n'
            "longest = 30\nminima = 4\npairs = 1\nlabels = 1\n")
    path = fit_file(NIGHT, FREE, scan, head=TUMBLER, name="scan.toml")
    out = tmp_path / "landscape.csv"
    done = run("fit", path, "--json", "--landscape", out, "--landscape", tmp_path / "l.h5")
    assert done.returncode in (0, 1), done.stderr
    chi = rows(out)
    n = round(len(chi["f1"])**0.5)
    grid = chi["chi_square"].reshape(n, n)
    assert_allclose(grid, grid.T, rtol=budgets.cli_landscape)
    assert chi["f1"][0] == pytest.approx(1 / 30) and chi["f2"][-1] <= 1 / 5
    assert (tmp_path / "l.h5").exists()


def test_a_landscape_without_a_scan_is_refused_before_the_fit(run, night, tmp_path):
    out = tmp_path / "landscape.csv"
    done = run("fit", night, "--landscape", out, "--json")
    assert done.returncode != 0 and not done.stdout and not out.exists()
    assert "--landscape: no scan is made" in done.stderr
    assert 'expected fit.from = "search" without fit.periods' in done.stderr


ROTATOR = """schema = 1
kind = "fit"
[units]
time = "h"
angle = "deg"
[body]
moments = [0.85, 1.36, 1.49]
[state]
epoch = "2021-03-01T00:00:00 UTC"
axes = "ecliptic-J2000"
[state.attitude-rate]
euler = { phi = 20, theta = 50, psi = 110 }
omega_body = [0, 0, 85.714285714]
[time]
stop = 9
count = 150
[light]
semiaxes = [1, 0.7, 0.6]
"""
SCAN = """
[fit]
from = "search"
starts = 1
[fit.scan]
order = 1
shortest = 1.5
longest = 6
pairs = 1
labels = 1
"""


def test_one_period_is_enough_for_a_rotator_and_not_for_a_tumbler(run, night, fit_file, tmp_path):
    """4.2 h, an ellipsoid with two maxima in each rotation."""
    path = fit_file(NIGHT, FREE, SCAN, head=ROTATOR, name="rotator.toml")
    run.ok("simulate", path, "--into", tmp_path, "--replace")
    done = run("fit", path)
    assert done.returncode == 1 and 'fit.rotation = "tumbler"' in done.stderr
    first = done.stdout.splitlines()[0]
    assert first.startswith("one period describes these data: 2.1"), first
    assert "if the light has two maxima in a rotation, that takes 4.2" in first
    assert "\nsearch " not in done.stdout and "one frequency     order 1, 2.1" in done.stdout
    one = json.loads(run("fit", path, "--json").stdout)["scan"]["one_period"]
    assert one["suffices"] and abs(one["period"] - 2.1) < 0.01
    assert one["chi_square"] < 1.4 * one["degrees_of_freedom"]
    more = run("fit", path, "--set", 'fit.rotation="tumbler"')
    assert "search " in more.stdout and "one period" not in more.stdout.splitlines()[0]
    tumbler = SCAN.replace("1.5\n", "5\n").replace("longest = 6", "longest = 40")
    path = fit_file(NIGHT, FREE, tumbler.replace("order = 1", "order = 2"), head=TUMBLER,
                    name="tumbler.toml")
    run.ok("simulate", path, "--into", tmp_path, "--replace")
    only = run.ok("fit", path, "--scan-only", "--json")
    found = json.loads(only.stdout)
    assert not found["scan"]["one_period"]["suffices"] and not found["solutions"]
    assert found["scan"]["one_period"]["chi_square"] > 10 * found["scan"]["minima"][0]["chi_square"]
    assert "no scan is made" in run("fit", night, "--scan-only").stderr


def test_errors_that_are_far_too_small_give_no_period_without_a_word(run, fit_file, tmp_path):
    """The light has errors of 2 %, and the file says 0.1 %."""
    path = fit_file(NIGHT, FREE, SCAN, head=ROTATOR, name="small.toml")
    run.ok("simulate", path, "--into", tmp_path, "--replace")
    done = run("fit", path, "--set", "observation[0].sigma=0.001")
    first = done.stdout.splitlines()[0]
    assert first.startswith("no model of this kind describes these data"), first
    assert "errors of the data may be too small, by a factor of 2" in first and "2.1" in first
    assert "errors of the data are too small" in done.stdout.split("\nnote: ")[1]
    minima = re.findall(r"^ +\d+ +\S+ +\S+ +(\S+) +\S+ +(\S+)", done.stdout, re.MULTILINE)
    assert set(minima) == {("unknown", "unknown")}
    assert "errors of the data are too small" not in run("fit", path).stdout


@pytest.mark.parametrize("count, order", [(40, 2), (60, 2), (80, 3)])
def test_few_points_are_enough_for_one_period(run, fit_file, tmp_path, count, order):
    scan = f'[fit]\nfrom = "search"\n[fit.scan]\norder = {order}\nshortest = 0.5\n'
    path = fit_file(NIGHT, FREE, scan, head=ROTATOR, name="few.toml")
    points = ["--set", f"time.count={count}"]
    run.ok("simulate", path, *points, "--into", tmp_path, "--replace")
    found = json.loads(run("fit", path, *points, "--scan-only", "--json").stdout)
    one = found["scan"]["one_period"]
    assert one["suffices"] and abs(one["period"] - 2.1) < budgets.cli_few_points_period
    assert not found["scan"]["constant"]["suffices"]


def test_no_variation_is_seen_in_noise(run, fit_file, tmp_path):
    path = fit_file(NIGHT, FREE, SCAN, head=ROTATOR, name="noise.toml")
    random = numpy.random.default_rng(7)
    (tmp_path / "night.csv").write_text("t,flux\n" + "".join(
        f"{t},{1 + 0.02 * random.normal()}\n" for t in numpy.linspace(0, 9, 150)))
    done = run("fit", path)
    first = done.stdout.splitlines()[0]
    assert done.returncode == 1 and "no variation is seen" in done.stderr
    assert first.startswith("no variation is seen in these data: a constant brightness"), first
    assert "one frequency" not in done.stdout and "minima" not in done.stdout
    found = json.loads(run("fit", path, "--json").stdout)["scan"]
    assert found["constant"]["suffices"] and not found["one_period"]["suffices"]


def test_the_period_of_the_short_axis_is_told(run, night):
    """1/P_short = 1/P_phi + 1/P_psi: 1/12 + 1/20 = 1/7.5."""
    solution, = fitted(run, night)["solutions"]
    short = solution["short_axis_period"]
    assert abs(short["value"] - 7.5) < 4 * short["error"] < 0.1
    text = run("fit", night).stdout
    assert f"P (short axis)    {short['value']:.3f}"[:23] in text


def test_chosen_pairs_are_told_where_the_start_fails(run, night):
    done = run("fit", night, "--set", "fit.scan.at=[12, 20]", "--set", "fit.iterations=1", "--set",
               "state.tumbler.phi0=60")
    assert done.returncode == 1 and "did not converge" in done.stderr
    assert "pairs of fit.scan.at" in done.stdout and "solutions         none" in done.stdout


def test_lists_of_solutions_have_a_cap(run, night, fit_file, tmp_path):
    path = fit_file(NIGHT, FREE, SEARCH, head=TUMBLER, name="cap.toml")
    out = tmp_path / "cap-found.toml"
    done = run("fit", path, "--solution", out, "--set", "fit.most_solutions=2", "--set",
               "fit.starts=20")
    assert done.returncode == 0 and "files of 2 of 4 solutions were written" in done.stderr
    assert sorted(p.name for p in tmp_path.glob("cap-found*")) == [
        "cap-found-2.toml", "cap-found.toml"]
    assert " and 2 more; --json has all" in done.stdout


def test_a_search_is_stopped(night, polhode):
    """Ctrl-C ends it between two starts."""
    process = subprocess.Popen(
        [polhode, "fit", night, "--set", 'fit.from="search"', "--set", "fit.starts=1000000",
         "--set", 'fit.periods=[{ mode="LAM", precession_period=12, rotation_period=20 }]'],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )
    time.sleep(1.5)
    process.send_signal(signal.SIGINT)
    out, error = process.communicate(timeout=60)
    assert process.returncode == 128 + signal.SIGINT and out == ""
    assert "stopped in the search" in error
