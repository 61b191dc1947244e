# SPDX-License-Identifier: MIT
"""Kinds that are registered from Python: files that name them run, vary and are fitted as files
with built-in kinds, and mistakes are reported at their place."""

import concurrent.futures
import inspect
import json
import multiprocessing
import pickle
import subprocess
import sys

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from numpy.testing import assert_array_equal
from polhode.kinds import (
    ColumnKind,
    ExperimentKind,
    Key,
    ObservationKind,
    OrbitKind,
    PerturbationKind,
)
from rejections import rejected

HEAD = """schema = 1
units = { time = "s", angle = "deg", moment = "kg m2", length = "km" }
[body]
moments = [4.0, 5.0, 6.0]
[state.attitude-rate]
quaternion = [1.0, 0.0, 0.0, 0.0]
omega_body = [1.0, 2.0, 30.0]
[time]
stop = 60
step = 5
"""
PUSH_ALONE = '[[perturbation]]\nkind = "push"\n'
PUSH = '[[perturbation]]\nkind = "py-push"\ntorque = [0, "0.002 N m", 0]\n'
CONSTANT = PUSH.replace("py-push", "constant-torque")

TORQUE = Key("torque", "Along the body axes.", "torque", form="numbers", length=3,
             required=True, example=[0, 0, "1 N m"])


def push(table):
    return polhode.ConstantTorque(table.principal(table["torque"]), name="push")


def brake(table):
    axis, damping, limit = table.principal(table["axis"]), table["damping"], table["limit"]
    if not axis.any():
        table.refuse("axis", "expected a vector that has a direction")
    if limit > 1e3:
        raise ValueError("expected a weaker brake")
    body = table.body

    def torque(t, s):
        rate = axis @ (s.g / body.moments)
        return -limit * np.tanh(damping / limit * rate) * axis

    return polhode.TorqueTerm(torque, name="brake")


def circle(table):
    path = polhode.KeplerOrbit(polhode.KeplerElements(table["gm"], table["radius"], 0.0))
    return path if table["plain"] else (path, table["gm"])


def pendulum(table):
    rate, amplitude = table["rate"], table["amplitude"]

    def formula(t):
        return amplitude * np.cos(rate * t), -amplitude * rate * np.sin(rate * t)

    return {"columns": [("x", "angle"), ("v", "rate")], "formula": formula}


def spiral(table):
    times = np.linspace(table.span[0] - 1, table.span[1] + 1, 40)
    angle = times / 500
    r = 7000 - times
    return polhode.TableOrbit(times, np.stack([r * np.cos(angle), r * np.sin(angle), 0 * r], 1))


def pair(table):
    assert "first" not in table or "second" not in table
    assert list(table) == ["first", "second"] and "third" not in table
    size = table["first"] if "first" in table else table["second"]
    return polhode.ConstantTorque([size, 0, 0])


kept = []


def keep(table):
    kept.append(table)
    return []


PyPush = polhode.kinds.register(
    PerturbationKind("py-push", "A push of constant torque.", [TORQUE], push))
PyBrake = polhode.kinds.register(PerturbationKind(
    "py-brake", "A brake about one axis of the body, of a limited torque.",
    [Key("axis", "The axis, along the body axes.", "number", form="numbers", length=3,
         default=[0, 0, 1]),
     Key("damping", "Torque per rate, if small.", "damping", range="positive", default=0.01),
     Key("limit", "The largest torque.", "torque", required=True, range="positive", example=0.001)],
    brake, citations=[("brake2026", "A. Author (2026). On brakes.", "the brake")]))
polhode.kinds.register(PerturbationKind("py-empty", "A kind that makes no term.", [], keep))
polhode.kinds.register(OrbitKind(
    "py-circle", "A circle.",
    [Key("gm", "Of the planet.", "gm", required=True, range="positive",
         example="398600.4418 km3/s2"),
     Key("radius", "Of the circle.", "length", required=True, range="positive", example="7000 km"),
     Key("plain", "Whether the function returns the orbit alone.", form="flag", default=True)],
    circle))
polhode.kinds.register(ExperimentKind(
    "py-pendulum", "A pendulum of small amplitude.",
    [Key("rate", "Of its phase.", "rate", required=True, example="1 rad/s"),
     Key("amplitude", "Of the angle.", "angle", default="0.1 rad")], pendulum))


