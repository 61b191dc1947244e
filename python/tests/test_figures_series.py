# SPDX-License-Identifier: MIT
"""Columns against time: names, units, panels, and wrapped angles without vertical lines."""

import budgets
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas
import pytest
from closeness import assert_allclose
from matplotlib.axes import Axes
from matplotlib.mathtext import MathTextParser
from numpy.testing import assert_array_equal
from polhode import Body, FreeRotation, Problem, Scenario, System, figures, integrate, rotor_state
from polhode.figures.columns import angle_axis, axis_label, symbol, table
from polhode.figures.time_series import unbroken
from rejections import rejected

BODY = Body(3.0, 4.0, 6.0)
MOTION = FreeRotation(BODY, rotor_state(BODY, [0.9, 0.2, 0.1, 0.3], [0.5, 0.02, 1.0]))
T = np.linspace(0.0, 30.0, 301)
NUT = """
schema = 1
units = { time = "s", angle = "deg", moment = "g cm2" }
body.moments = [30.53, 83.87, 113.3]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.6, 360, 0] }
time = { stop = 4, step = 0.02 }
output.columns = ["omega", "andoyer"]
"""


def columns():
    omega = MOTION.at(T).g / BODY.moments
    return {"t": T, "w1": omega[:, 0], "w2": omega[:, 1], "l": np.arctan2(np.sin(T), np.cos(T))}


def test_one_name_is_one_panel_with_the_very_numbers():
    data = columns()
    ax = figures.time_series(data, "w1")
    assert isinstance(ax, Axes)
    assert_array_equal(ax.get_lines()[0].get_xydata(), np.stack([T, data["w1"]], axis=-1))
    assert ax.get_ylabel() == r"$\omega_1$" and ax.get_xlabel() == "$t$"
    assert ax.get_legend() is None


def test_a_list_is_panels_with_one_time_axis():
    axes = figures.time_series(
        columns(), ["l", ("w1", "w2")], units={"t": "h", "w1": "rad/h", "w2": "rad/h"}
    )
    assert axes.shape == (2,) and axes[0].get_shared_x_axes().joined(*axes)
    assert axes[0].get_xlabel() == "" and axes[1].get_xlabel() == "$t$ (h)"
    assert axes[0].get_ylabel() == "$l$ (rad)"
    assert axes[1].get_ylabel() == r"$\omega_1$, $\omega_2$ (rad/h)"
    assert [text.get_text() for text in axes[1].get_legend().get_texts()] == [
        r"$\omega_1$",
        r"$\omega_2$",
    ]


def test_looks_differ_within_a_panel_and_between_runs():
    ax = figures.time_series(columns(), "w1", label="one")
    assert figures.time_series(columns(), "w1", ax, label="two") is ax
    first, second = ax.get_lines()
    assert (first.get_color(), first.get_linestyle()) != (
        second.get_color(),
        second.get_linestyle(),
    )
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["one", "two"]


def test_axes_of_the_user_are_used_and_settings_left_alone():
    before = dict(matplotlib.rcParams)
    _, axes = plt.subplots(2, 1)
    drawn = figures.time_series(columns(), ["w1", "w2"], axes)
    assert list(drawn) == list(axes) and dict(matplotlib.rcParams) == before
    with pytest.raises(ValueError, match="got 1 Axes; expected 2"):
        figures.time_series(columns(), ["w1", "w2"], axes[0])


def test_results_bring_their_units():
    results = Scenario.from_text(NUT).run()
    axes = figures.time_series(results, ["g", "L", "w1"])
    labels = [ax.get_ylabel() for ax in axes]
    assert labels == ["$g$ (deg)", "$L$ (g cm$^{2}$/s)", r"$\omega_1$ (deg/s)"]
    assert axes[-1].get_xlabel() == "$t$ (s)"
    assert_array_equal(axes[1].get_lines()[0].get_ydata(), results["L"])
    assert axes[0].get_ylim() == (-180.0, 180.0)


