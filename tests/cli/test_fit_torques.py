# SPDX-License-Identifier: MIT
"""Fits of files with torques: a constant torque, a flyby and a jump that were simulated are found
again, scenarios of the solutions go on under what was found, and what such a fit refuses."""

import json

import numpy
import pytest

HEAD = """schema = 1
title = "A tumbler that is driven"
kind = "fit"
[units]
time = "h"
angle = "deg"
length = "km"
moment = "kg m2"
[body]
moments = [1e9, 2.2e9, 2.6e9]
[state.attitude-rate]
euler = { phi = 20, theta = 60, psi = 110 }
omega_body = [3, 4, 12]
[time]
stop = 96
step = 4
[free]
unknowns = ["attitude", "rate", "moments"]
"""
ATTITUDES = """
[[observation]]
kind = "attitude"
file = "seen.csv"
times = "at-body"
sigma = 1
"""
TORQUE = """
[[perturbation]]
kind = "constant-torque"
torque = ["1e-2 N m", 0, "-3e-2 N m"]
"""
FREE_TORQUE = """
[[free.parameter]]
key = "perturbation[0].torque[2]"
"""
FLYBY = """
[orbit.flyby]
gm = "398600.4418 km3/s2"
pericentre = 38000
eccentricity = 4.2
inclination = 30
node = 10
pericentre_argument = 70
epoch = 48
[[perturbation]]
kind = "gravity-gradient"
orbit = "flyby"
"""
JUMP = """
[[free.jump]]
kind = "rate"
t = 50
change = [0.5, -1, 2]
"""


@pytest.fixture
def fit_file(tmp_path):
    """fit_file("...") writes a scenario of kind "fit" and returns its path."""

    def write(*parts, name="fit.toml"):
        path = tmp_path / name
        path.write_text(HEAD + ATTITUDES + "".join(parts), encoding="utf-8")
        return path

    return write


def fitted(run, path, *arguments):
    done = run.ok("fit", path, "--json", *arguments)
    solution, = json.loads(done.stdout)["solutions"]
    return solution


def refused(run, path, *arguments):
    done = run("fit", path, *arguments)
    assert done.returncode == 2, (done.returncode, done.stderr)
    assert done.stderr.count("\n") == 1, done.stderr
    return done.stderr


def rows(text):
    lines = [one for one in text.splitlines() if not one.startswith("#")]
    names = lines[0].split(",")
    numbers = numpy.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    return dict(zip(names, numbers.T, strict=True))


def angle_between(a, b):
    """In rad, of the columns q of two runs."""
    names = ("qw", "qx", "qy", "qz")
    cosine = sum(a[name] * b[name] for name in names)
    return 2 * numpy.arccos(numpy.minimum(abs(cosine), 1))


def attitudes(run, path, *changes):
    done = run.ok("run", path, "--set", 'output.columns=["q"]', *changes)
    return rows(done.stdout)


def within_errors(number, truth):
    """By a normal number that is farther once in ten thousand times."""
    return abs(number["value"] - truth) < 3.9 * number["error"]


def test_a_torque_is_found_and_goes_on(run, fit_file, tmp_path):
    path = fit_file(TORQUE, FREE_TORQUE)
    run.ok("simulate", path, "--into", tmp_path)
    start = ("--set", 'perturbation[0].torque=["1e-2 N m", 0, "0 N m"]')
    out = tmp_path / "solution.toml"
    found = fitted(run, path, "--solution", out, *start)
    torque = found["unknowns"]["perturbation[0].torque[2]"]
    assert torque["unit"] == "N m" and torque["start"] == 0
    assert within_errors(torque, -3e-2) and abs(torque["value"]) > 10 * torque["error"]
    assert 0 < torque["scaled_error"] < 2 * torque["error"]
    # the scenario of the solution has the torque, bit for bit, and its motion
    text = out.read_text()
    assert "free" not in text and 'kind = "fit"' not in text
    assert f'torque = ["1e-2 N m", 0, "{torque["value"]!r} N m"]' in text
    after = ("--set", "time={ at = [96, 192] }")
    q, truth = attitudes(run, out, *after), attitudes(run, path, *after)
    assert angle_between(q, truth)[0] < 0.05
    # with the torque left out it would be elsewhere
    blind = attitudes(run, out, *after, "--set", "perturbation[0].torque=[0, 0, 0]")
    assert angle_between(blind, truth)[0] > 20 * angle_between(q, truth)[0]
    table = run("fit", path, *start).stdout
    assert "perturbation[0].torque[2]  N m" in table