polhode.kinds.register(OrbitKind("py-spiral", "A spiral, from positions.", [], spiral))
polhode.kinds.register(PerturbationKind(
    "py-pair", "A torque about axis 1, given in one of two ways.",
    [Key("first", "One way.", "torque", example=0.1), Key("second", "Another way.", "torque",
                                                           example=0.2)],
    pair, sets="first|second"))


def wobble(omega, g):
    rate = np.linalg.norm(omega)
    return rate, np.arccos(omega @ g / rate / np.linalg.norm(g))


polhode.kinds.register(ColumnKind(
    "py-wobble", "Rate of rotation, and the angle from the angular momentum to its axis.",
    [("py_rate", "rate"), ("py_angle", "angle")], wobble,
    citations=[("wobble2026", "B. Author (2026). On wobbles.", "the wobble")]))
polhode.kinds.register(ColumnKind(
    "py_parts", "The time, twice an energy, the momentum and a column of another kind.",
    [("py_time", "time"), ("py_energy", "energy"), ("py_momentum", "momentum"),
     ("py_degrees", polhode.kinds.Dimension.number)],
    lambda t, E, state, py_angle, scale=2.0: (t, scale * E, np.linalg.norm(state.g),
                                              np.degrees(py_angle))))
GRAVITY = ('[orbit.o]\ngm = "398600.4418 km3/s2"\npericentre = 7000\n[[perturbation]]\n'
           'kind = "gravity-gradient"\norbit = "o"\n')
def sun_angle(table):
    sun = table["sun"] / np.linalg.norm(table["sun"])

    def angle(q, omega):
        w, v = q[0], q[1:]
        axis = np.array([0.0, 0.0, 1.0])
        turned = axis + 2 * np.cross(v, np.cross(v, axis) + w * axis)  # axis 3 in inertial axes
        return np.arccos(turned @ sun), np.linalg.norm(omega)

    return {"columns": [("angle", "angle"), ("spin", "rate")],
            "sigma": [table["sigma"], table["sigma_spin"]], "function": angle}


polhode.kinds.register(ObservationKind(
    "py-sun-angle", "The angle from body axis 3 to the Sun, and the rate of rotation.",
    [Key("sun", "Direction of the Sun.", "number", form="numbers", length=3, default=[1, 0, 0]),
     Key("sigma", "Error of the angle.", "angle", required=True, range="positive",
         example="0.1 deg"),
     Key("sigma_spin", "Error of the rate.", "rate", required=True, range="positive",
         example="0.01 deg/s")],
    sun_angle, citations=[("sun2026", "C. Author (2026). On Suns.", "the angle to the Sun")]))
COLUMNS = '[output]\ncolumns = ["omega", "g", "energy", "py-wobble", "py_parts"]\n'


def scenario(*parts, name="made.toml"):
    return polhode.Scenario.from_text(HEAD + "".join(parts), name)


def same(a, b):
    return all(np.array_equal(a[name], b[name]) for name in ("qw", "qy", "w1", "w3"))


def torque_of(loaded):
    return polhode.rates.effect(loaded.system, 0.0, loaded.initial_state).u


def test_a_registered_torque_runs_as_the_built_in_one():
    ours, theirs = scenario(PUSH).run(), scenario(CONSTANT).run()
    assert same(ours, theirs)
    assert [term.name for term in scenario(PUSH).system.terms] == ["push"]


def test_a_torque_written_in_python_runs_as_in_integrate():
    loaded = scenario('[[perturbation]]\nkind = "py-brake"\nlimit = "0.002 N m"\n')
    result = loaded.run()
    term = loaded.system.terms[0]
    system = polhode.System(loaded.body, terms=[term])
    problem = polhode.Problem(system, loaded.initial_state, 0.0, 60.0)
    direct = polhode.integrate(problem, loaded.time)
    assert np.array_equal(result["qx"], direct.states.q[:, 1])
    energy = polhode.kinetic_energy(loaded.body, direct.states)
    assert energy[-1] < 0.95 * energy[0]


def test_members_on_threads_are_the_same():
    vary = {"perturbation[0].torque[1]": polhode.vary.normal(0.002, 0.0005)}
    results = [scenario(part).ensemble(vary=vary, size=20, threads=threads, keep="final")
               for part, threads in ((PUSH, 1), (PUSH, 2), (CONSTANT, 1))]
    for other in results[1:]:
        for name in ("qw", "w3"):
            assert np.array_equal(results[0][name], other[name])
    assert np.ptp(results[0]["qw"]) > 0