def test_a_trajectory_computes_its_columns():
    system = System(BODY)
    run = integrate(Problem(system, MOTION.initial_state, 0.0, 30.0), T)
    axes = figures.time_series(run, ["g1", "l", "E"], system=system)
    assert_array_equal(axes[0].get_lines()[0].get_ydata(), run.g[:, 0])
    assert axes[1].get_ylabel() == "$l$ (rad)" and axes[2].get_ylabel() == "$E$"
    assert_allclose(axes[2].get_lines()[0].get_ydata(), MOTION.energy)
    rejected(ValueError, '"l" needs system=', figures.time_series, run, "l")


def test_a_data_frame_brings_its_units():
    frame = pandas.DataFrame(columns())
    frame.attrs["units"] = {"t": "d", "w1": "deg/d"}
    ax = figures.time_series(frame, "w1")
    assert ax.get_ylabel() == r"$\omega_1$ (deg/d)" and ax.get_xlabel() == "$t$ (d)"


@pytest.mark.parametrize(
    ("unit", "turn"), [("rad", 2 * np.pi), ("deg", 360.0), ("rev", 1.0), ("arcmin", 21600.0)]
)
def test_angles_are_cut_in_every_unit(unit, turn):
    wrapped = (0.1 * T % 1.0 - 0.5) * turn
    (line,) = figures.time_series({"t": T, "l": wrapped}, "l", units={"l": unit}).get_lines()
    assert np.isnan(line.get_ydata()).sum() == np.sum(np.abs(np.diff(wrapped)) > turn / 2) > 0
    assert_allclose(np.nanmax(line.get_ydata()), turn / 2)  # NaN: the gaps counted


def test_tables_of_results_bring_their_units():
    results = Scenario.from_text(NUT).run()
    for source in (results.to_pandas(), results.to_xarray()):
        axes = figures.time_series(source, ["g", "w1"])
        assert [ax.get_ylabel() for ax in axes] == ["$g$ (deg)", r"$\omega_1$ (deg/s)"]
        assert axes[1].get_xlabel() == "$t$ (s)"
        assert_array_equal(axes[1].get_lines()[0].get_xydata().T, [results.t, results["w1"]])


@pytest.mark.parametrize(("names", "message"), [
    ("w9", 'no column "w9"; there are: t, w1, w2, l'),
    ([("l", "w1")], r"l \(rad\), w1 \(\) share a panel; expected one unit"),
    ([], "got no columns; expected at least one"),
])
def test_what_cannot_be_drawn(names, message):
    rejected(ValueError, message, figures.time_series, columns(), names)


def test_a_column_has_one_number_for_each_time():
    with pytest.raises(ValueError, match=r'"q" has shape \(301, 4\); expected .* shape \(301,\)'):
        table({"t": T, "q": np.zeros((301, 4))}, ["q"])


@pytest.mark.parametrize("turn", [2 * np.pi, 360.0])
@pytest.mark.parametrize("low", [-0.5, 0.0])
@pytest.mark.parametrize("rate", [0.11, -0.11])
def test_a_wrapped_angle_goes_over_the_edge(turn, low, rate):
    """Between samples of an angle that grows evenly, the line drawn is the angle itself."""
    t = np.arange(60.0)
    wrapped = ((rate * t + 0.07 - low) % 1.0 + low) * turn
    drawn_t, drawn = unbroken(t, wrapped, turn)
    gaps = np.isnan(drawn)
    assert gaps.sum() == np.sum(np.abs(np.diff(wrapped)) > turn / 2) > 3
    step = np.abs(np.diff(drawn))
    assert np.nanmax(step) < 0.12 * turn  # no vertical line; NaN: the gaps counted
    inside = (drawn / turn - rate * drawn_t - 0.07)[~gaps]
    assert_allclose(inside - np.round(inside), 0.0, atol=budgets.figure_orbit)
    edges = drawn[:-1][gaps[1:]], drawn[1:][gaps[:-1]]
    high = (low + 1.0) * turn
    assert_allclose(
        edges, [[high] * gaps.sum(), [low * turn] * gaps.sum()][:: 1 if rate > 0 else -1]
    )


