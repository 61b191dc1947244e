# SPDX-License-Identifier: MIT
"""Surfaces of section and maps from Python: the same points as SciPy's, files as from the command
line, threads, signals."""

import copy
import math
import pickle
import threading
import warnings

import budgets
import numpy as np
import pytest
from closeness import assert_allclose
from hyperion import HYPERION, ORBIT, SYSTEM
from interrupts import LATEST, seconds_from_signal
from numpy.testing import assert_array_equal
from polhode import (
    Adaptive,
    Body,
    DomainError,
    KeplerElements,
    KeplerOrbit,
    PrecessingKeplerOrbit,
    Problem,
    Scenario,
    ScenarioError,
    System,
    TorqueTerm,
    rotor_state,
    to_andoyer,
)
from polhode.analysis import AndoyerAngle, andoyer_section, spin_orbit_section
from polhode.satellites import SecularRates
from rejections import rejected

FREE = System(Body(1.0, 1.7, 2.2))


def planar(angle, spin, orbits, method=None):
    start = rotor_state(HYPERION, [math.cos(angle / 2), 0, 0, math.sin(angle / 2)], [0, 0, spin])
    stop = 2 * math.pi * orbits
    return Problem(SYSTEM, start, 0.0, stop, method or Adaptive(1e-13))


def tumbling(stop, method=None):
    start = rotor_state(FREE.body, [0.8, 0.2, -0.4, 0.4], [0.3, 0.5, 0.9])
    return Problem(FREE, start, 0.0, stop, method or Adaptive(1e-11))


def test_the_plane_of_spin_and_orbit_is_that_of_the_planar_equation():
    scipy = pytest.importorskip("scipy.integrate")
    optimize = pytest.importorskip("scipy.optimize")
    A, B, C = HYPERION.moments
    e = 0.1

    def rates(t, y):
        E = optimize.brentq(lambda E: E - e * math.sin(E) - t, t - e, t + e, xtol=1e-15)
        r = 1 - e * math.cos(E)
        f = math.atan2(math.sqrt(1 - e * e) * math.sin(E), math.cos(E) - e)
        return [y[1], -1.5 * (B - A) / C / r**3 * math.sin(2 * (y[0] - f))]

    at = 2 * math.pi * np.arange(9)
    exact = scipy.solve_ivp(
        rates, (0, at[-1]), [0.7, 2.5], t_eval=at, method="DOP853", rtol=1e-13, atol=1e-13
    )
    found = spin_orbit_section(planar(0.7, 2.5, 8), ORBIT)
    assert_array_equal(found.t, at)
    turned = found.angle - exact.y[0]
    assert_allclose(turned - np.pi * np.round(turned / np.pi), 0, atol=budgets.section_scipy)
    assert_allclose(found.spin, exact.y[1], atol=budgets.section_scipy)
    assert_array_equal(found.tilt, np.zeros(9))
    same = PrecessingKeplerOrbit(ORBIT.elements, SecularRates())
    assert_array_equal(spin_orbit_section(planar(0.7, 2.5, 8), same).spin, found.spin)


@pytest.mark.parametrize("angle", ["g", AndoyerAngle.g])
def test_points_of_andoyers_plane_are_where_g_passes(angle):
    found = andoyer_section(tumbling(60.0), angle, 0.5)
    assert len(found) > 5
    assert_allclose(found.g, np.full(len(found), 0.5), atol=budgets.section_rounding)
    andoyer = to_andoyer(found.states)
    for name in ("l", "g", "h", "L", "G", "H"):
        assert_array_equal(getattr(found, name), getattr(andoyer, name))
    assert np.all(np.diff(found.t) > 0)
    with pytest.raises(ValueError):
        found.l[0] = 1.0


def test_points_by_a_period():
    found = andoyer_section(tumbling(20.0), period=4.0, epoch=1.5)
    assert_array_equal(found.t, [1.5, 5.5, 9.5, 13.5, 17.5])
    assert len(andoyer_section(tumbling(1.0), period=4.0, epoch=1.5)) == 0


def test_copies_and_pickles():
    for found in (andoyer_section(tumbling(30.0)), spin_orbit_section(planar(1.0, 2.0, 5), ORBIT)):
        for other in (copy.copy(found), copy.deepcopy(found), pickle.loads(pickle.dumps(found))):
            assert_array_equal(other.t, found.t)
            assert other.states == found.states and other.method == found.method
            assert other.outcome.ok and other.statistics.steps == found.statistics.steps
    assert repr(found).startswith("<SpinOrbitSection: 6 points; adaptive")