def test_worker_processes_know_what_was_registered():
    vary = {"perturbation[0].torque[1]": polhode.vary.normal(0.002, 0.0005)}
    fork = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=fork) as pool:
        ours = scenario(PUSH).ensemble(vary=vary, size=4, executor=pool, keep="final")
    assert np.array_equal(
        ours["w3"], scenario(CONSTANT).ensemble(vary=vary, size=4, keep="final")["w3"]
    )


def test_a_map_varies_its_numbers():
    grid = ('[map]\nkind = "column"\ncolumn = "w2"\n[[map.axis]]\nkey = "perturbation[0].torque[1]"'
            "\nfrom = 0\nto = 0.01\ncount = 3\n")
    ours, theirs = (scenario(part, grid).map(threads=2) for part in (PUSH, CONSTANT))
    assert np.array_equal(ours["w2_last"], theirs["w2_last"])
    assert len(set(ours["w2_last"].ravel())) == 3


def test_a_fit_finds_its_torque(tmp_path):
    fitted = HEAD.replace("schema = 1\n", 'schema = 1\nkind = "fit"\n') + (
        '[free]\nunknowns = ["attitude", "rate"]\n[[observation]]\nkind = "attitude"\n'
        'file = "seen.csv"\ntimes = "at-body"\nsigma = 0.1\n')
    free = '[[free.parameter]]\nkey = "perturbation[0].torque[1]"\n'
    paths = []
    for name, part in (("ours", PUSH), ("theirs", CONSTANT)):
        paths.append(tmp_path / f"{name}.toml")
        paths[-1].write_text(fitted + part + free)
    polhode.fit.simulate(paths[1], tmp_path)
    ours, theirs = (polhode.fit.fit_scenario(path) for path in paths)
    found, other = (fit[0].unknowns["perturbation[0].torque[1]"] for fit in (ours, theirs))
    assert found.value == other.value
    assert abs(found.value - 0.002) < 5 * found.error < 0.002


@pytest.mark.parametrize("plain", ["true", "false"])
def test_a_registered_orbit_is_that_of_its_elements(plain):
    gravity = '[[perturbation]]\nkind = "gravity-gradient"\norbit = "o"\n'
    ours = ('[orbit.o]\nkind = "py-circle"\ngm = "398600.4418 km3/s2"\nradius = 7000\n'
            f"plain = {plain}\n")
    theirs = '[orbit.o]\ngm = "398600.4418 km3/s2"\npericentre = 7000\n'
    assert same(scenario(ours, gravity).run(), scenario(theirs, gravity).run())


def test_an_orbit_of_positions_covers_the_run():
    made = scenario('[orbit.o]\nkind = "py-spiral"\n[[perturbation]]\nkind = "gravity-gradient"\n'
                    'orbit = "o"\ngm = "398600.4418 km3/s2"\n')
    assert made.run().outcome.ok
    assert made.orbits["o"].first_time <= 0 and made.orbits["o"].last_time >= 60


def test_one_of_a_set_of_keys_is_there():
    made = polhode.Scenario.from_text(polhode.kinds.template("py-pair"), "pair.toml")
    assert torque_of(made).any()
    with pytest.raises(polhode.ScenarioError, match="expected exactly one of first, second"):
        scenario('[[perturbation]]\nkind = "py-pair"\nfirst = 1\nsecond = 2\n')


def test_a_kind_may_be_replaced():
    for size in (1.0, 2.0):
        polhode.kinds.register(PerturbationKind(
            "py-new", "A torque that changes.", [],
            lambda table, size=size: polhode.ConstantTorque([size, 0, 0])), replace=True)
        assert torque_of(scenario('[[perturbation]]\nkind = "py-new"\n'))[0] == size
    assert polhode.kinds.registered().count("py-new") == 1


def test_a_scenario_that_is_alive_at_exit_is_no_leak():
    code = ("import polhode; from polhode.kinds import *\n"
            "register(PerturbationKind('push', 'A push.', [],\n"
            "         lambda table: polhode.TorqueTerm(lambda t, s: (0, 0, 0.1))))\n"
            f"s = polhode.Scenario.from_text({(HEAD + PUSH_ALONE)!r})\n")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


