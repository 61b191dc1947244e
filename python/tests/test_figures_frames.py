# SPDX-License-Identifier: MIT
"""The planes, nodes and angles of a state: arcs end where the charts say, labels stay apart."""

import itertools

import budgets
import matplotlib

matplotlib.use("Agg")
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest, smallest
from polhode import figures
from polhode.figures.arrows import turned
from polhode.figures.frames import SETS, best_view, frames_of
from polhode.figures.labels import Label, place
from polhode.figures.planes import Disc, back_to_front
from polhode.figures.view import View


def states(count, seed=7):
    rng = np.random.default_rng(seed)
    return polhode.RotorState(rng.normal(size=(count, 4)), rng.normal(size=(count, 3)))


def state_of_the_gallery():
    I, J = np.radians([38.0, 32.0])
    angles = np.radians([55.0, 70.0, 40.0])
    return polhode.to_rotor(polhode.AndoyerState(*angles, np.cos(J), 1.0, np.cos(I)))


@pytest.mark.parametrize("state", list(states(20)))
def test_every_arc_has_the_charts_value_and_ends_at_its_axis(state):
    f = frames_of(state)
    b, G = polhode.charts.attitude_matrix(state.q), polhode.charts.inertial_momentum(state)
    s1, _, s3 = np.eye(3)
    direction = G / np.linalg.norm(G)
    assert_allclose(f.momentum, direction, atol=budgets.round_trip_floor)
    i, j, node = f.nodes["i"], f.nodes["j"], f.nodes["l"]
    for vector, first, second in ((i, s3, direction), (j, direction, b[2]), (node, s3, b[2])):
        cross = np.cross(first, second)
        assert_allclose(vector, cross / np.linalg.norm(cross), atol=budgets.round_trip_floor)
    ends = {
        "h": (s1, i),
        "I": (s3, direction),
        "g": (i, j),
        "J": (direction, b[2]),
        "l": (j, b[0]),
        "phi": (s1, node),
        "theta": (s3, b[2]),
        "psi": (node, b[0]),
    }
    andoyer, euler = polhode.to_andoyer(state), polhode.to_euler(state)
    values = {
        "h": andoyer.h,
        "g": andoyer.g,
        "l": andoyer.l,
        "phi": euler.phi,
        "theta": euler.theta,
        "psi": euler.psi,
        "I": np.arccos(andoyer.H / andoyer.G),
        "J": np.arccos(andoyer.L / andoyer.G),
    }
    assert set(ends) == {name for names in SETS.values() for name in names}
    for name, (start, end) in ends.items():
        arc = f.angles[name].arc()
        assert_allclose(np.linalg.norm(arc, axis=-1), f.angles[name].radius)
        assert_allclose(arc[0] / f.angles[name].radius, start, atol=budgets.round_trip_floor)
        assert_allclose(arc[-1] / f.angles[name].radius, end, atol=budgets.round_trip_floor)
        steps = np.linalg.norm(np.diff(arc, axis=0), axis=-1) / f.angles[name].radius
        turned = np.sum(2.0 * np.arcsin(0.5 * steps))
        assert_allclose(turned, abs(values[name]), rtol=budgets.numpy_formula)


@pytest.mark.parametrize("angles", [*SETS, "both"])
def test_the_drawing_holds_the_arcs_and_says_their_names(angles):
    state = state_of_the_gallery()
    view = View(25.0, 60.0)
    ax = figures.frames_and_angles(state, angles, view)
    lines = {line.get_gid(): line.get_xydata() for line in ax.lines}
    names = [n for kind in SETS if angles in (kind, "both") for n in SETS[kind]]
    f = frames_of(state)
    for name in names:
        near, far = lines[f"{name}-near"], lines[f"{name}-far"]
        assert_allclose(np.where(np.isnan(near), far, near), view.paper(f.angles[name].arc()))
    texts = {t.get_text() for t in ax.texts if t.get_text()}
    assert texts >= {f.angles[name].symbol for name in names}
    assert (r"$\mathbf{G}$" in texts) == (angles != "euler")
    for name in set(sum(SETS.values(), ())) - set(names):
        assert f"{name}-near" not in lines


