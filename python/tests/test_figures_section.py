# SPDX-License-Identifier: MIT
"""Poincare sections and errors of the energy: every point and line is what the runs say."""

import math
from types import SimpleNamespace

import budgets
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pytest
from closeness import assert_allclose
from matplotlib.colors import to_rgba
from numpy.testing import assert_array_equal
from polhode import (
    Adaptive,
    Body,
    Event,
    Frame,
    GravityGradient,
    KeplerElements,
    KeplerOrbit,
    Problem,
    RotorState,
    Scenario,
    Splitting,
    System,
    energy,
    figures,
    integrate,
    rotor_state,
    to_andoyer,
    to_euler,
)
from polhode.analysis import andoyer_section, spin_orbit_section
from polhode.figures.energy_error import FLOOR
from polhode.figures.section import states_of
from rejections import rejected

BODY = Body(1.0, 1.6, 2.0)
SYSTEM = System(BODY, Frame.precessing((0, 0, 1), 1.0),
                [GravityGradient(lambda t: (1.0, 0.0, 0.0), 1.0, axes="reference")])
START = rotor_state(BODY, [0.9, 0.3, 0.2, 0.1], [0.5, 0.2, 3.0])
EVENTS = [Event("half", lambda t, s: math.sin(t / 2)), Event("whole", lambda t, s: math.sin(t))]
RUN = integrate(Problem(SYSTEM, START, 0.0, 40.0, Adaptive(1e-10), EVENTS), dense=False)


def states_at_events(name=None, direction=None):
    records = [e for e in RUN.events if name in (None, e.name) and direction in (None, e.direction)]
    return RotorState([e.s.q for e in records], [e.s.g for e in records])


@pytest.mark.parametrize("name", [None, "half", "whole"])
@pytest.mark.parametrize("direction", [None, 1, -1])
def test_a_point_for_each_event_of_a_name_and_direction(name, direction):
    ax = figures.poincare_section(RUN, event=name, direction=direction)
    expected = to_andoyer(states_at_events(name, direction))
    assert_array_equal(ax.get_lines()[0].get_xydata(), np.stack([expected.l, expected.L], axis=-1))
    assert len(ax.get_lines()) == 1 and ax.get_lines()[0].get_linestyle() == "None"


def test_runs_have_colours_and_a_second_call_goes_on():
    ax = figures.poincare_section([RUN, RUN.events], event="half", label="two")
    figures.poincare_section(RUN.events, ax=ax)
    figures.poincare_section(states_at_events("whole"), ax=ax, color="0.5", size=2.0)
    colours = [line.get_color() for line in ax.get_lines()]
    assert len(set(colours)) == 4 and to_rgba(colours[3]) == to_rgba("0.5")
    sizes = [len(line.get_xdata()) for line in ax.get_lines()]
    half, whole = len(states_at_events("half")), len(states_at_events("whole"))
    assert sizes == [half, half, half + whole, whole]
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["two"]


def test_coordinates_are_fields_ratios_functions_and_columns():
    states = states_at_events()
    andoyer, euler = to_andoyer(states), to_euler(states)
    for x, y, expected in (
        ("h", "L/G", (andoyer.h, andoyer.L / andoyer.G)),
        ("theta", "Psi", (euler.theta, euler.Psi)),
        (lambda s: s.g[:, 2], lambda s: s.q[:, :1], (states.g[:, 2], states.q[:, 0])),
    ):
        ax = figures.poincare_section(RUN, x, y)
        assert_array_equal(ax.get_lines()[0].get_xydata(), np.stack(expected, axis=-1))
    ax = figures.poincare_section({"a": [1.0, 2.0], "b": [3.0, 5.0]}, "a", "b/a")
    assert_array_equal(ax.get_lines()[0].get_xydata(), [[1.0, 3.0], [2.0, 2.5]])
    ax = figures.poincare_section(
        RUN, "w", "J", elements=lambda s: SimpleNamespace(w=s.g[:, 0], J=s.g[:, 1])
    )
    assert_array_equal(ax.get_lines()[0].get_xydata(), states.g[:, :2])