FITTED = HEAD.replace("schema = 1\n", 'schema = 1\nkind = "fit"\n') + (
    '[free]\nunknowns = ["attitude", "rate"]\n')
SUN = ('[[observation]]\nkind = "py-sun-angle"\nfile = "{}.csv"\ntimes = "at-body"\n'
       'sigma = 0.1\nsigma_spin = 0.01\nsun = {}\n')


def sun_fit(folder, *suns, text=FITTED):
    path = folder / "sun.toml"
    path.write_text(text + "".join(SUN.format(f"seen{i}", sun) for i, sun in enumerate(suns)))
    return path


@pytest.mark.parametrize("part", ["", PUSH])
def test_a_registered_observation_is_simulated_and_fitted(tmp_path, part):
    path = sun_fit(tmp_path, [1, 0, 0], [0, 1, 0.2], [0.3, 0.2, 1], text=FITTED + part)
    polhode.fit.simulate(path, tmp_path)
    lines = (tmp_path / "seen1.csv").read_text().splitlines()
    assert "t,angle,spin" in lines and len([x for x in lines if x[0] != "#"]) == 14
    found = polhode.fit.fit_scenario(path)
    solution = found[0]
    true = dict(w_x=1.0, w_y=2.0, w_z=30.0)
    for name, value in true.items():
        unknown = solution.unknowns[name]
        assert abs(unknown.value - value) < 5 * unknown.error < 1.0
    residuals = solution.residuals
    assert {"r1", "r2"} <= set(residuals) and np.all(np.isnan(residuals["r3"]))
    r = np.concatenate([residuals["r1"], residuals["r2"]])
    assert 0.6 < np.sqrt(np.mean(r**2)) < 1.4
    assert "13 rows of py-sun-angle" in str(found)


def test_derivatives_of_a_registered_observation_are_those_of_the_built_in_one(tmp_path):
    def rate(table):
        return {"columns": [("w1", "rate"), ("w2", "rate"), ("w3", "rate")],
                "sigma": 3 * [table["sigma"]], "function": lambda omega: omega}

    polhode.kinds.register(ObservationKind("py-rate", "Rates.", [
        Key("sigma", "Its error.", "rate", required=True, range="positive", example=1)], rate))
    attitude = ('[[observation]]\nkind = "attitude"\nfile = "q.csv"\ntimes = "at-body"\n'
                "sigma = 0.1\n")
    fits = []
    for kind in ("rate", "py-rate"):
        path = tmp_path / f"{kind}.toml"
        path.write_text(FITTED + attitude + f'[[observation]]\nkind = "{kind}"\nfile = "w.csv"\n'
                        'times = "at-body"\nsigma = 0.02\n')
        if kind == "rate":
            polhode.fit.simulate(path, tmp_path)
        fits.append(polhode.fit.fit_scenario(path)[0])
    for name in ("w_x", "w_y", "w_z", "turn_x"):
        ours, theirs = (fit.unknowns[name] for fit in fits)
        assert_allclose(ours.value, theirs.value, rtol=0, atol=budgets.measured_fit * theirs.error)
        assert_allclose(ours.error, theirs.error, rtol=budgets.measured_fit)


@pytest.mark.parametrize("made, message", [
    ([], '{"columns": [(name, dimension), ...], "sigma": numbers'),
    ({"columns": [("x", "angle")], "sigma": [1, 2], "function": lambda t: t},
     "expected 1 positive numbers, one for each column"),
    ({"columns": [("x", "angle")], "sigma": 0, "function": lambda t: t},
     "expected 1 positive numbers"),
    ({"columns": [("x", "angel")], "sigma": 1, "function": lambda t: t},
     "dimension: got 'angel'"),
    ({"columns": [("x", "angle")], "sigma": 1, "function": lambda w: w},
     'got the parameter "w"; expected t, q or omega'),
])
def test_what_an_observation_returns_is_checked(made, message):
    polhode.kinds.register(ObservationKind("py-seen", "A kind.", [], lambda table: made),
                           replace=True)
    text = FITTED + ('[[observation]]\nkind = "py-seen"\nfile = "x.csv"\ntimes = "at-body"\n')
    with pytest.raises((polhode.ScenarioError, TypeError, ValueError)) as raised:
        polhode.Scenario.from_text(text, "seen.toml")
    assert message in str(raised.value)


