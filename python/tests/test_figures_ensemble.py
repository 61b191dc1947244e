# SPDX-License-Identifier: MIT
"""Figures of ensembles: what is drawn is what the columns say."""

import sys

import budgets
import matplotlib
from closeness import assert_allclose

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import polhode
import pytest
from numpy.testing import assert_array_equal
from polhode import figures, vary
from rejections import rejected

SPIN, MOMENT = "state.attitude-rate.omega_body[2]", "body.moments[0]"
SCENARIO = polhode.Scenario.from_text("""
schema = 1
units = { time = "h", angle = "deg" }
body.moments = [1, 2, 2.5]
state.attitude-rate = { quaternion = [0.5, 0.5, 0.5, 0.5], omega_body = [20, 40, 18] }
time = { stop = 10, count = 21 }
output.columns = ["q_inertial", "pole", "axis3", "tumbler", "omega_inertial", "energy"]
""")
BOTH = {SPIN: vary.normal(sigma=5.0), MOMENT: vary.uniform(0.7, 1.3)}
QUANTILES = [0.05, 0.25, 0.4, 0.5, 0.75, 0.95]


@pytest.fixture(scope="module")
def statistics():
    return SCENARIO.ensemble(vary=BOTH, size=60, quantiles=QUANTILES)


@pytest.fixture(scope="module")
def final():
    return SCENARIO.ensemble(vary=BOTH, size=60, keep="final")


def edges(band):
    """Lower and upper edge of a filled area, in the order of its times."""
    (path,) = band.get_paths()
    rows = path.vertices[:-1]
    half = len(rows) // 2
    return rows[1:half, 1], rows[half + 1 :, 1][::-1]


def named(artists):
    return {artist.get_gid(): artist for artist in artists}


def test_a_fan_has_its_quantiles(statistics, tmp_path):
    path = tmp_path / "e.h5"
    statistics.scenario.ensemble(path, vary=None)
    for source in (statistics, path, dict(statistics)):
        ax = figures.quantile_fan(source, "P_phi")
        bands = named(ax.collections)
        assert list(bands) == ["P_phi-0.05", "P_phi-0.25"]
        low, high = edges(bands["P_phi-0.05"])
        assert_array_equal(low, statistics["P_phi_p5"])
        assert_array_equal(high, statistics["P_phi_p95"])
        assert_array_equal(edges(bands["P_phi-0.25"])[1], statistics["P_phi_p75"])
        lines = {line.get_label(): line for line in ax.get_lines()}
        assert list(lines) == ["40 %", "median"]
        assert_array_equal(lines["median"].get_ydata(), statistics["P_phi_p50"])
        assert_array_equal(lines["40 %"].get_xdata(), statistics["t"])
        said = [text.get_text() for text in ax.get_legend().get_texts()]
        assert said == ["5 to 95 %", "25 to 75 %", "40 %", "median"]
    inner, outer = (bands[f"P_phi-{p}"].get_facecolor()[0] for p in (0.25, 0.05))
    assert inner.mean() < outer.mean()  # darker
    ax = figures.quantile_fan(statistics, "P_phi")
    assert ax.get_ylabel() == r"$P_{\phi}$ (h)" and ax.get_xlabel() == "$t$ (h)"


def test_two_fans_on_the_same_axes(statistics):
    ax = figures.quantile_fan(statistics, "P_phi", label="one")
    assert figures.quantile_fan(statistics, "P_short", ax, label="other") is ax
    medians = [line for line in ax.get_lines() if str(line.get_gid()).endswith("-median")]
    assert medians[0].get_color() != medians[1].get_color()
    assert "other, median" in [text.get_text() for text in ax.get_legend().get_texts()]


def test_a_fan_that_is_not_there_is_refused(statistics, final):
    with pytest.raises(ValueError, match='quantile_fan: no quantiles of "P".* there are: pole_lon'):
        figures.quantile_fan(statistics, "P")
    with pytest.raises(ValueError, match='takes results of keep="statistics", and these are of'):
        figures.quantile_fan(final, "P_phi")
    with pytest.raises(ValueError, match='takes results of keep="statistics", and these are of'):
        figures.regime_fractions(final)
    rejected(ValueError, "there are: none", figures.quantile_fan, final, "P_phi")
    rejected(TypeError, "got 3; expected EnsembleResults", figures.quantile_fan, 3, "P_phi")