def test_arrays_outlive_their_section():
    l = andoyer_section(tumbling(30.0)).l  # noqa: E741
    assert_array_equal(l, andoyer_section(tumbling(30.0)).l)


def test_what_has_no_section():
    with pytest.raises(DomainError, match="a circular orbit has no pericentre"):
        circle = KeplerOrbit(KeplerElements(gm=1.0, pericentre=1.0, eccentricity=0.0))
        spin_orbit_section(planar(0.0, 1.0, 1), circle)
    with pytest.raises(TypeError):
        spin_orbit_section(planar(0.0, 1.0, 1), lambda t: (1, 0, 0))
    with pytest.raises(ValueError, match="angle: got 'k'; expected one of l g h"):
        andoyer_section(tumbling(1.0), "k")
    rejected(DomainError, "period 0", andoyer_section, tumbling(1.0), period=0.0)


def test_a_run_that_fails_keeps_its_points():
    wall = TorqueTerm(lambda t, s: [math.nan if t > 20 else 0.0] * 3, "wall")
    problem = tumbling(50.0)
    problem = Problem(System(FREE.body, terms=[wall]), problem.initial, 0.0, 50.0)
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        found = andoyer_section(problem)
    assert len(found) > 1 and not found.outcome.ok and found.t[-1] < 20
    assert "andoyer_section: the run failed" in str(seen[0].message)


def test_ctrl_c_ends_a_section():
    assert seconds_from_signal(lambda: andoyer_section(tumbling(1e7))) < LATEST


MAP = """schema = 1
title = "A grid"
units = { time = "d", angle = "deg" }
body.moments = [0.7, 0.95, 1]
orbit.planet = { gm = 1, semi_major_axis = 1, eccentricity = 0.1 }
perturbation = [{ kind = "gravity-gradient", orbit = "planet" }]
state.attitude-rate = { euler = { phi = 20, theta = 0, psi = 0 }, omega_body = [0, 0, 130] }
time = { stop = 100, step = 1 }
[[map.axis]]
key = "state.attitude-rate.omega_body[2]"
from = 60
to = 180
count = 5
[[map.axis]]
key = "body.moments[1]"
from = 0.8
to = 2
count = 3
[map]
"""
CHAOS = MAP + 'kind = "chaos"\n'
SECTION = MAP + 'kind = "spin-orbit-section"\norbit = "planet"\n'


def test_a_map_is_that_of_its_cells():
    chart = Scenario.from_text(CHAOS).map(threads=2)
    assert list(chart) == [
        "state.attitude-rate.omega_body[2]", "body.moments[1]", "mean_megno", "lyapunov",
    ]  # fmt: skip
    assert chart.axes == tuple(chart)[:2] and chart.units["lyapunov"] == "1/d"
    assert_array_equal(chart["body.moments[1]"], np.tile([0.8, 1.4, 2.0], 5))
    assert_array_equal(chart.cell, np.arange(15))
    assert_array_equal(np.isnan(chart["mean_megno"]), np.tile([False, False, True], 5))
    assert [cell for cell, _ in chart.failures] == [2, 5, 8, 11, 14]
    assert "body.moments" in chart.failures[0][1]
    assert repr(chart).startswith("<MapResults: A grid: 15 rows of state.attitude-rate.omega")
    again = pickle.loads(pickle.dumps(chart))
    assert again == chart and again.failures == chart.failures
    with pytest.raises(KeyError):
        chart["theta"]
    with pytest.raises(ValueError):
        chart["lyapunov"][0] = 1.0


def test_the_scenario_of_a_cell_runs_to_its_numbers():
    text = MAP.replace("time = {", 'output.columns = ["omega"]\ntime = {')
    chart = Scenario.from_text(text + 'kind = "column"\ncolumn = "w3"\n').map()
    for k in (0, 7):
        cell = chart.cell_scenario(k)
        w3 = cell.run()["w3"]
        found = [chart[f"w3_{name}"][k] for name in ("smallest", "largest", "last")]
        assert found == [w3.min(), w3.max(), w3[-1]]  # NaN: no row has any
        assert cell.text.startswith(f"# Cell {k} of scenario.toml, 15 cells\n")
    with pytest.raises(ValueError, match="got cell 15; expected 0 to 14"):
        chart.cell_scenario(15)
    with pytest.raises(ValueError, match="body.moments"):
        chart.cell_scenario(2)