def test_what_is_not_wrapped_stays_whole():
    grows = np.linspace(0.0, 50.0, 9)  # unwrapped: more than half a turn from row to row
    for values, turn in ((grows, 2 * np.pi), (np.sign(np.sin(grows)) * 3, None),
                         (grows * np.nan, 360.0)):
        assert unbroken(grows, values, turn)[1] is values
    ax = figures.time_series({"t": T, "theta": 0.3 + 0.1 * np.sin(T)}, "theta")
    assert ax.get_ylim()[1] < 0.5  # its own range, no multiples of pi


def panel_of(t, values, unit=""):
    return figures.time_series({"t": t, "x": values}, "x", units={"x": unit})


def outlines(ax):
    """The parts of the bands of a panel: times and values of their vertices."""
    return [path.vertices for c in ax.collections for path in c.get_paths()]


def test_a_dense_curve_is_a_band_between_its_envelopes():
    """Of (1 + t) cos: the envelopes and the mean are known."""
    t = np.linspace(0.0, 1.0, 40001)
    ax = panel_of(t, 5.0 * t + (1.0 + t) * np.cos(2 * np.pi * 900 * t))
    (outline,) = outlines(ax)
    for time, low, high in ((0.0, -1.0, 1.0), (0.5, 1.0, 4.0), (1.0, 3.0, 7.0)):
        near = outline[np.abs(outline[:, 0] - time) < 0.006, 1]
        assert_allclose([near.min(), near.max()], [low, high], atol=budgets.figure_bin * 8.0)
    (mean,) = ax.get_lines()
    time, value = mean.get_xydata()[1:-1].T
    assert_allclose(value, 5.0 * time, atol=budgets.figure_mean * 4.0)


@pytest.mark.parametrize("swings, is_band", [(20, False), (60, False), (400, True)])
def test_the_picture_decides_what_is_dense(swings, is_band):
    t = np.linspace(0.0, 1.0, 40001)
    ax = panel_of(t, np.cos(2 * np.pi * swings * t))
    assert len(outlines(ax)) == is_band
    assert len(ax.get_lines()[0].get_xdata()) == (t.size if not is_band else outlines_bins(ax))
    wide = plt.figure(figsize=(80, 2)).add_subplot()
    figures.time_series({"t": t, "x": np.cos(2 * np.pi * swings * t)}, "x", ax=wide)
    assert not wide.collections


def outlines_bins(ax):
    """How many bins the outline of one band has: its corners, both sides."""
    return (len(outlines(ax)[0]) - 3) // 2


def test_what_is_not_dense_stays_a_line():
    t = np.linspace(0.0, 1.0, 40001)
    rng = np.random.default_rng(3)
    for values in (3.0 + 1e-15 * rng.normal(size=t.size), t * 0.0, t * np.nan, np.exp(9.0 * t)):
        ax = panel_of(t, values)
        assert not ax.collections and len(ax.get_lines()[0].get_xdata()) == t.size


def test_a_dense_curve_with_gaps_has_a_band_where_it_has_values():
    t = np.linspace(0.0, 1.0, 40001)
    ax = panel_of(t, np.where((t > 0.4) & (t < 0.6), np.nan, np.cos(2 * np.pi * 900 * t)))
    first, second = outlines(ax)
    assert first[:, 0].max() < 0.42 and second[:, 0].min() > 0.58


def test_a_run_back_in_time_has_its_band():
    t = np.linspace(0.0, -1.0, 40001)
    (outline,) = outlines(panel_of(t, np.cos(2 * np.pi * 900 * t)))
    assert_allclose([outline[:, 0].min(), outline[:, 0].max()], [-1.0, 0.0])


