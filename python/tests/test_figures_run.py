# SPDX-License-Identifier: MIT
"""The body in its attitude, and a run at a glance: shapes, units, and every source of a run."""

import types

import budgets
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import figures
from polhode.figures.attitude import BEYOND, THINNEST, BoxPicture, half_sizes
from polhode.figures.run_data import run_data
from polhode.figures.view import View
from rejections import rejected

BODY = polhode.Body(0.61, 0.965, 1.0)
STATE = polhode.RotorState([0.9, 0.1, -0.3, 0.2], [0.3, 0.1, 0.8])
MOTION = polhode.FreeRotation(BODY, STATE)
TIMES = np.linspace(0.0, 40.0, 401)
RUN = figures.RunData(TIMES, MOTION.at(TIMES), BODY, {"t": "h", "w1": "deg/h"}, "A tumbler")
SCENARIO = """\
schema = 1
title = "A tumbler"
[units]
time = "h"
angle = "deg"
moment = "kg km2"
[body]
moments = [0.61, 0.965, 1.0]
[state.attitude-rate]
quaternion = [0.9, 0.1, -0.3, 0.2]
omega_body = [10.0, 3.0, 30.0]
[time]
stop = 20
step = 0.5
[output]
columns = ["q", "omega", "euler"]
"""


def test_half_sizes_give_the_moments_back():
    a = half_sizes(BODY)
    moments = np.array([a[1] ** 2 + a[2] ** 2, a[2] ** 2 + a[0] ** 2, a[0] ** 2 + a[1] ** 2])
    assert_allclose(moments / moments[2], BODY.moments, rtol=budgets.round_trip_floor)
    assert a.max() == 1.0
    assert half_sizes(polhode.Body(1.0, 2.0, 3.0))[2] == THINNEST


def test_the_picture_of_a_body_follows_its_state():
    ax = plt.figure().add_subplot()
    view = View(20.0, 30.0)
    picture = figures.BodyPicture(ax, BODY, view=view)
    for t in (0.0, 3.0):
        state = MOTION.at(t)
        picture.show(state)
        rows = polhode.charts.attitude_matrix(state.q)
        for k, pointer in enumerate(picture.axes):
            assert_allclose(pointer.head.xy, view.paper((half_sizes(BODY)[k] + BEYOND) * rows[k]))
        G = polhode.charts.inertial_momentum(state)
        tip = np.array(picture.momentum.head.xy)
        assert_allclose(
            tip / np.linalg.norm(tip), unit(view.paper(G)), atol=budgets.round_trip_floor
        )
        omega = polhode.charts.inertial_angular_velocity(BODY, state)
        spin = np.array(picture.spin.head.xy)
        assert_allclose(unit(spin), unit(view.paper(omega)), atol=budgets.round_trip_floor)
        edge = picture.solid.border.get_xy()
        for axis, sight in enumerate((view.right, view.up)):
            reach = np.linalg.norm(half_sizes(BODY) * (rows @ sight))
            assert_allclose(edge[:, axis].max(), reach, rtol=budgets.figure_sampled)


def unit(v):
    return np.asarray(v) / np.linalg.norm(v)


def test_vectors_that_are_not_there_are_not_drawn():
    ax = plt.figure().add_subplot()
    picture = figures.BodyPicture(ax, BODY)
    picture.show(polhode.RotorState([1, 0, 0, 0], [0, 0, 0]))
    assert not picture.momentum.near.get_visible() and not picture.spin.label.get_visible()
    picture.show(STATE)
    assert picture.momentum.near.get_visible()
    bare = figures.BodyPicture(ax, BODY, vectors=False)
    bare.show(STATE)
    assert not bare.momentum.head.get_visible()
    with pytest.raises(ValueError, match=r"got states of shape \(401,\); expected one state"):
        picture.show(RUN.states)
    with pytest.raises(ValueError, match="got shape = 'ball'; expected one of ellipsoid, box"):
        figures.attitude_of_body(STATE, BODY, "ball")


