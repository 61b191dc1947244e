# SPDX-License-Identifier: MIT
"""Maps and growth: every cell and line is what the indicator says."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from polhode import Adaptive, Body, Problem, Scenario, System, figures, rotor_state
from polhode.analysis import chaos_indicator

BODY = Body(1.0, 1.6, 2.0)
PROBLEM = Problem(
    System(BODY), rotor_state(BODY, [1, 0, 0, 0], [0.3, 0.2, 1.0]), 0.0, 50.0, Adaptive(1e-9)
)
RUN = chaos_indicator(PROBLEM, np.linspace(0.0, 50.0, 26))
FILE = """# polhode 0.1.0
# units: state.euler.phi [deg], body.moments[1] [kg m2], mean_megno [1], lyapunov [1/d]
state.euler.phi,body.moments[1],mean_megno,lyapunov
0,5,2,0.1
0,6,nan,nan
0,7,50,0.3
9,5,3,0.4
9,6,4,0.5
9,7,5,0.6
"""


def mesh_of(ax):
    (mesh,) = ax.collections
    return mesh


def test_a_map_shows_the_cells_of_its_file(tmp_path):
    path = tmp_path / "map.csv"
    path.write_text(FILE)
    ax = figures.chaos_map(path)
    cells = mesh_of(ax).get_array().reshape(2, 3)
    assert_array_equal(np.ma.filled(cells, -1.0), [[2, -1, 50], [3, 4, 5]])
    assert ax.get_ylabel() == "state.euler.phi (deg)"
    assert ax.get_xlabel().startswith("body.moments[1]")
    assert mesh_of(ax).norm.vmin == 2 and mesh_of(ax).norm.vmax == 100
    assert_array_equal(ax.get_lines()[0].get_xydata(), [[6.0, 0.0]])  # the cell without a number
    ax = figures.chaos_map(path, "lyapunov", x="state.euler.phi", y="body.moments[1]")
    assert mesh_of(ax).norm.vmin == 0.1 and mesh_of(ax).norm.vmax == 0.6
    assert ax.figure.axes[-1].get_ylabel() == "Lyapunov indicator (1/d)"


def test_columns_are_a_map_too():
    x, y = (grid.ravel() for grid in np.meshgrid([1.0, 2.0, 4.0], [3.0, 5.0]))
    _, mine = plt.subplots()
    columns = {"y": y, "x": x, "z": x * y}
    assert figures.chaos_map(columns, "z", mine, limits=(0.0, 9.0)) is mine
    assert_array_equal(mesh_of(mine).get_array().reshape(2, 3), [[3, 6, 12], [5, 10, 20]])
    with pytest.raises(ValueError, match='no column "w"; there are: y, x, z'):
        figures.chaos_map(columns, "w")
    with pytest.raises(ValueError, match="5 cells; expected a grid of 3 by 2 places"):
        figures.chaos_map({name: values[:5] for name, values in columns.items()}, "z")


def test_what_scenario_map_returns_is_a_map():
    scenario = Scenario.from_text(
        'schema = 1\nunits.time = "d"\nbody.moments = [1, 1.6, 2]\ntime = { stop = 5, step = 1 }\n'
        "state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.3, 0.2, 1] }\n"
        '[map]\nkind = "chaos"\n'
        '[[map.axis]]\nkey = "body.moments[1]"\nfrom = 1.2\nto = 1.8\ncount = 3\n'
        '[[map.axis]]\nkey = "body.moments[2]"\nfrom = 2.0\nto = 2.1\ncount = 2\n'
    )
    chart = scenario.map()
    ax = figures.chaos_map(chart, "lyapunov")
    assert_array_equal(mesh_of(ax).get_array().ravel(), chart["lyapunov"])
    assert ax.figure.axes[-1].get_ylabel() == "Lyapunov indicator (1/d)"


def test_growth_draws_the_indicators():
    axes = figures.chaos_growth({"free": RUN, "again": RUN}, unit="d", scale=2.0)
    left, right = axes[0].get_lines(), axes[1].get_lines()
    drawn = RUN.lyapunov > 0
    assert_array_equal(left[0].get_xdata(), 2 * RUN.t[drawn])
    assert_array_equal(left[0].get_ydata(), RUN.lyapunov[drawn] / 2)
    assert_array_equal(right[1].get_ydata(), RUN.mean_megno)
    assert left[0].get_color() != left[1].get_color()
    assert [text.get_text() for text in axes[1].get_legend().get_texts()] == ["free", "again"]
    assert axes[0].get_xscale() == "log" and axes[0].get_xlabel() == "$t$ (d)"
    assert axes[0].get_ylabel() == "Lyapunov indicator (1/d)"
    one = figures.chaos_growth(RUN)
    assert one[1].get_legend() is None and one[0].get_xlabel() == "$t$"