def test_a_registered_observation_is_in_schema_template_and_citations(tmp_path):
    assert '"py-sun-angle"' in polhode.kinds.schema()
    made = polhode.Scenario.from_text(polhode.kinds.template("py-sun-angle"), "sun.toml")
    assert "sun2026" in [citation.key for citation in made.citations]
    with pytest.raises(ValueError, match='key "file" is one of all observations'):
        polhode.kinds.register(ObservationKind("py-x", "A kind.", [
            Key("file", "A file.", form="file")], sun_angle))
    with pytest.raises(polhode.ScenarioError, match="sigma: got nothing; expected an angle"):
        polhode.Scenario.from_text(FITTED + SUN.format("x", [1, 0, 0]).replace("sigma = 0.1\n", ""),
                                   "sun.toml")


def test_registered_columns_are_functions_of_the_others():
    made = scenario(COLUMNS, GRAVITY)
    rows = made.run()
    omega = np.radians(np.stack([rows["w1"], rows["w2"], rows["w3"]], 1))
    g = np.stack([rows["g1"], rows["g2"], rows["g3"]], 1)
    rate, size = np.linalg.norm(omega, axis=1), np.linalg.norm(g, axis=1)
    assert_allclose(rows["py_rate"], np.degrees(rate), rtol=budgets.numpy_formula)
    cosine = np.einsum("ij,ij->i", omega, g) / rate / size
    assert_allclose(np.cos(np.radians(rows["py_angle"])), cosine, rtol=budgets.numpy_formula)
    assert np.array_equal(rows["py_time"], rows["t"])
    assert_allclose(rows["py_energy"], 2 * rows["E"], rtol=budgets.numpy_rounding)
    assert_allclose(rows["py_momentum"], size, rtol=budgets.numpy_formula)
    assert_allclose(rows["py_degrees"], rows["py_angle"], rtol=budgets.numpy_formula)
    assert rows.units["py_rate"] == "deg/s" and rows.units["py_degrees"] == "1"
    assert [citation.key for citation in made.citations][-1] == "wobble2026"
    assert '"py-wobble"' in polhode.kinds.schema()


def test_registered_columns_are_those_of_a_trajectory():
    made = scenario(COLUMNS, GRAVITY)
    trajectory = polhode.integrate(
        polhode.Problem(made.system, made.initial_state, 0.0, 60.0), made.time)
    columns = trajectory.columns(["py-wobble", "py_energy"], system=made.system)
    rows = made.run()
    assert_allclose(np.degrees(columns["py_rate"]), rows["py_rate"], rtol=budgets.numpy_formula)
    assert_allclose(columns["py_energy"], rows["py_energy"], rtol=budgets.numpy_formula)


@pytest.mark.parametrize("method", ["", '[method]\nkind = "adaptive"\n'])
def test_events_and_maps_have_registered_columns(method):
    event = '[[event]]\ncolumn = "py_angle"\nvalue = 1\n'
    found = scenario(COLUMNS, event, method).run().events
    assert found and all(one.name == "py_angle" for one in found)
    for one in found:
        omega = polhode.angular_velocity(polhode.Body(4, 5, 6), one.s)
        assert_allclose(np.degrees(wobble(omega, one.s.g)[1]), 1.0,
                        rtol=budgets.small_arccosine)
    grid = ('[map]\nkind = "column"\ncolumn = "py_rate"\n[[map.axis]]\n'
            'key = "state.attitude-rate.omega_body[2]"\nfrom = 20\nto = 30\ncount = 3\n')
    made = scenario(grid, method)
    serial, threads = made.map(threads=1), made.map(threads=2)
    assert np.array_equal(serial["py_rate_last"], threads["py_rate_last"])
    assert np.all(np.diff(serial["py_rate_smallest"]) > 0)


@pytest.mark.parametrize("part", ["", GRAVITY])
def test_members_on_threads_have_registered_columns(part):
    vary = {"state.attitude-rate.omega_body[2]": polhode.vary.normal(30.0, 3.0)}
    made = scenario(COLUMNS, part)
    one, two = (made.ensemble(vary=vary, size=20, threads=n, keep="final") for n in (1, 2))
    for name in ("py_rate", "py_angle", "py_energy"):
        assert np.array_equal(one[name], two[name])
    rates = np.linalg.norm([one["w1"], one["w2"], one["w3"]], axis=0)
    assert_allclose(one["py_rate"], rates, rtol=budgets.numpy_formula)
    assert np.ptp(rates) > 1


