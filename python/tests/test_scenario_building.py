# SPDX-License-Identifier: MIT
"""Scenario.build: objects become a file, and the file gives them back to the last bit."""

import budgets
import numpy as np
import polhode
import pytest
from polhode import (
    Adaptive,
    Body,
    Collocation,
    ConstantTorque,
    Frame,
    FreeRotation,
    GravityGradient,
    KeplerElements,
    KeplerOrbit,
    LinearDamping,
    PrecessingKeplerOrbit,
    Problem,
    RotorState,
    SaveAt,
    Scenario,
    Splitting,
    System,
    TorqueTable,
    TorqueTerm,
    VariationOfConstants,
    integrate,
)
from polhode.satellites import SecularRates

BODY = Body(1.0, 1.9, 2.3)
ELEMENTS = KeplerElements(0.7, 1.1, 0.01, 1.1, 0.2, 0.3, 0.4, 5.0)
ORBIT = KeplerOrbit(ELEMENTS)
UNITS = [{}, {"time": "h", "angle": "deg", "moment": "kg m2", "length": "km"},
         {"time": "d", "angle": "arcsec", "length": "au"}]
DRAW = np.random.default_rng(20260101)
STATES = [RotorState(q / np.linalg.norm(q), g) for q,
          g in zip(DRAW.normal(size=(40, 4)), DRAW.normal(size=(40, 3)))]

# In each chart what a file holds of a hub state.
CHARTS = {
    "euler": polhode.to_euler,
    "andoyer": polhode.to_andoyer,
    "serret": lambda s: polhode.to_serret(FreeRotation(BODY, s), 0.0),
    "sadov": lambda s: polhode.to_sadov(FreeRotation(BODY, s), 0.0),
    "poincare-0-0": lambda s: polhode.to_poincare(s, "zero", "zero"),
    "poincare-0-pi": lambda s: polhode.to_poincare(s, "zero", "pi"),
    "poincare-pi-0": lambda s: polhode.to_poincare(s, "pi", "zero"),
    "poincare-pi-pi": lambda s: polhode.to_poincare(s, "pi", "pi"),
}
TO_HUB = {"rotor": lambda s: s, "euler_rates": lambda s: polhode.charts.to_euler_rates(BODY, s),
          "free_rotation": lambda s: FreeRotation(BODY, s)}
HUB = {"rotor": lambda x: x, "euler_rates": lambda x: polhode.to_rotor(BODY, x),
       "free_rotation": lambda x: x.initial_state}


@pytest.mark.parametrize("units", UNITS, ids=["core", "deg", "arcsec"])
@pytest.mark.parametrize("chart", CHARTS)
def test_a_chart_of_files_keeps_its_bits(chart, units):
    for s in STATES:
        state = CHARTS[chart](s)
        made = Scenario.build(BODY, state, units=units)
        assert made.chart == chart and made.state == state


@pytest.mark.parametrize("units", UNITS, ids=["core", "deg", "arcsec"])
def test_a_poincare_state_starts_where_it_is(units):
    for s in STATES:
        state = polhode.charts.nearest_poincare(s)
        made = Scenario.build(BODY, state, units=units)
        assert made.state == state
        # in Python a state goes the way of many
        assert np.abs(made.initial_state.q - polhode.to_rotor(state).q).max() < budgets.io_state
        assert np.abs(made.initial_state.g - polhode.to_rotor(state).g).max() < budgets.io_state


@pytest.mark.parametrize("kind", TO_HUB)
def test_other_charts_become_the_state_of_the_hub(kind):
    for s in STATES:
        state = TO_HUB[kind](s)
        made = Scenario.build(BODY, state, units=UNITS[1])
        assert made.chart == "attitude-rate" and made.initial_state == HUB[kind](state)