def test_bands_of_wrapped_angles_reach_over_the_edge():
    """A libration of 40 degrees about 170: below the upper edge, and above the lower one."""
    t = np.linspace(0.0, 1.0, 40001)
    angle = 170.0 + 40.0 * np.cos(2 * np.pi * 900 * t)
    ax = panel_of(t, (angle + 180.0) % 360.0 - 180.0, "deg")
    ranges = sorted((o[:, 1].min(), o[:, 1].max()) for o in outlines(ax))
    assert_allclose(ranges, [(-180.0, -150.0), (130.0, 180.0)], atol=budgets.figure_mean * 80.0)
    mean = ax.get_lines()[0].get_ydata()
    assert_allclose(mean[np.isfinite(mean)], 170.0, atol=budgets.figure_mean * 80.0)


def test_bands_of_angles_from_zero_to_a_turn_stay_there():
    t = np.linspace(0.0, 1.0, 40001)
    ax = panel_of(t, (20.0 * np.cos(2 * np.pi * 900 * t)) % 360.0, "deg")
    ranges = sorted((o[:, 1].min(), o[:, 1].max()) for o in outlines(ax))
    assert_allclose(ranges, [(0.0, 20.0), (340.0, 360.0)], atol=budgets.figure_mean * 80.0)


@pytest.mark.parametrize("turns", [900.3, 39000.7, 123456.7])
def test_an_angle_that_goes_round_says_so(turns):
    t = np.linspace(0.0, 1.0, 40001)
    ax = panel_of(t, (360.0 * turns * t + 180.0) % 360.0 - 180.0, "deg")
    assert not ax.get_lines()
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["$x$ goes round"]
    slow = panel_of(t, (360.0 * 40.3 * t + 180.0) % 360.0 - 180.0, "deg")
    assert len(slow.get_lines()) == 1 and not slow.collections


def test_bands_take_the_next_look():
    t = np.linspace(0.0, 1.0, 40001)
    fast = np.cos(2 * np.pi * 900 * t)
    ax = panel_of(t, fast)
    figures.time_series({"t": t, "x": 2.0 * fast}, "x", ax=ax)
    figures.time_series({"t": t, "x": t}, "x", ax=ax)
    assert len({line.get_color() for line in ax.get_lines()}) == 3


def test_names_are_set_as_in_print():
    assert symbol("theta_osc") == r"$\theta_{{\rm osc}}$" and symbol("l_osc") == r"$l_{{\rm osc}}$"
    assert symbol("I_f_rel") == r"$I_{f, {\rm rel}}$" and symbol("qw") == "$q_w$"
    assert symbol("Theta") == r"$\Theta$" and symbol("temperature") == "temperature"
    assert symbol("w1_rel") == r"$\omega_1^{\rm rel}$" and symbol("body_rate") == "body_rate"
    assert (
        axis_label(["L"], "1") == "$L$"
        and axis_label(["E"], "kg m2/s2") == "$E$ (kg m$^{2}$/s$^{2}$)"
    )


def test_every_label_can_be_set():
    text = NUT.replace('"omega", "andoyer"', '"axes", "euler_osc", "energy", "sadov", "omega_rel"')
    results = Scenario.from_text(text).run()
    parser = MathTextParser("agg")
    for name in results:
        parser.parse(axis_label([name], results.units[name]))  # raises where it is no mathtext


def test_angle_axes_have_quarters_of_a_turn():
    ax = plt.figure().add_subplot()
    ax.set_xlim(-np.pi, np.pi)
    ax.set_ylim(0.0, 200.0)
    angle_axis(ax.xaxis)
    angle_axis(ax.yaxis, "deg")
    ax.figure.canvas.draw()
    inside = np.abs(ax.get_xticks()) < 3.2
    said = [label.get_text() for label, seen in zip(ax.get_xticklabels(), inside) if seen]
    assert said == [r"$-\pi$", r"$-\pi/2$", "0", r"$\pi/2$", r"$\pi$"]
    assert_allclose(ax.get_yticks()[:3] % 90.0, 0.0)