def test_columns_of_an_energy_are_rejected_if_a_perturbation_has_none():
    with pytest.raises(polhode.ScenarioError, match="expected no energy"):
        scenario('[output]\ncolumns = ["py_parts"]\n',
                 '[[perturbation]]\nkind = "py-brake"\nlimit = 1\n')


def test_what_a_function_of_columns_raises_ends_the_run():
    calls = []

    def fails(t):
        calls.append(t)
        if t == 0.0:
            raise ArithmeticError("not at t = 0")
        return [1.0, 2.0] if t == 15.0 else 1.0

    kind = ColumnKind("py_fails", "A column that fails.", [("py_failing", "number")], fails)
    polhode.kinds.register(kind, replace=True)
    assert calls == [0.0]
    output = '[output]\ncolumns = ["py_fails"]\n'
    with pytest.raises(ArithmeticError, match="not at t = 0"):
        scenario(output).run()
    with pytest.raises(ValueError, match=r'group "py_fails": the function returned \[1.0, 2.0\]; '
                                         "expected 1 number, one for each column"):
        polhode.Scenario.from_text(HEAD.replace("stop", "start = 5\nstop") + output, "s.toml").run()


@pytest.mark.parametrize("columns, message", [
    ([("t", "time")], "other than t"), ([("x", "angle"), ("x", "rate")], "there once"),
    ([("x,y", "angle")], "letters, digits and _"), (["x"], "columns of (name, dimension)"),
    ([], "at least one column"), ([("x", "angel")], "dimension: got 'angel'"),
])
def test_columns_of_an_experiment_are_checked(columns, message):
    polhode.kinds.register(ExperimentKind(
        "py-columns", "Columns.", [], lambda table: {"columns": columns, "formula": abs}),
        replace=True)
    with pytest.raises(polhode.ScenarioError) as error:
        polhode.Scenario.from_text('schema = 1\nkind = "py-columns"\n[py-columns]\n'
                                   "[time]\nstop = 3\nstep = 1\n", "columns.toml")
    assert message in str(error.value) and str(error.value).startswith("columns.toml:")


def test_a_registered_experiment_has_its_columns():
    text = ('schema = 1\nkind = "py-pendulum"\nunits = { time = "s", angle = "deg" }\n'
            '[py-pendulum]\nrate = "2 rad/s"\n[time]\nstop = 3\nstep = 1\n')
    result = polhode.Scenario.from_text(text, "pendulum.toml").run()
    t = np.arange(4.0)
    assert_allclose(result["x"], np.degrees(0.1 * np.cos(2 * t)))
    assert_allclose(result["v"], np.degrees(-0.2 * np.sin(2 * t)))


@pytest.mark.parametrize("part, message", [
    ('limit = 0', "made.toml:13:9: perturbation[0].limit: got 0; expected a positive torque"),
    ('limit = 1\naxis = [0, 0, 0]',
     "made.toml:14:8: perturbation[0].axis: got [0, 0, 0]; expected a vector that has a direction"),
    ('limit = 2000',
     'made.toml:12:8: perturbation[0].kind: got "py-brake"; expected a weaker brake'),
    ('limt = 1', "did you mean limit?"),
    ('', "perturbation[0].limit: got nothing; expected a torque"),
])
def test_mistakes_are_reported_at_their_place(part, message):
    with pytest.raises(polhode.ScenarioError) as error:
        scenario('[[perturbation]]\nkind = "py-brake"\n', part, "\n")
    assert message in str(error.value)


def test_what_else_the_function_raises_passes_through():
    def fails(table):
        return table["unknown"]

    polhode.kinds.register(PerturbationKind("py-fails", "A kind with a mistake.", [], fails))
    with pytest.raises(KeyError, match='got "unknown"; expected a key of the kind'):
        scenario('[[perturbation]]\nkind = "py-fails"\n')


def test_the_table_ends_with_the_call():
    with pytest.raises(ValueError, match="expected a term or a list of terms"):
        scenario('[[perturbation]]\nkind = "py-empty"\n')
    with pytest.raises(ValueError, match="only while its function makes"):
        kept[0]["x"]


def test_scenarios_and_results_are_pickled():
    loaded = scenario(PUSH)
    again = pickle.loads(pickle.dumps(loaded))
    assert again.text == loaded.text and same(again.run(), loaded.run())


