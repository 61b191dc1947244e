# SPDX-License-Identifier: MIT
"""Kinds that are registered from Python: files that name them run, vary and are fitted as files
with built-in kinds, and mistakes are reported at their place."""

import concurrent.futures
import json
import multiprocessing
import pickle
import subprocess
import sys

import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode.kinds import ExperimentKind, Key, OrbitKind, PerturbationKind

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


polhode.kinds.register(PerturbationKind("py-push", "A push of constant torque.", [TORQUE], push))
polhode.kinds.register(PerturbationKind(
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


def scenario(*parts, name="made.toml"):
    return polhode.Scenario.from_text(HEAD + "".join(parts), name)


def same(a, b):
    return all(np.array_equal(a[name], b[name]) for name in ("qw", "qy", "w1", "w3"))


def torque_of(loaded):
    return polhode.effect(loaded.system, 0.0, loaded.initial_state).u


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
    results = [polhode.ensemble(scenario(part), vary, size=20, threads=threads, keep="final")
               for part, threads in ((PUSH, 1), (PUSH, 2), (CONSTANT, 1))]
    for other in results[1:]:
        for name in ("qw", "w3"):
            assert np.array_equal(results[0][name], other[name])
    assert np.ptp(results[0]["qw"]) > 0


def test_worker_processes_know_what_was_registered():
    vary = {"perturbation[0].torque[1]": polhode.vary.normal(0.002, 0.0005)}
    fork = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=fork) as pool:
        ours = polhode.ensemble(scenario(PUSH), vary, size=4, executor=pool, keep="final")
    assert np.array_equal(ours["w3"], polhode.ensemble(scenario(CONSTANT), vary, size=4,
                                                       keep="final")["w3"])


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
    polhode.simulate(paths[1], tmp_path)
    ours, theirs = (polhode.fit(path) for path in paths)
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