def test_regimes_stand_one_above_the_other(statistics):
    t = np.array([0.0, 1.0, 2.0])
    parts = {
        "mode_SAM": [0.0, 0.5, 0.75], "mode_LAM": [1.0, 0.25, 0.25], "mode_other": [0, 0.25, 0],
    }  # fmt: skip
    ax = figures.regime_fractions({"t": t, **parts})
    layers = named(ax.collections)
    assert list(layers) == ["mode-SAM", "mode-LAM", "mode-other"]
    assert_array_equal(edges(layers["mode-SAM"])[1], parts["mode_SAM"])
    assert_array_equal(edges(layers["mode-LAM"])[0], parts["mode_SAM"])
    assert_array_equal(edges(layers["mode-other"])[0], [1.0, 0.75, 1.0])
    assert ax.get_ylim() == (0.0, 1.0)
    assert len(ax.get_lines()) == 2
    assert_array_equal(ax.get_lines()[1].get_ydata(), [1.0, 0.75, 1.0])
    said = [text.get_text() for text in ax.get_legend().get_texts()]
    assert said == ["SAM", "LAM", "others"]
    ax = figures.regime_fractions(statistics)
    assert list(named(ax.collections)) == ["mode-SAM", "mode-LAM"]
    assert_array_equal(edges(ax.collections[0])[1], statistics["mode_SAM"])
    assert 0.0 < statistics["mode_SAM"][0] < 1.0
    with pytest.raises(ValueError, match='regime_fractions: no parts of "mode" against t'):
        figures.regime_fractions({"t": t})


def test_a_corner_has_every_pair(final):
    pytest.importorskip("corner")
    names = [SPIN, MOMENT, "P_phi"]
    axes = figures.corner_plot(final, names, bins=8, plot_contours=False, plot_density=False)
    assert axes.shape == (3, 3)
    for k, name in enumerate(names):
        counts, _ = np.histogram(final[name], 8, (final[name].min(), final[name].max()))
        drawn = axes[k, k].patches[0].get_xy()[:, 1]
        assert set(counts) <= set(np.round(drawn)) and drawn.max() == counts.max()
        for j in range(k):
            points = axes[k, j].get_lines()[0].get_xydata()
            assert_array_equal(points, np.column_stack([final[names[j]], final[name]]))
    assert axes[2, 0].get_xlabel() == r"omega body[2] (deg/h)"
    assert axes[2, 0].get_ylabel() == r"$P_{\phi}$ (h)"


def test_a_corner_takes_what_differs(final):
    pytest.importorskip("corner")
    axes = figures.corner_plot({
        "a.x": [1.0, 2.0, 4.0, np.nan, 3.0], "same": [1.0, 2.0, 4.0, 5.0, 3.0], "one": np.ones(5),
        "t": np.arange(5), "E": [1.0, 0.0, 1.0, 2.0, 5.0],
    }, plot_contours=False, plot_density=False)  # fmt: skip
    assert axes.shape == (2, 2)
    assert_array_equal(axes[1, 0].get_lines()[0].get_xydata(), [[1, 1], [2, 0], [4, 1], [3, 5]])
    given = plt.figure().subplots(2, 2)
    assert figures.corner_plot(final, [SPIN, MOMENT], given)[1, 0] is given[1, 0]
    with pytest.raises(ValueError, match="one is 1 for all; expected a spread"):
        figures.corner_plot({"one": np.ones(5), "E": np.arange(5.0)}, ["one", "E"])
    with pytest.raises(ValueError, match="got 2 members; expected more than the 2 columns"):
        figures.corner_plot({"a": [1.0, 2.0], "b": [2.0, 1.0]}, ["a", "b"])
    rejected(ValueError, 'no column "z"; there are: member', figures.corner_plot, final, ["z"])
    rejected(ValueError, "got no columns that differ", figures.corner_plot, {"a": np.ones(5)})


def test_corner_is_asked_for_by_name(monkeypatch):
    monkeypatch.setitem(sys.modules, "corner", None)
    with pytest.raises(ImportError, match="^corner_plot needs corner: pip install corner$"):
        figures.corner_plot({"a": [1.0, 2.0, 3.0]})


def test_outcomes_are_points_with_a_number(final):
    ax = figures.outcomes(final, "P_phi")
    (points,) = ax.collections
    assert_array_equal(points.get_offsets(), np.column_stack([final[SPIN], final[MOMENT]]))
    assert_array_equal(points.get_array(), final["P_phi"])
    assert (points.norm.vmin, points.norm.vmax) == (final["P_phi"].min(), final["P_phi"].max())
    assert ax.figure.axes[-1].get_ylabel() == r"$P_{\phi}$ (h)"
    assert ax.get_xlabel() == "omega body[2] (deg/h)" and ax.get_ylabel() == "moments[0]"
    ax = figures.outcomes(final, "E", x="P_phi", y="P_psi", limits=(0.0, 2.0), size=3.0)
    assert ax.collections[0].norm.vmax == 2.0 and ax.collections[0].get_sizes() == [9.0]
    assert_array_equal(ax.collections[0].get_offsets()[:, 1], final["P_psi"])