def test_schema_template_and_citations_know_it():
    branches = json.dumps(json.loads(polhode.kinds.schema())["properties"]["perturbation"])
    assert "py-push" in branches
    made = polhode.Scenario.from_text(polhode.kinds.template("py-brake"), "brake.toml")
    assert [citation.key for citation in made.citations if "brake" in citation.key] == ["brake2026"]
    assert {"py-push", "py-circle", "py-pendulum"} <= set(polhode.kinds.registered())


@pytest.mark.parametrize("call, error, message", [
    (lambda: Key("x", "A length."), ValueError,
     'Key "x": got no dimension; expected one of number'),
    (lambda: Key("x", "A length.", "lenght"), ValueError, "dimension: got 'lenght'"),
    (lambda: Key("x", "A length.", 3), TypeError, "expected a Dimension or its name"),
    (lambda: Key("x", "A length", "length"), ValueError, "a sentence with a full stop"),
    (lambda: Key("", "A length.", "length"), ValueError, "got no name"),
    (lambda: Key("x", "A text.", "length", form="text"), ValueError, "expected none for a text"),
    (lambda: Key("x", "A word.", form="word"), ValueError, "expected them for the form"),
    (lambda: Key("x", "A length.", "length", form="scalar"), ValueError, "form: got 'scalar'"),
    (lambda: Key("x", "A length.", "length", range="even"), ValueError, "range: got 'even'"),
    (lambda: Key("x", "A length.", "length", default=1, required=True), ValueError,
     "expected none for a required key"),
    (lambda: PerturbationKind("py-x", "A kind.", ["torque"], push), TypeError,
     "expected Key objects"),
    (lambda: PerturbationKind("py-x", "A kind.", [TORQUE], 3), TypeError,
     "a function of a KindTable"),
    (lambda: PerturbationKind("py-x", "A kind.", [], push, citations=[("a", "b")]), ValueError,
     "expected (key, text, reason)"),
    (lambda: polhode.kinds.register(push), TypeError, "expected a PerturbationKind, an OrbitKind"),
    (lambda: polhode.kinds.register(PerturbationKind("py-push", "A kind.", [], push)), ValueError,
     '"py-push" was registered before; expected another name or replace=True'),
    (lambda: polhode.kinds.register(PerturbationKind(
        "py-x", "A kind.", [Key("y", "A length.", "length", range="positive", default=-1)], push)),
     ValueError, "expected a positive length"),
    (lambda: Key("x", "A length.", "length", form="numbers", length=2.5), ValueError,
     "length: got 2.5"),
    (lambda: Key("x", "A length.", "length", length=3), ValueError, "length: got 3"),
    (lambda: Key("x", "A word.", form="word", words="abc"), ValueError, "a sequence of str"),
    (lambda: PerturbationKind("py-x", "A kind.", [TORQUE], push, sets="torque|y"), ValueError,
     'key "torque": got required=True; expected False for a key of sets'),
    (lambda: ExperimentKind("py-x", "A kind.", [], pendulum, sets="a|b"), ValueError,
     "expected none"),
    (lambda: ColumnKind("py-x", "A kind.", ["x"], wobble), TypeError,
     'ColumnKind "py-x": columns: got \'x\'; expected (name, dimension)'),
    (lambda: ColumnKind("py-x", "A kind.", [("x", None)], wobble), ValueError,
     'column "x": got no dimension; expected one of number'),
    (lambda: ColumnKind("py-x", "A kind.", [("x", "angel")], wobble), ValueError,
     "dimension: got 'angel'"),
    (lambda: ColumnKind("py-x", "A kind.", [("x", "angle")], 3), TypeError,
     "function: got 3; expected a function whose parameters are named after"),
    (lambda: ColumnKind("py-x", "A kind.", [("x", "angle")], lambda *a: 1), TypeError,
     "function: got the parameter *a; expected a function whose parameters"),
    (lambda: polhode.kinds.register(ColumnKind("py-x", "A kind.", [("x", "angle")],
                                               lambda omga: 1)), ValueError,
     'column group "py-x": function: got the parameter "omga"; expected t, state, system, or the'),
    (lambda: polhode.kinds.register(ColumnKind("py-x", "A kind.", [("x", "angle")], wobble)),
     ValueError, "expected 1 number, one for each column"),
    (lambda: polhode.kinds.register(ColumnKind("py-x", "A kind.", [("x", "angle")],
                                               lambda t: None)), TypeError,
     "the function returned None; expected 1 number, one for each column"),
    (lambda: polhode.kinds.register(ColumnKind("py-x", "A kind.", [], lambda t: [])), ValueError,
     "got 0 columns; expected 1 to 16"),
    (lambda: polhode.kinds.register(ColumnKind("omega", "A kind.", [("x", "angle")],
                                               lambda t: t)), ValueError,
     'column group "omega" is there; expected another name'),
    (lambda: polhode.kinds.register(ColumnKind("py-x", "A kind.", [("w3", "rate")],
                                               lambda t: t)), ValueError,
     'column "w3" is there; expected another name'),
    (lambda: polhode.kinds.register(ColumnKind("py-wobble", "A kind.", [("x", "rate")],
                                               lambda t: t)), ValueError,
     '"py-wobble" was registered before; expected another name or replace=True'),
    (lambda: polhode.kinds.register(PerturbationKind("damping", "A kind.", [], push)), ValueError,
     'perturbation "damping" is there; expected another name'),
    (lambda: polhode.kinds.register(PerturbationKind("py-x", "A kind.", [TORQUE, TORQUE], push)),
     ValueError, "is there twice; expected another name"),
    (lambda: polhode.kinds.register(PerturbationKind(
        "py-x", "A kind.", [Key("y", "A length.", "length", default="3 s")], push)), ValueError,
     "a length"),
])
def test_wrong_descriptions_are_rejected(call, error, message):
    before = polhode.kinds.registered()
    with pytest.raises(error) as raised:
        call()
    assert message in str(raised.value)
    assert polhode.kinds.registered() == before