def test_a_solution_in_another_folder_finds_the_tables_of_torques(run, fit_file, tmp_path):
    (tmp_path / "burn.csv").write_text("t,x,y,z\n0,0,0,0\n40,0,0,0.01\n120,0,0,0\n")
    path = fit_file('[[perturbation]]\nkind = "torque-table"\nfile = "burn.csv"\n')
    run.ok("simulate", path, "--into", tmp_path)
    there = tmp_path / "there" / "found.toml"
    there.parent.mkdir()
    fitted(run, path, "--solution", there)
    assert 'file = "../burn.csv"\n' in there.read_text() and "seen.csv" not in there.read_text()
    here = tmp_path / "found.toml"
    fitted(run, path, "--solution", here)
    assert 'file = "burn.csv"\n' in here.read_text()
    assert run("run", there).stdout.splitlines()[-1] == run("run", here).stdout.splitlines()[-1]


def test_known_torques_need_no_unknown(run, fit_file, tmp_path):
    path = fit_file(TORQUE)
    run.ok("simulate", path, "--into", tmp_path)
    found = fitted(run, path)
    assert list(found["unknowns"]) == [
        "turn_x", "turn_y", "turn_z", "w_x", "w_y", "w_z", "Ixx/Izz", "Iyy/Izz"]
    assert found["degrees_of_freedom"] == pytest.approx(67)
    assert 35 < found["chi_square"] < 110
    free = fitted(run, path, "--set", "perturbation[0].torque=[0, 0, 0]")
    assert free["chi_square"] > 3 * found["chi_square"]


def test_the_same_state_through_an_encounter(run, fit_file, tmp_path):
    """Seen before a flyby alone, a state predicts what comes after it."""
    path = fit_file(FLYBY)
    run.ok("simulate", path, "--into", tmp_path, "--set", "time.stop=36", "--set", "time.step=1")
    out = tmp_path / "after.toml"
    found = fitted(run, path, "--solution", out)
    assert found["converged"]
    after = ("--set", "time={ at = [60] }")
    q, truth = attitudes(run, out, *after), attitudes(run, path, *after)
    blind = attitudes(run, out, *after, "--set", "orbit.flyby.gm=1e-9 km3/s2", "--set",
                      "orbit.flyby.eccentricity=1.1")
    assert angle_between(q, truth)[0] < 0.1
    assert angle_between(blind, truth)[0] > 4 * angle_between(q, truth)[0]


def test_a_jump_is_found(run, fit_file, tmp_path):
    path = fit_file(JUMP)
    run.ok("simulate", path, "--into", tmp_path)
    out = tmp_path / "solution.toml"
    found = fitted(run, path, "--solution", out, "--set", "free.jump[0].change=[0, 0, 0]")
    for place, truth in enumerate([0.5, -1, 2]):
        one = found["unknowns"][f"jump[0].change[{place}]"]
        assert one["unit"] == "deg/h" and within_errors(one, truth)
    assert "right from t = 50" in out.read_text()
    residuals = tmp_path / "residuals.csv"
    run.ok("fit", path, "--residuals", residuals)
    last = rows(residuals.read_text())
    assert abs(last["turn_x"][-1]) < 5
    # the text is of t = 0, as the numbers are, and the scenario of what comes after the jump
    text = run("fit", path).stdout
    assert "at t = 0, before the jumps:\n" in text
    period, = (line for line in text.splitlines() if "P_phi (long axis)" in line)
    json_period = fitted(run, path)["precession_period"]["value"]
    assert f"{json_period:.6g}" in period, period
    later = json.loads(run("info", out, "--json").stdout)["precession_period"]["value"]
    assert abs(later - json_period) > 0.01 * json_period
    # runs of the solution are right after the jump
    q = attitudes(run, out, "--set", "time={ at = [96] }")
    seen = rows((tmp_path / "seen.csv").read_text())
    at = {name: column[-1:] for name, column in seen.items()}
    assert angle_between(q, at)[0] < numpy.radians(6)