def test_outcomes_by_regime_and_failures():
    columns = {
        "a.x": [0.0, 1.0, 2.0, 3.0], "a.y": [4.0, 5.0, 6.0, 7.0], "mode": [1.0, -1.0, np.nan, 1.0],
    }  # fmt: skip
    ax = figures.outcomes(columns)
    lines = named(ax.get_lines())
    assert list(lines) == ["mode-SAM", "mode-LAM", "failed"]
    assert_array_equal(lines["mode-SAM"].get_xydata(), [[0, 4], [3, 7]])
    assert_array_equal(lines["mode-LAM"].get_xydata(), [[1, 5]])
    assert_array_equal(lines["failed"].get_xydata(), [[2, 6]])
    assert lines["mode-SAM"].get_marker() != lines["mode-LAM"].get_marker()
    with pytest.raises(ValueError, match="1 column of keys that were drawn; expected two, or x"):
        figures.outcomes({"a.x": [1.0], "mode": [1.0]})
    rejected(ValueError, 'outcomes: no column "z"', figures.outcomes, columns, "z")
    with pytest.raises(ValueError, match='"slow"; when the event first happened is "slow_first"'):
        figures.outcomes({**columns, "slow_first": [1.0, 2.0, 3.0, 4.0]}, "slow")


def places(ax):
    return ax.get_lines()[0].get_xydata()


def test_the_sky_has_every_direction(final):
    ax = figures.pole_cloud(final)
    assert ax.name == "mollweide"
    expected = np.radians([final["pole_lon"] % 360 - 180, final["pole_lat"]]).T
    assert_allclose(places(ax), expected, atol=budgets.figure_directions)
    # a body axis from its columns and from the attitude; any vector by its name
    ax3 = places(figures.pole_cloud(final, "axis3"))
    q = {name: final[name] for name in ("Qw", "Qx", "Qy", "Qz")}
    assert_allclose(places(figures.pole_cloud(q, "axis3")), ax3, atol=budgets.figure_directions)
    z = final["axis3_z"]
    assert_allclose(np.sin(ax3[:, 1]), z, atol=budgets.figure_directions)
    W = np.stack([final[f"W{k}"] for k in (1, 2, 3)])
    drawn = places(figures.pole_cloud(final, "W"))
    up = W[2] / np.linalg.norm(W, axis=0)
    assert_allclose(np.sin(drawn[:, 1]), up, atol=budgets.figure_directions)
    assert_allclose(np.tan(drawn[:, 0]), W[1] / W[0], rtol=budgets.figure_directions)


def test_the_middle_of_the_sky_is_at_180_degrees():
    ax = figures.pole_cloud({"pole_ra": [0.0, np.pi, 1.5 * np.pi], "pole_dec": [0.0, 0.5, -0.5]})
    assert_allclose(places(ax), [[-np.pi, 0.0], [0.0, 0.5], [np.pi / 2, -0.5]])
    ax.figure.canvas.draw()
    assert ax.get_xticklabels()[0].get_text() == r"$60^\circ$"
    assert ax.get_yticklabels()[0].get_text() == r"$-60^\circ$"


def test_the_sky_by_regime_and_what_is_refused(statistics, final):
    ax = figures.pole_cloud(final, value="mode")
    lines = named(ax.get_lines())
    short = final["mode"] == 1.0
    assert len(lines["mode-SAM"].get_xdata()) == short.sum() > 0
    assert len(lines["mode-LAM"].get_xdata()) == (~short).sum() > 0
    ax = figures.pole_cloud(final, value="P_phi")
    assert_array_equal(ax.collections[0].get_array(), final["P_phi"])
    _, plain = plt.subplots()
    rejected(TypeError, 'expected a projection "mollweide"', figures.pole_cloud, final, ax=plain)
    with pytest.raises(ValueError, match="no columns of the group pole; expected it in"):
        figures.pole_cloud({"a": [1.0]})
    with pytest.raises(ValueError, match='no direction "axis2"; expected columns axis2_x'):
        figures.pole_cloud({"a": [1.0]}, "axis2")
    with pytest.raises(ValueError, match='takes results of keep="final" or keep="rows", and these'):
        figures.pole_cloud(statistics)
    with pytest.raises(ValueError, match='takes results of keep="final", and these are of'):
        figures.outcomes(statistics)
    rejected(ValueError, 'pole_cloud: no column "z"', figures.pole_cloud, final, value="z")