@pytest.mark.parametrize("angles", [*SETS, "both"])
@pytest.mark.parametrize("state", [state_of_the_gallery(), *states(4, seed=3)])
def test_labels_do_not_overlap(state, angles):
    ax = figures.frames_and_angles(state, angles)
    ax.figure.canvas.draw()
    boxes = [t.get_window_extent() for t in ax.texts if t.get_text()]
    for a, b in itertools.combinations(boxes, 2):
        width = smallest(a.x1, b.x1) - largest(a.x0, b.x0)
        height = smallest(a.y1, b.y1) - largest(a.y0, b.y0)
        assert width <= 0.0 or height <= 0.0


def test_labels_keep_clear_of_lines_where_there_is_room():
    line = np.stack([np.zeros(401), np.linspace(-2.0, 2.0, 401)], axis=-1)
    label = Label("$h$", np.zeros(2), np.array([-1.0, 0.0]))
    (centre,) = place([label], line, 0.2)
    assert centre[0] < -0.5 * 0.2 * 0.55 and abs(centre[0]) < 0.4
    first, second = place([label, label], np.empty((0, 2)), 0.2)
    assert np.max(np.abs(first - second)) > 0.2


def test_angles_of_nothing_are_not_drawn():
    upright = polhode.to_rotor(polhode.AndoyerState(0.7, 0.0, 0.4, 0.8, 1.0, 0.9))
    lines = {line.get_gid() for line in figures.frames_and_angles(upright).lines}
    assert "g-near" not in lines and "l-near" in lines


def test_requirements_are_named():
    with pytest.raises(ValueError, match=r"got states of shape \(2,\); expected one state"):
        figures.frames_and_angles(states(2))
    still = polhode.RotorState([1, 0, 0, 0], [0, 0, 0])
    with pytest.raises(ValueError, match=r"got G = 0.0; expected a state with angular momentum"):
        figures.frames_and_angles(still)


def test_the_view_that_is_chosen_shows_every_plane():
    for state in states(6, seed=11):
        f = frames_of(state)
        view = best_view(f, list(SETS["andoyer"]), ["i", "j"])
        assert smallest(abs(view.toward @ n) for n in (f.inertial[2], f.momentum, f.body[2])) > 0.05


def random_discs(rng, count):
    normals = rng.normal(size=(count, 3))
    return [Disc(n / np.linalg.norm(n), "#FFFFFF") for n in normals]


@pytest.mark.parametrize("count", [1, 2, 3])
def test_discs_are_painted_from_back_to_front(count):
    rng = np.random.default_rng(5)
    view = View(24.0, 33.0)
    for _ in range(10):
        pieces = back_to_front(view, random_discs(rng, count))
        assert len(pieces) == count * largest(2 * (count - 1), 1)
        for x, y in rng.uniform(-0.9, 0.9, size=(40, 2)):
            depths = []
            for sector, disc in pieces:
                base = x * view.right + y * view.up
                point = base - view.toward * (base @ disc.normal) / (view.toward @ disc.normal)
                if inside(sector, disc, point):
                    depths.append(point @ view.toward)
            assert depths == sorted(depths)


def inside(sector, disc, point):
    """Whether a point of the plane is in a sector of the unit disc."""
    first = sector[1]
    second = np.cross(disc.normal, first)
    width = np.arctan2(sector[-1] @ second, sector[-1] @ first) % (2.0 * np.pi) or 2.0 * np.pi
    angle = np.arctan2(point @ second, point @ first) % (2.0 * np.pi)
    return np.linalg.norm(point) < 1.0 and angle < width


def test_a_disc_hides_what_is_below_it_and_not_its_own_points():
    view = View(40.0, 10.0)
    disc = Disc(np.array([0.0, 0.0, 1.0]), "#FFFFFF")
    points = np.array([[0.0, 0.0, -0.5], [0.0, 0.0, 0.5], [0.3, 0.2, 0.0], [3.0, 0.0, -0.5]])
    assert disc.hides(view, points).tolist() == [True, False, False, False]
    edge_on = Disc(view.right, "#FFFFFF")
    assert not edge_on.hides(view, points).any()
    assert_allclose(np.linalg.norm(disc.rim(), axis=-1), 1.0)


def test_turned_is_a_rotation():
    axis = np.array([1.0, 2.0, 2.0]) / 3.0
    points = turned(axis, [0.0, 1.0, 0.0], [0.0, 0.5, 2.0 * np.pi])
    assert_allclose(points[[0, 2]], [[0, 1, 0]] * 2, atol=budgets.chart_rounding)
    assert_allclose(points @ axis, 2.0 / 3.0)