def test_a_box_shows_its_near_faces_and_hides_what_is_behind():
    ax = plt.figure().add_subplot()
    view = View(20.0, 30.0)
    sizes = half_sizes(BODY)
    box = BoxPicture(ax, view, sizes)
    rows = polhode.charts.attitude_matrix([0.8, 0.3, -0.4, 0.2])
    box.move(rows)
    shown = {key for key, face in box.faces.items() if face.get_facecolor()[3] > 0.0}
    assert shown == {
        (k, s) for k in range(3) for s in (1.0, -1.0) if s * rows[k] @ view.toward > 0.0
    }
    assert len(shown) == 3
    points = np.random.default_rng(2).uniform(-1.5, 1.5, size=(300, 3))
    ray = points[:, None, :] + np.linspace(1e-6, 8.0, 4000)[None, :, None] * view.toward
    reached = np.any(np.all(np.abs(ray @ rows.T) < sizes, axis=-1), axis=1)
    assert np.mean(box.hides(rows, points) == reached) > 0.99
    figures.attitude_of_body(STATE, BODY, "box")


def test_the_overview_shows_angles_and_rates_with_units():
    sphere, angles, rates = figures.overview(RUN)
    lines = {line.get_gid(): line.get_xydata() for line in rates.lines}
    omega = np.degrees(polhode.angular_velocity(BODY, RUN.states))
    for k in range(3):
        assert_allclose(lines[f"w{k + 1}"], np.stack([TIMES, omega[:, k]], axis=-1))
    euler = polhode.to_euler(RUN.states)
    drawn = next(line.get_ydata() for line in angles.lines if line.get_gid() == "theta")
    assert_allclose(drawn, np.degrees(euler.theta))
    assert rates.get_ylabel() == "Angular velocity (deg/h)"
    assert angles.get_ylabel() == "Euler angles (deg)"
    assert rates.get_xlabel() == "Time (h)"
    assert sphere.get_title() == "A tumbler"
    trace = [line for line in sphere.lines if line.get_gid() in ("trace-near", "trace-far")]
    assert len(trace) == 2


def long_run(stop, rows):
    t = np.linspace(0.0, stop, rows)
    return figures.RunData(t, MOTION.at(t), BODY, {"t": "h"})


def vertices(panel, gid):
    """Times and values of the outline of a band."""
    (found,) = [c for c in panel.collections if c.get_gid() == gid]
    return np.concatenate([path.vertices for path in found.get_paths()])


def test_a_long_run_is_shown_by_bands_within_which_it_stays():
    data = long_run(20000.0, 200001)
    _, angles, rates = figures.overview(data)
    assert rates.get_xlim() == (0.0, 20000.0)
    assert rates.get_xlabel() == "Time (h)"
    euler = polhode.to_euler(data.states)
    omega = polhode.angular_velocity(BODY, data.states)
    curves = [(angles, "theta", np.degrees(euler.theta))]
    curves += [(rates, f"w{k + 1}", omega[:, k]) for k in range(3)]
    for panel, name, values in curves:
        outline = vertices(panel, f"{name}-band")
        assert_allclose(np.ptp(outline[:, 1]), np.ptp(values), rtol=budgets.round_trip_floor)
        mean = next(line for line in panel.lines if line.get_gid() == name)
        # the mean over whole periods of the wobble is that of the run
        t, y = mean.get_xydata()[2:-2].T
        assert len(t) < 100
        assert_allclose(y, np.mean(values), atol=budgets.figure_mean * np.ptp(values))
    labels = [text.get_text() for text in angles.get_legend().get_texts()]
    assert labels == [r"$\phi$ goes round", r"$\theta$", r"$\psi$"]  # psi swings about 90 deg
    assert angles.get_legend().get_title().get_text().startswith("bands: least to")
    assert rates.get_legend().get_title().get_text() == ""


def test_a_span_of_a_long_run_shows_its_turns_and_says_so():
    _, angles, rates = figures.overview(long_run(1000.0, 20001), span=30.0)
    assert angles.get_xlim() == rates.get_xlim() == (0.0, 30.0)
    assert rates.get_xlabel() == "Time (h): the first 30 of 1000"
    assert not rates.collections and len(rates.lines) == 3
    assert rates.lines[0].get_xdata()[-1] >= 30.0
    assert figures.overview(long_run(20.0, 401))[2].get_xlabel() == "Time (h)"