MOON = Body(0.7, 0.95, 1.0)
ORBIT = KeplerOrbit(KeplerElements(gm=1.0, pericentre=0.9, eccentricity=0.1))
PLANAR = Problem(System(MOON, terms=[GravityGradient(ORBIT, 1.0)]),
                 rotor_state(MOON, [1, 0, 0, 0], [0, 0, 2.2]), 0.0, 60.0)


def test_sections_give_their_points():
    andoyer = andoyer_section(Problem(SYSTEM, START, 0.0, 40.0))
    ax = figures.poincare_section([andoyer, RUN], "l", "L/G", event="half")
    points = np.stack([andoyer.l, andoyer.L / andoyer.G], axis=-1)
    assert_array_equal(ax.get_lines()[0].get_xydata(), points)
    assert len(ax.get_lines()) == 2
    section = spin_orbit_section(PLANAR, ORBIT)
    ax = figures.poincare_section(section)
    assert_array_equal(
        ax.get_lines()[0].get_xydata(), np.stack([section.angle, section.spin], axis=-1)
    )
    assert ax.get_xlabel() == "angle of the long axis from the pericentre (rad)"
    assert ax.get_ylabel() == "spin / mean motion" and ax.get_xlim() == (-np.pi / 2, np.pi / 2)
    ax = figures.poincare_section(section, "tilt", lambda s: s.g[:, 2])
    assert_array_equal(ax.get_lines()[0].get_ydata(), section.states.g[:, 2])
    assert_array_equal(figures.poincare_section(section, "l", "G").get_lines()[0].get_ydata(),
                       to_andoyer(section.states).G)
    none = spin_orbit_section(Problem(PLANAR.system, PLANAR.initial, 1.0, 2.0), ORBIT)
    rejected(ValueError, "expected points", figures.poincare_section, none)


MAP = """schema = 1
units = { time = "d", angle = "deg" }
body.moments = [0.7, 0.95, 1]
orbit.planet = { gm = 1, semi_major_axis = 1, eccentricity = 0.1 }
perturbation = [{ kind = "gravity-gradient", orbit = "planet" }]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0, 0, 130] }
time = { stop = 60, step = 1 }
[[map.axis]]
key = "body.moments[1]"
from = 0.8
to = 2
count = 3
[map]
"""


def test_a_map_of_sections_is_a_run_for_each_start(tmp_path):
    scenario = Scenario.from_text(MAP + 'kind = "spin-orbit-section"\norbit = "planet"\n')
    points = scenario.map(tmp_path / "map.csv")
    assert len(points.failures) == 1  # of the three starts: a body with such a moment is none
    for source in (points, tmp_path / "map.csv", str(tmp_path / "map.csv"), [points]):
        ax = figures.poincare_section(source)
        assert len(ax.get_lines()) == 2
        for cell, line in enumerate(ax.get_lines()):
            assert_array_equal(line.get_xdata(), points["angle"][points.cell == cell])
            assert_array_equal(line.get_ydata(), points["spin"][points.cell == cell])
        assert ax.get_xlabel() == "angle of the long axis from the pericentre (deg)"
        assert ax.get_xlim() == (-90, 90)
    andoyer = Scenario.from_text(MAP + 'kind = "andoyer-section"\nangle = "g"\n').map()
    ax = figures.poincare_section(andoyer)
    assert ax.get_xlabel() == "$l$ (deg)" and ax.get_ylabel() == "$L$ (1/d)"
    chaos = Scenario.from_text(MAP + 'kind = "chaos"\n').map()
    with pytest.raises(ValueError, match="a map of body.moments.1., mean_megno, lyapunov"):
        figures.poincare_section(chaos)


def test_results_give_their_events():
    scenario = Scenario.from_text("""
schema = 1
body.moments = [30.53, 83.87, 113.3]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.01, 6.28, 0] }
event = [{ name = "turns-over", column = "w2" }]
time = { stop = 20, step = 1 }
output.columns = ["q", "g"]
""")
    results = scenario.run()
    states = states_of(results, "turns-over")
    assert states.shape == (len(results.events),) and len(results.events) > 3
    ax = figures.poincare_section(results, "l", "L/G")
    assert_allclose(np.abs(ax.get_lines()[0].get_xdata()), np.pi / 2)  # g2 = 0 is l = +-pi/2