def test_a_map_of_sections_has_the_points_of_each_start():
    scenario = Scenario.from_text(SECTION)
    points = scenario.map()
    assert points.axes == tuple(points)[:2] and tuple(points)[2:] == ("t", "angle", "spin", "tilt")
    assert np.count_nonzero(points.cell == 0) == 16 and np.count_nonzero(points.cell == 2) == 1
    plain = Scenario.from_text(
        SECTION.replace("0.95", "0.8").replace("130]", "60]").partition("[[map.axis]]")[0]
    )
    problem = Problem(plain.system, plain.initial_state, 0.0, 100.0)
    found = spin_orbit_section(problem, plain.orbits["planet"])
    assert_array_equal(points["spin"][points.cell == 0], found.spin)
    assert_allclose(
        points["angle"][points.cell == 0], np.degrees(found.angle), atol=budgets.section_units
    )


def test_threads_and_files(tmp_path):
    scenario = Scenario.from_text(SECTION)
    one, two = tmp_path / "one.csv", tmp_path / "two.csv"
    reported = []
    first = scenario.map(one, threads=1, progress=lambda k, of: reported.append((k, of)))
    second = scenario.map([two, tmp_path / "two.h5"], threads=4)
    assert reported == [(k, 15) for k in range(1, 16)]
    assert first == second and one.read_bytes() == two.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.csv", "two.csv", "two.h5"]


def test_a_map_goes_on_where_it_was_stopped(tmp_path):
    scenario = Scenario.from_text(CHAOS)
    out = tmp_path / "map.csv"
    whole = scenario.map()

    class Enough(Exception):
        pass

    def stop(k, of):
        if k == 7:
            raise Enough

    before = threading.active_count()
    with pytest.raises(Enough):
        scenario.map(out, threads=3, progress=stop)
    assert threading.active_count() == before
    assert not out.exists() and (tmp_path / "map.csv.checkpoint").exists()
    rejected(ValueError, "unfinished map .* of .* resume=True continues it", scenario.map, out)
    with pytest.raises(ValueError, match="map: got resume=True and restart=True"):
        scenario.map(out, resume=True, restart=True)
    reported = []
    assert scenario.map(out, resume=True, progress=lambda k, of: reported.append(k)) == whole
    assert reported[0] == 8 and out.exists() and not (tmp_path / "map.csv.checkpoint").exists()


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_a_map_goes_on_behind_the_rows_of_its_file(tmp_path, extension):
    scenario = Scenario.from_text(MAP + 'kind = "andoyer-section"\nperiod = 0.05\n')
    whole = scenario.map(tmp_path / f"whole.{extension}")
    out = tmp_path / f"map.{extension}"

    class Enough(Exception):
        pass

    def stop(k, of):
        if k == 9:
            raise Enough

    with pytest.raises(Enough):
        scenario.map(out, progress=stop)
    part = out.with_name(out.name + ".part")
    assert part.stat().st_size > 65536 * 8  # a block of rows is there, others wait for theirs
    again = scenario.map(out, resume=True)
    assert again == whole and again.failures == whole.failures
    assert_array_equal(again.cell, whole.cell)
    assert len(again.cell) == len(again["t"]) > 20000
    if extension == "csv":
        assert out.read_bytes() == (tmp_path / "whole.csv").read_bytes()
    again = scenario.map(out, resume=True)  # complete: begins anew
    assert again == whole


def test_a_complete_run_is_no_complete_map(tmp_path):
    scenario = Scenario.from_text(SECTION)
    for name in ("a.csv", "a.h5"):
        path = tmp_path / name
        scenario.run(path)
        with pytest.raises(ValueError, match="of another run or map of this scenario"):
            scenario.map(path, resume=True)
        scenario.map(path, restart=True)
        with pytest.raises(ValueError, match="of another run or map of this scenario"):
            scenario.run(path, resume=True)


def test_ctrl_c_ends_a_map(tmp_path):
    long = Scenario.from_text(CHAOS.replace("stop = 100", "stop = 1e6"))
    assert seconds_from_signal(lambda: long.map(threads=2)) < LATEST


def test_what_is_no_map(tmp_path):
    with pytest.raises(ScenarioError, match=r"expected a table \[map\]"):
        Scenario.from_text(MAP.partition("[[map.axis]]")[0]).map()
    scenario = Scenario.from_text(CHAOS)
    for arguments, text in (({"threads": 0}, "threads: got 0"), ({"resume": True}, "with outputs"),
                            ({"outputs": "-"}, 'map: got "-"'),
                            ({"outputs": tmp_path / "map.txt"}, "map.txt")):
        rejected(ValueError, text, scenario.map, **arguments)