@pytest.mark.parametrize("change, expected", [
    (("torque[2]", "torque[3]"), "expected a key that holds a number"),
    (("perturbation[0].torque[2]", "body.moments[0]"), "expected a number of [[perturbation]]"),
    (("torque[2]\"", "torque[2]\"\nlow = 1\nhigh = 0"), "expected low below high"),
    (("torque[2]\"", "torque[2]\"\nlow = 1"), "between low and high"),
    (("torque[2]\"", "torque[2]\"\nmean = 1"), "expected a key sigma as well"),
    (("torque[2]\"", "torque[2]\"\nsigma = 0"), "sigma: got 0; expected"),
    (("[[free.parameter]]", FREE_TORQUE + "[[free.parameter]]"), "that no other table"),
])
def test_bad_parameters_are_refused(run, fit_file, tmp_path, change, expected):
    (tmp_path / "seen.csv").write_text("t,qw,qx,qy,qz\n0,1,0,0,0\n")
    message = refused(run, fit_file(TORQUE, FREE_TORQUE.replace(*change)))
    assert expected in message, message


def test_what_is_not_proportional_is_refused(run, fit_file, tmp_path):
    path = fit_file(FLYBY, '\nJ2 = 1e-3\npole = [0, 0, 1]\nprimary_radius = 6378\n',
                    '[[free.parameter]]\nkey = "perturbation[0].primary_radius"\n')
    run.ok("simulate", path, "--into", tmp_path, "--set", "time.stop=80")
    assert "does not change in proportion to perturbation[0].primary_radius" in refused(run, path)


def test_jumps_lie_between_observations(run, fit_file, tmp_path):
    path = fit_file(JUMP)
    run.ok("simulate", path, "--into", tmp_path)
    late = refused(run, path, "--set", "free.jump[0].t=96")
    assert "jump[0].change at t = 96; expected a time from the first observation on" in late


def test_more_unknowns_than_data_are_refused(run, fit_file, tmp_path):
    path = fit_file(TORQUE, FREE_TORQUE)
    run.ok("simulate", path, "--into", tmp_path, "--set", "time.stop=4")
    message = refused(run, path)
    assert "9 unknowns" in message and "perturbation[0].torque[2]" in message


def test_a_damper_is_refused(run, fit_file, tmp_path):
    (tmp_path / "seen.csv").write_text("t,qw,qx,qy,qz\n0,1,0,0,0\n")
    damper = '[[perturbation]]\nkind = "kane-damper"\nsphere_moment = 1e6\nfriction = 1e3\n'
    assert "expected no damper" in refused(run, fit_file(damper))
    second = refused(run, fit_file(TORQUE, damper))
    assert 'perturbation[1].kind: got "kane-damper"' in second, second


def test_a_parameter_without_a_torque_is_open(run, fit_file, tmp_path):
    """A surface that no perturbation looks at: its area is an unknown all the same."""
    surface = ('[[surface]]\narea = "2 m2"\nposition = [0, 0, 1]\nnormal = [0, 0, 1]\n'
               '[[free.parameter]]\nkey = "surface[0].area"\n')
    path = fit_file(surface)
    run.ok("simulate", path, "--into", tmp_path)
    found = fitted(run, path)
    assert found["unknowns"]["surface[0].area"]["error"] is None
    assert any("do not determine surface[0].area" in note for note in found["notes"])


def test_errors_are_scaled_on_a_bound(run, fit_file, tmp_path):
    path = fit_file(TORQUE, FREE_TORQUE)
    run.ok("simulate", path, "--into", tmp_path)
    bound = fit_file(TORQUE.replace("-3e-2", "-1e-2"), FREE_TORQUE + "low = -1e-2\n",
                     name="bound.toml")
    found = fitted(run, bound)
    assert "bound" in found["sentence"]
    torque = found["unknowns"]["perturbation[0].torque[2]"]
    assert torque["value"] == torque["scaled_value"] == -1e-2
    for one in found["unknowns"].values():
        assert abs(one["scaled_value"] - one["value"]) < one["error"]