def test_a_span_of_a_run_back_in_time_counts_from_its_start():
    t = np.linspace(0.0, -1000.0, 20001)
    data = figures.RunData(t, MOTION.at(t), BODY, {"t": "h"})
    _, angles, rates = figures.overview(data, span=30.0)
    assert rates.get_xlim() == (0.0, -30.0)
    assert rates.get_xlabel() == "Time (h): the first 30 of 1000"
    assert rates.lines[0].get_xdata()[-1] <= -30.0
    assert len(rates.lines[0].get_xdata()) > 500


def test_rows_far_apart_are_points():
    sphere, angles, rates = figures.overview(long_run(1000.0, 101))
    for line in [*angles.lines, *rates.lines]:
        assert (line.get_linestyle(), len(line.get_xdata())) == ("None", 101)
        assert line.get_marker() != "None"
    trace = next(line for line in sphere.lines if line.get_gid() == "trace-near")
    assert (trace.get_linestyle(), trace.get_marker()) == ("None", ".")


def test_a_spin_that_hardly_wobbles_has_a_ring():
    spin = polhode.FreeRotation(BODY, polhode.RotorState([1, 0, 0, 0], [0.001, 0.0, 1.0]))
    data = figures.RunData(TIMES, spin.at(TIMES), BODY)
    sphere = figures.overview(data)[0]
    trace = next(line for line in sphere.lines if line.get_gid() == "trace-near")
    assert (trace.get_marker(), trace.get_markerfacecolor()) == ("o", "none")
    one = figures.RunData([0.0], spin.at([0.0]), BODY)
    assert figures.overview(one).shape == (3,)


def test_units_that_are_not_known_are_not_shown():
    bare = figures.RunData(TIMES, RUN.states, BODY)
    _, _, rates = figures.overview(bare)
    assert (rates.get_ylabel(), rates.get_xlabel()) == ("Angular velocity", "Time")
    turning = figures.RunData(TIMES, RUN.states, BODY, {"w1": "rev/d"})
    rates = figures.overview(turning)[2]
    assert rates.get_ylabel() == "Angular velocity (rev/d)"
    omega = polhode.angular_velocity(BODY, RUN.states[0])
    assert_allclose([line.get_ydata()[0] for line in rates.lines], omega / (2.0 * np.pi))
    timed = figures.RunData(TIMES, RUN.states, BODY, {"t": "d"})
    assert figures.overview(timed)[2].get_ylabel() == "Angular velocity (rad/d)"


def test_the_overview_of_a_run_without_momentum_is_refused():
    still = polhode.RotorState([1, 0, 0, 0], np.zeros((2, 3)))
    with pytest.raises(ValueError, match="starts without angular momentum"):
        figures.overview(figures.RunData([0.0, 1.0], still, BODY))


class Table(dict):
    """What Results look like: columns, times, units."""

    def __init__(self, columns, units=None, body=BODY):
        super().__init__(columns)
        self.t, self.units, self.body = columns["t"], units or {}, body


def columns(*groups):
    found = {"t": TIMES}
    if "q" in groups:
        found |= dict(zip(("qw", "qx", "qy", "qz"), RUN.states.q.T))
    if "g" in groups:
        found |= dict(zip(("g1", "g2", "g3"), RUN.states.g.T))
    if "omega" in groups:
        omega = np.degrees(polhode.angular_velocity(BODY, RUN.states))
        found |= dict(zip(("w1", "w2", "w3"), omega.T))
    return found


@pytest.mark.parametrize("groups", [("q", "g"), ("q", "omega"), ("q", "g", "omega")])
def test_a_run_is_read_from_columns(groups):
    data = run_data(Table(columns(*groups), {"w1": "deg/h", "t": "h"}))
    assert_allclose(data.states.g, RUN.states.g, rtol=budgets.round_trip_floor)
    assert_allclose(data.states.q, RUN.states.q, rtol=budgets.round_trip_floor)
    assert data.time_unit == "h"


def test_the_rates_of_a_run_are_its_own_columns():
    table = columns("q", "g", "omega")
    table["w2"] = table["w2"] + 5.0  # as a frame or a perturbation adds to the rate
    rates = figures.overview(Table(table, {"w1": "deg/h", "t": "h"}))[2]
    for k in (1, 2, 3):
        drawn = next(line.get_ydata() for line in rates.lines if line.get_gid() == f"w{k}")
        assert_allclose(drawn, table[f"w{k}"])
    assert rates.get_ylabel() == "Angular velocity (deg/h)"