@pytest.mark.parametrize("axes", ["inertial", "ecliptic-J2000", "equator-J2000"])
def test_a_tumbler_keeps_all_but_a_rounding_of_its_pole(axes):
    seen = 0
    for s in STATES:
        motion = FreeRotation(BODY, s)
        state = polhode.to_tumbler(motion, 0.0)
        made = Scenario.build(BODY, state, units=UNITS[1], axes=axes)
        back = made.state
        for name in ("precession_period", "rotation_period", "mode", "phi0", "psi0", "branch",
                     "sense"):
            assert getattr(back, name) == getattr(state, name)
        assert np.abs(back.pole - state.pole).max() < budgets.io_state
        seen += 1
    assert seen == len(STATES)


def system_of(frame=None):
    damping = [[1e-3, 1e-4, 0.0], [1e-4, 2e-3, 0.0], [0.0, 0.0, 1e-3]]
    return System(BODY, frame or Frame.precessing((0.2, -0.1, 1.0), 0.3, 0.7), [
        GravityGradient(PrecessingKeplerOrbit(ELEMENTS, SecularRates(1e-3, 2e-3, 3e-3)), 0.7),
        GravityGradient(ORBIT, 0.1),
        GravityGradient(KeplerOrbit(ELEMENTS), 0.7),
        ConstantTorque((1e-3, 0.1, 0.2)),
        ConstantTorque((1e-3, 0.1, 0.2), "inertial"),
        LinearDamping(1e-3),
        LinearDamping((1e-3, 0.0, 2e-3)),
        LinearDamping(damping, BODY),
    ])


@pytest.mark.parametrize("units", UNITS, ids=["core", "deg", "arcsec"])
def test_a_run_of_the_file_is_the_run_of_the_objects(units):
    system, s, times = system_of(), STATES[0], SaveAt.count(0.0, 3.0, 11)
    made = Scenario.build(system, s, times, Adaptive(1e-10), columns=["q", "g"], units=units)
    trajectory = integrate(Problem(system, s, 0.0, 3.0, Adaptive(1e-10)), times)
    results = made.run()
    assert results.states == trajectory.states
    assert results.t.tobytes() == trajectory.t.tobytes()
    assert len(made.orbits) == 2  # equal orbits are one
    assert [type(t) for t in made.system.terms] == [type(t) for t in system.terms]
    assert made.system.frame == system.frame
    again = Scenario.build(made.system, made.initial_state, made.time, made.method,
                           columns=made.columns, units=made.units)
    assert again == made


@pytest.mark.parametrize("method", [
    None, Adaptive(1e-9, largest_step=0.5), Adaptive(1e-20, "double_double"), Splitting(0.1),
    Splitting(0.1, "order6"), VariationOfConstants(1e-9), VariationOfConstants(1e-9, 2.0),
    Collocation(), Collocation(1e-9, 16, largest_step=0.5), Collocation(stages=4, step=0.1),
], ids=repr)
def test_methods(method):
    system = System(BODY, terms=[ConstantTorque((0.1, 0.0, 0.0))])
    made = Scenario.build(system, STATES[0], (0, 1, 0.5), method)
    assert made.method == (Collocation() if method is None else method)
    assert Scenario.build(BODY, STATES[0], (0, 1, 0.5)).method is None


@pytest.mark.parametrize("time", [
    SaveAt.steps(0.1, 7.3, 0.1), SaveAt.steps(3.0, -2.0, -0.7), SaveAt.count(0.1, 0.7, 7),
    SaveAt.times([3.0, 1.0, 0.1 + 0.2]), SaveAt.count(2.0, 2.0, 1),
])
def test_times_keep_their_bits(time):
    made = Scenario.build(BODY, STATES[0], time).time
    assert [made[k] for k in range(len(made))] == [time[k] for k in range(len(time))]


def test_three_times_and_a_span():
    span = Scenario.build(BODY, STATES[0], (0, 3, 1)).time
    times = Scenario.build(BODY, STATES[0], [0, 3, 1]).time
    assert [span[k] for k in range(len(span))] == [0.0, 1.0, 2.0, 3.0]
    assert [times[k] for k in range(len(times))] == [0.0, 3.0, 1.0]