def test_the_label_stands_beside_the_first_run_that_has_points():
    ax = figures.poincare_section([[], RUN], label="spin")
    assert ax.get_legend_handles_labels()[1] == ["spin"]


def test_axes_are_labelled_with_units():
    ax = figures.poincare_section(RUN, "l", "L/G")
    assert ax.get_xlabel() == "$l$ (rad)" and ax.get_ylabel() == "$L$ / $G$"
    assert ax.get_xlim() == (-np.pi, np.pi)
    ax = figures.poincare_section(RUN, lambda s: s.g[:, 0], "G")
    assert ax.get_xlabel() == "" and ax.get_ylabel() == "$G$"


@pytest.mark.parametrize(("call", "message"), [
    (lambda: figures.poincare_section(RUN, event="noon"),
     'no run met the event "noon"; expected points'),
    (lambda: figures.poincare_section([]), "no run met an event"),
    (lambda: figures.poincare_section(RUN, "k"), 'no coordinate "k"; expected one of l, g, h'),
    (lambda: figures.poincare_section({"a": [1.0], "b": [2.0]}, "a", "c"),
     'no column "c"; there are: a, b'),
])  # fmt: skip
def test_what_has_no_section(call, message):
    rejected(ValueError, message, call)


def test_a_run_without_events_takes_no_place():
    ax = figures.poincare_section([states_at_events("half"), [], RUN], event="half")
    assert len(ax.get_lines()) == 2
    assert states_of(RUN, "noon") is None


def run(method):
    return integrate(Problem(SYSTEM, START, 0.0, 40.0, method), np.linspace(0.0, 40.0, 81))


def test_an_error_is_that_of_the_energy():
    runs = {"fine": run(Adaptive(1e-12)), "coarse": run(Splitting(0.1))}
    ax = figures.energy_error(runs, SYSTEM, unit="s")
    for line, (name, one) in zip(ax.get_lines(), runs.items()):
        E = energy(SYSTEM, one.t, one.states)
        assert_array_equal(line.get_xdata(), one.t)
        assert_allclose(line.get_ydata(), np.maximum(abs(E - E[0]) / abs(E[0]), FLOOR),
                        rtol=budgets.chart_rounding)
        assert line.get_label() == name and line.get_ydata()[0] == FLOOR
    assert ax.get_yscale() == "log" and ax.get_xlabel() == "$t$ (s)"
    fine, coarse = (line.get_ydata().max() for line in ax.get_lines())
    assert fine < 1e-3 * coarse


def test_results_of_a_scenario_are_one_run():
    text = (
        "[body]\nmoments = [1, 1.6, 2]\n[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\n"
        "omega_body = [0.1, 0.2, 1]\n[time]\nstop = 20\nstep = 1\n"
    )
    results = Scenario.from_text("schema = 1\n" + text).with_columns(["q", "g"]).run()
    (line,) = figures.energy_error(results, results.scenario.system).get_lines()
    assert_array_equal(line.get_xdata(), results.t)
    assert line.get_ydata().max() < budgets.free_invariants


def test_labels_of_a_list_are_the_methods_or_given():
    runs = [run(Adaptive(1e-8)), run(Splitting(0.1))]
    ax = figures.energy_error(runs, SYSTEM)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [one.method for one in runs]
    _, mine = plt.subplots()
    assert figures.energy_error(runs[0], SYSTEM, mine) is mine and mine.get_legend() is None
    figures.energy_error(runs[1:], SYSTEM, mine, labels=["splitting"])
    assert [text.get_text() for text in mine.get_legend().get_texts()] == ["splitting"]
    assert mine.get_lines()[0].get_color() != mine.get_lines()[1].get_color()
    with pytest.raises(ValueError, match="got 1 labels; expected 2"):
        figures.energy_error(runs, SYSTEM, labels=["one"])


def test_an_energy_of_zero_has_no_relative_error():
    free = System(BODY)
    rest = SimpleNamespace(t=np.zeros(2), states=RotorState([1, 0, 0, 0], np.zeros((2, 3))))
    with pytest.raises(ValueError, match="first sample of still is 0; expected a number"):
        figures.energy_error({"still": rest}, free)
    nothing = SimpleNamespace(t=np.zeros(0), states=rest.states[:0])
    rejected(ValueError, "first sample of the run is unknown", figures.energy_error, nothing, free)