def test_a_run_is_read_from_states():
    source = types.SimpleNamespace(t=TIMES, states=RUN.states)
    assert run_data(source, BODY).states == RUN.states
    assert run_data(RUN) is RUN
    rejected(TypeError, "got SimpleNamespace without a body; expected body=Body", run_data, source)


def test_columns_that_do_not_suffice_are_named():
    rejected(ValueError, "got the columns t, w1, w2, w3; expected the groups q and g", run_data,
             Table(columns("omega")))
    with pytest.raises(ValueError, match="got w1 in turn/h; expected an angle per time"):
        run_data(Table(columns("q", "omega"), {"w1": "turn/h"}))
    with pytest.raises(ValueError, match=r"got times of shape \(2,\) and states of shape \(401,\)"):
        figures.RunData([0.0, 1.0], RUN.states, BODY)


@pytest.fixture(scope="module")
def results():
    return polhode.Scenario.from_text(SCENARIO).run()


def test_a_run_is_read_from_results_and_from_its_file(results, tmp_path):
    path = tmp_path / "run.csv"
    results.write(path)
    body = results.scenario.body
    for data in (run_data(results), run_data(path), run_data(str(path), body)):
        assert_allclose(data.body.moments, body.moments)
        assert (data.title, data.time_unit, data.units["w3"]) == ("A tumbler", "h", "deg/h")
        assert_allclose(data.states.q, results.groups["q"], rtol=budgets.round_trip_floor)
        assert_allclose(np.degrees(data.states.g / body.moments), results.groups["omega"],
                        rtol=budgets.round_trip_floor, atol=budgets.round_trip_floor)
    _, angles, rates = figures.overview(path)
    drawn = {line.get_gid(): line.get_ydata() for line in [*angles.lines, *rates.lines]}
    assert_allclose(drawn["theta"], results["theta"], rtol=budgets.round_trip_floor)
    for k in (1, 2, 3):
        assert_allclose(drawn[f"w{k}"], results[f"w{k}"])


@pytest.mark.parametrize("groups", [["q", "g", "omega"], ["q", "omega"]])
def test_a_file_along_the_axes_of_a_tensor_is_drawn_along_principal_axes(tmp_path, groups):
    tensor = "tensor = [[1.9, 0, 0.2], [0, 1, 0], [0.2, 0, 2.3]]"
    text = SCENARIO.replace("moments = [0.61, 0.965, 1.0]", tensor)
    scenario = polhode.Scenario.from_text(text).with_columns(groups)
    results = scenario.run([tmp_path / "run.csv"])
    exact = scenario.free_rotation.at(results.t)
    omega = np.degrees(polhode.angular_velocity(scenario.body, exact))
    for data in (run_data(tmp_path / "run.csv"), run_data(results) if "g" in groups else None):
        if data is None:
            continue
        turns = np.abs(np.sum(data.states.q * exact.q, axis=-1))
        assert_allclose(turns, 1.0, atol=budgets.io_state)
        assert_allclose(data.states.g, exact.g, atol=budgets.io_state)
        assert_allclose(data.omega, omega, rtol=budgets.io_state, atol=budgets.io_state)


def test_a_file_without_rows_is_refused(tmp_path):
    empty = tmp_path / "empty.csv"
    empty.write_text("# polhode 0\nt,qw\n", encoding="utf-8")
    rejected(ValueError, "without rows; expected what polhode run wrote", run_data, empty, BODY)


@pytest.mark.parametrize("shape", ["ellipsoid", "box"])
@pytest.mark.parametrize("body", [BODY, polhode.Body(1, 1, 1)], ids=["Apophis", "cube"])
def test_the_body_stays_in_the_picture(body, shape):
    rng = np.random.default_rng(4)
    ax = plt.figure().add_subplot()
    picture = figures.BodyPicture(ax, body, shape)
    for q in rng.normal(size=(20, 4)):
        picture.show(polhode.RotorState(q, [0.3, 0.1, 0.8]))
        drawn = [patch.get_xy() for patch in ax.patches]
        drawn += [np.array(text.get_position())[None, :] for text in ax.texts if text.get_text()]
        assert np.abs(np.concatenate(drawn)).max() < ax.get_xlim()[1]