def test_what_else_a_file_says():
    event = {"column": "theta", "value": 90, "crossing": "rising"}
    made = Scenario.build(
        BODY, STATES[0], (0, 20, 1), columns="euler", title="T", units={"angle": "deg"},
        events=[event], epoch="2013-01-05T00:00:00 UTC", axes="equator-J2000", name="a.toml",
    )
    assert (made.title, made.name, made.axes) == ("T", "a.toml", "equator-J2000")
    assert made.epoch == "2013-01-05T00:00:00 UTC" and made.columns == ("euler",)
    results = made.run()
    assert {e.name for e in results.events} == {"theta"} and results.units["theta"] == "deg"
    assert made.to_dict()["event"] == [event]


def test_a_tensor_becomes_its_principal_axes():
    body = Body.from_tensor([[1.9, 0.0, 0.2], [0.0, 1.0, 0.0], [0.2, 0.0, 2.3]])
    made = Scenario.build(body, STATES[1])
    assert made.body == body
    assert made.initial_state == STATES[1]


def fall(t, s):
    return (0.0, 0.0, 0.0)


REFUSED = [
    (System(BODY, terms=[TorqueTerm(fall, name="drag")]), "term \"drag\" (TorqueTerm) has no"),
    (System(BODY, Frame.orbit_plane(lambda t: 0.1 * t, 0.3)), "frame Frame.orbit_plane("),
    (System(BODY, terms=[GravityGradient(lambda t: (1, 0, 0), 1.0, name="moon")]),
     "term \"moon\": its orbit <function"),
]


@pytest.mark.parametrize(("system", "message"), REFUSED)
def test_what_has_no_place_in_a_file_is_named(system, message):
    with pytest.raises(ValueError) as error:
        Scenario.build(system, STATES[0])
    assert message in str(error.value)


@pytest.mark.parametrize("axes", ["inertial", "reference"])
def test_axes_of_a_moving_frame_are_kept(axes):
    frame = Frame.precessing((0.1, 0, 1), 0.1)
    system = System(BODY, frame, [
        ConstantTorque((1, 0, 0), axes), GravityGradient(ORBIT, axes=axes),
        TorqueTable([0, 1], torque_1=[1, 2], axes=axes)])
    made = Scenario.build(system, STATES[0], (0, 1, 0.5), Adaptive(1e-10), columns="g")
    assert [term.axes for term in made.system.terms] == [axes] * 3
    ran = integrate(Problem(system, STATES[0], 0.0, 1.0, Adaptive(1e-10)), [0.0, 0.5, 1.0])
    assert made.run()["g1"].tolist() == ran.states.g[:, 0].tolist()


@pytest.mark.parametrize(("call", "error", "message"), [
    (lambda: Scenario.build(3, STATES[0]), TypeError, "system: got 3"),
    (lambda: Scenario.build(BODY, RotorState([[1, 0, 0, 0]] * 2, [1, 2, 3])), TypeError,
     "state: got"),
    (lambda: Scenario.build(BODY, [1, 0, 0, 0]), TypeError, "state: got"),
    (lambda: Scenario.build(BODY, STATES[0], method="adaptive"), TypeError,
     "method: got 'adaptive'"),
    (lambda: Scenario.build(BODY, STATES[0], (0, "a", 1)), TypeError, r"time: got \(0, 'a', 1\)"),
    (lambda: Scenario.build(BODY, STATES[0], events=[3]), TypeError, "events: got 3"),
    (lambda: Scenario.build(BODY, STATES[0], units="h"), TypeError, "units: got"),
    (lambda: Scenario.build(BODY, STATES[0], units={"tiem": "h"}), TypeError, "units: got"),
    (lambda: Scenario.build(BODY, STATES[0], units={"time": "hours"}), ValueError,
     "did you mean h"),
    (lambda: Scenario.build(BODY, STATES[0], method=Adaptive(first_step=0.1)), ValueError,
     "first_step 0.1 has no place"),
    (lambda: Scenario.build(BODY, STATES[0], columns=["omgea"]), polhode.ScenarioError,
     "did you mean \"omega\""),
    (lambda: Scenario.build(BODY, STATES[0], (0, 1, -1)), polhode.DomainError, "a step of -1"),
])  # fmt: skip
def test_wrong_arguments(call, error, message):
    with pytest.raises(error, match=message):
        call()