def test_a_registered_kind_has_a_class_like_those_of_the_library():
    assert PyPush.__name__ == "PyPush" and PyPush.__match_args__ == ("torque", "body")
    assert list(inspect.signature(PyBrake).parameters) == ["limit", "axis", "damping", "body"]
    assert "A brake about one axis" in PyBrake.__doc__ and "positive" in PyBrake.__doc__
    term = PyPush([0, 0.002, 0])
    assert isinstance(term, polhode.types.AnyPerturbation) and term.kind == "py-push"
    assert repr(term) == "PyPush(torque=(0.0, 0.002, 0.0))"
    assert_array_equal(term.torque, [0, 0.002, 0])
    again = pickle.loads(pickle.dumps(term))
    assert again == term and hash(again) == hash(term) and type(again) is PyPush
    assert term != PyPush([0, 0.003, 0])


def test_terms_of_registered_kinds_are_built_and_read_back():
    file = polhode.Scenario.from_text(HEAD + PUSH + """[[perturbation]]
kind = "py-brake"
limit = 0.001
""")
    terms = [PyPush([0, 0.002, 0]), PyBrake(0.001, body=file.body)]
    assert list(file.system.terms) == terms
    system = polhode.System(file.body, None, terms)
    built = polhode.Scenario.build(
        system, file.initial_state, (0.0, 60.0, 5.0), units=file.units)
    assert list(built.system.terms) == terms and 'kind = "py-brake"' in built.text
    assert_allclose(built.run().groups["omega"], file.with_columns("omega").run().groups["omega"],
                    rtol=budgets.numpy_formula)
    weaker = built.replace({"perturbation.1.limit": 0.0005})
    assert weaker.system.terms[1] == PyBrake(0.0005, body=file.body)


@pytest.mark.parametrize(("make", "error", "words"), [
    (lambda: PyPush(), TypeError, "PyPush: got no torque; expected torque"),
    (lambda: PyPush([1, 2]), ValueError, r"torque: got shape \(2,\); expected \(3,\)"),
    (lambda: PyPush([1, 2, 3], turn=1), TypeError,
     "PyPush: got turn=1, an int; expected torque or body"),
    (lambda: PyBrake("x"), TypeError, "limit: got a str; expected real numbers"),
    (lambda: PyBrake(-1.0, body=polhode.Body(1, 2, 3)), ValueError,
     "PyBrake: limit: got -1.0; expected a positive"),
    (lambda: PyBrake(1.0), ValueError, "PyBrake: body: got nothing; expected the body"),
])
def test_arguments_that_a_class_of_a_kind_does_not_take(make, error, words):
    rejected(error, words, make)
