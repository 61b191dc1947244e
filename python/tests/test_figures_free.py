# SPDX-License-Identifier: MIT
"""Momentum sphere, phase plane, polhode and herpolhode: what is drawn is the exact motion."""

import importlib

import budgets
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from differences import slope
from matplotlib.text import Annotation
from polhode import figures
from polhode.figures import arrows, polhode_curves, polhodes
from polhode.figures.momentum_sphere import DEFAULT_VIEW
from polhode.figures.view import Ellipsoid, View, parts, sphere
from polhode.free import Regime

BODIES = {"sorted": polhode.Body(3.0, 4.0, 6.0), "odd order": polhode.Body(4.0, 3.0, 6.0),
          "even order": polhode.Body(6.0, 3.0, 4.0), "Apophis": polhode.Body(0.61, 0.965, 1.0)}
plane = importlib.import_module("polhode.figures.phase_plane")  # its function has the same name
every_body = pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
QUATERNION = [0.9, 0.1, -0.3, 0.2]


def motion(g, body=BODIES["sorted"]):
    return polhode.FreeRotation(body, polhode.RotorState(QUATERNION, g))


def curves(body, G=1.0):
    return [*polhodes.family(body, G), *polhodes.separatrix(body, G)]


def circuits(body, turns, drift):
    """Momenta that go round the axis of the least moment, from 0.2 to 0.2 + drift away from it."""
    u = np.linspace(0.0, 1.0, 400 * turns)
    away, angle = 0.2 + drift * u, 2 * np.pi * turns * u
    ring = np.stack([np.cos(angle), np.sin(angle)]) * np.sin(away)
    return np.stack([np.cos(away), *ring], axis=-1)


def test_a_motion_over_many_polhodes_is_shown_in_parts():
    body = BODIES["sorted"]
    g = circuits(body, 300, 1.0)
    ax = figures.momentum_sphere(body, trace=g)
    near = [line for line in ax.lines if line.get_gid() == "trace-near"]
    assert len(near) == polhodes.PARTS and near[0].get_linewidth() < 1.0
    parts = polhodes.excerpts(body, g)
    assert_allclose([parts[0][0], parts[-1][-1]], [g[0], g[-1]])
    lengths = [np.sum(np.linalg.norm(np.diff(part, axis=0), axis=-1)) for part in parts]
    assert_allclose(lengths, 2 * np.pi, rtol=budgets.figure_bin)
    axis = np.linspace(0.2, 1.2, polhodes.PARTS)
    # of even steps along the path, the middle of the run is farther out than its half
    seen = np.arccos([part[0, 0] for part in parts])
    assert np.all(np.diff(seen) > 0.0) and np.all(seen[1:-1] > axis[1:-1])


@pytest.mark.parametrize("turns, drift", [(300, 0.0), (8, 1.0)])
def test_a_motion_on_one_polhode_or_of_few_circuits_is_whole(turns, drift):
    body = polhode.Body(3.0, 5.0, 5.0)
    g = circuits(body, turns, drift)
    (whole,) = polhodes.excerpts(body, g)
    assert whole is g
    ax = figures.momentum_sphere(body, trace=g)
    assert len([line for line in ax.lines if line.get_gid() == "trace-near"]) == 1


@every_body
def test_points_of_polhodes_satisfy_both_integrals(body):
    G = 2.5
    for curve in curves(body, G):
        g = curve.points
        assert_allclose(np.sum(g * g, -1), G * G, rtol=budgets.free_invariants)
        energy = np.sum(g * g / body.moments, -1)
        assert_allclose(energy, energy[0], rtol=budgets.free_invariants)


@every_body
def test_polhodes_run_with_the_flow_evenly_and_close(body):
    for curve in curves(body):
        steps = np.diff(curve.points, axis=0)
        middles = 0.5 * (curve.points[1:] + curve.points[:-1])
        rate = polhodes.momentum_rate(body, middles)
        along = np.sum(steps * rate, -1) / np.linalg.norm(steps, axis=-1)
        assert np.all(along > 0.9 * np.linalg.norm(rate, axis=-1))
        length = np.linalg.norm(steps, axis=-1)
        assert length.max() < 1.05 * length.min()
        if curve.closed:
            assert_allclose(curve.points[-1], curve.points[0], atol=budgets.free_invariants)


@every_body
def test_the_separatrix_is_two_planes_through_the_intermediate_axis(body):
    least, middle, greatest = polhodes.sorted_axes(body)
    I = body.moments
    arcs = polhodes.separatrix(body, 2.0)
    assert len(arcs) == 4
    tops = set()
    for arc in arcs:
        x, z = arc.points[:, least], arc.points[:, greatest]
        assert_allclose(x * x * (I[middle] / I[least] - 1.0),
                        z * z * (1.0 - I[middle] / I[greatest]), rtol=budgets.chart_rounding,
                        atol=budgets.chart_rounding)
        assert_allclose(np.abs(arc.points[[0, -1], middle]), 2.0)
        top = arc.points[len(x) // 2]
        tops.add((top[least] > 0, top[greatest] > 0))
    assert len(tops) == 4


@every_body
def test_families_hold_both_modes_about_both_ends(body):
    least, _, greatest = polhodes.sorted_axes(body)
    for even in ("angle", "height"):
        found = polhodes.family(body, 1.0, 3, 2, even=even)
        for regime, axis, number in ((Regime.short_axis, greatest, 3),
                                     (Regime.long_axis, least, 2)):
            signs = [np.sign(c.points[0, axis]) for c in found if c.regime == regime]
            assert sorted(signs) == [-1.0] * number + [1.0] * number


def test_families_of_degenerate_bodies():
    oblate, prolate, ball = polhode.Body(3, 3, 5), polhode.Body(2, 5, 5), polhode.Body(2, 2, 2)
    assert {c.regime for c in polhodes.family(oblate)} == {Regime.short_axis}
    assert {c.regime for c in polhodes.family(prolate)} == {Regime.long_axis}
    assert polhodes.family(ball) == []
    for body, steady in ((oblate, 2), (prolate, 2), (ball, 0)):
        assert polhodes.separatrix(body, 1.0) == []
        assert len(polhodes.steady_points(body)) == steady
        figures.momentum_sphere(body)
        figures.phase_plane(body)
    with pytest.raises(ValueError, match="got even = 'area'; expected angle or height"):
        polhodes.family(oblate, even="area")


def test_the_polhode_of_each_regime():
    body = BODIES["sorted"]
    flip = motion([1.0, 0.5, -1.0])
    assert flip.regime == Regime.separatrix
    arc = polhodes.polhode(flip).points
    for t in np.linspace(-30.0, 30.0, 13):
        gap = np.linalg.norm(arc - flip.at(t).g, axis=-1).min()
        assert gap < np.pi * flip.momentum / 360
    steady = polhodes.polhode(motion([0.0, 0.0, 2.0]))
    assert_allclose(steady.points, [[0.0, 0.0, 2.0]])
    assert polhodes.polhode(motion([0.0, 0.0, 0.0])).points.shape == (1, 3)
    stable = {tuple(p): s for p, s in polhodes.steady_points(body, 2.0)}
    assert len(stable) == 6
    assert not stable[0.0, 2.0, 0.0] and stable[0.0, 0.0, -2.0] and stable[2.0, 0.0, 0.0]


def test_a_view_is_a_right_handed_frame():
    view = View(31.0, -77.0)
    frame = np.array([view.right, view.up, view.toward])
    assert_allclose(frame @ frame.T, np.eye(3), atol=budgets.chart_rounding)
    assert_allclose(np.linalg.det(frame), 1.0)
    assert_allclose(view.paper([0.0, 0.0, 1.0]), [0.0, np.cos(np.radians(31.0))])
    assert repr(view) == "View(elevation=31.0, azimuth=-77.0)"


def test_a_surface_hides_what_is_behind_and_inside():
    view = View(20.0, 50.0)
    turn = polhode.charts.attitude_matrix([0.5, 0.5, -0.1, 0.7])
    for surface in (sphere(2.0), Ellipsoid((1.0, 2.0, 0.7), turn)):
        edge = surface.outline(view)
        assert_allclose(surface.facing(view, edge), 0.0, atol=budgets.round_trip_floor)
        rng = np.random.default_rng(1)
        unit = rng.normal(size=(200, 3))
        unit /= np.linalg.norm(unit, axis=-1, keepdims=True)
        on = unit * surface.semi_axes @ surface.frame
        behind = surface.facing(view, on) < 0.0
        assert np.array_equal(surface.hides(view, on), behind)
        assert np.all(surface.hides(view, 0.9 * on))
        assert not surface.hides(view, 1.3 * on[~behind]).any()
        assert surface.hides(view, [-5.0 * view.toward])[0]
        assert not surface.hides(
            view, [5.0 * view.toward, 5.0 * view.right - 5.0 * view.toward]
        ).any()


def test_parts_meet_and_make_up_the_curve():
    points = np.arange(12.0).reshape(6, 2)
    hidden = np.array([False, False, True, True, False, False])
    near, far = parts(points, hidden)
    assert_allclose(np.where(np.isnan(near), far, near), points)
    assert_allclose(near[2], points[2])
    assert np.isnan(near[3]).all() and np.isnan(far[[0, 1, 4, 5]]).all()


def heads(ax):
    """Heads without a shaft: (middle, direction); from tail to tip is a twentieth of a head."""
    found = [
        t for t in ax.texts if isinstance(t, Annotation) and t.arrow_patch.get_linewidth() == 0.0
    ]
    ends = [(np.array(t.xy), np.array(t.xy) - np.array(t.get_position())) for t in found]
    return [(tip - 10.0 * along, along) for tip, along in ends]


def on_flow(points, rates, point, direction, reach):
    """Whether a head lies on a curve (n, 2) and points along its rate there."""
    nearest = int(np.argmin(np.linalg.norm(points - point, axis=-1)))
    rate = rates[nearest]
    cosine = direction @ rate / np.linalg.norm(direction) / np.linalg.norm(rate)
    return np.linalg.norm(points[nearest] - point) < reach and cosine > 0.9999


@every_body
def test_the_momentum_sphere_draws_its_polhodes_and_their_sense(body):
    ax = figures.momentum_sphere(body, G=2.0)
    lines = {line.get_gid(): line for line in ax.lines}
    drawn = curves(body, 2.0)
    for number, curve in enumerate(drawn):
        near, far = (lines[f"polhode-{number}-{part}"].get_xydata() for part in ("near", "far"))
        paper = DEFAULT_VIEW.paper(curve.points)
        assert_allclose(np.where(np.isnan(near), far, near), paper)
        deep = curve.points @ DEFAULT_VIEW.toward
        last_seen = (deep[1:] < 0.0) & (deep[:-1] >= 0.0)  # where the two parts meet
        assert np.array_equal(np.isfinite(near[1:, 0]), (deep[1:] >= 0.0) | last_seen)
        assert np.all(np.isnan(far[deep >= 0.0]))
    assert len(heads(ax)) >= 8
    for point, direction in heads(ax):
        assert any(
            on_flow(DEFAULT_VIEW.paper(c.points),
                    DEFAULT_VIEW.paper(polhodes.momentum_rate(body, c.points)), point, direction,
                    1e-6)
            for c in drawn
        )
    assert {t.get_text() for t in ax.texts} >= {rf"$\mathbf{{b}}_{k}$" for k in (1, 2, 3)}


def test_a_run_is_drawn_thick_on_the_sphere_and_in_the_plane():
    body = BODIES["sorted"]
    g = motion([0.3, 0.2, 1.0]).at(np.linspace(0.0, 60.0, 200)).g
    G = np.linalg.norm(g[0])
    ax = figures.momentum_sphere(body, G, trace=g)
    traced = [line for line in ax.lines if line.get_gid() == "trace-near"]
    assert traced[0].get_linewidth() > 2.0
    assert "this motion" in [t.get_text() for t in ax.get_legend().get_texts()]
    ax = figures.phase_plane(body, G, trace=g)
    chart = polhode.to_andoyer(polhode.RotorState([1, 0, 0, 0], g))
    xy = [line.get_xydata() for line in ax.lines if line.get_gid() == "trace"]
    assert any(np.allclose(p[:, 1], chart.L / G) for p in xy)


@pytest.mark.parametrize("draw", [figures.momentum_sphere, figures.phase_plane])
def test_states_of_a_run_are_drawn_as_their_momenta(draw):
    run = motion([0.3, 0.2, 1.0])
    for t in (np.linspace(0.0, 60.0, 200), 0.0):
        drawn = []
        for trace in (run.at(t), run.at(t).g):
            lines = draw(run.body, run.momentum, trace=trace).lines
            drawn.append([x.get_xydata() for x in lines if "trace" in (x.get_gid() or "")])
        assert len(drawn[0]) > 0
        for states, momenta in zip(*drawn):
            np.testing.assert_array_equal(states, momenta)


@pytest.mark.parametrize("draw", [figures.momentum_sphere, figures.phase_plane])
@pytest.mark.parametrize(("given", "error", "words"), [
    ({"trace": [1, 2]}, ValueError, r"trace of shape \(2,\); expected momenta of shape \(n, 3\)"),
    ({"trace": []}, ValueError, r"trace of shape \(0,\); .* at least one"),
    ({"trace": np.zeros((0, 3))}, ValueError, r"trace of shape \(0, 3\)"),
    ({"trace": 1.0}, ValueError, r"trace of shape \(\)"),
    ({"trace": "run.csv"}, TypeError, r"trace = 'run.csv'; .* or a RotorState"),
    ({"G": -1}, ValueError, "G = -1; expected a positive, finite number"),
    ({"G": 0.0}, ValueError, "G = 0.0; expected a positive"),
    ({"G": float("nan")}, ValueError, "G = nan; expected a positive"),
    ({"G": float("inf")}, ValueError, "G = inf; expected a positive"),
    ({"G": "big"}, TypeError, "G = 'big'; expected a positive"),
])
def test_what_has_no_sphere_is_refused_before_anything_is_drawn(draw, given, error, words):
    with pytest.raises(error, match=f"^{draw.__name__}: got (a )?{words}"):
        draw(BODIES["sorted"], **given)
    assert plt.get_fignums() == []


@every_body
def test_the_phase_plane_draws_andoyers_l_and_L_with_their_sense(body):
    G = 1.5
    ax = figures.phase_plane(body, G)
    drawn = [*polhodes.family(body, G, even="height"), *polhodes.separatrix(body, G)]
    points = [phase_plane_points(body, c.points, G) for c in drawn]
    for number, expected in enumerate(points):
        copies = [line.get_xydata() for line in ax.lines if line.get_gid() == f"polhode-{number}"]
        assert copies
        for xy in copies:
            turns = (xy[:, 0] - expected[:, 0]) / 4.0
            assert_allclose(turns, np.round(turns[0]), atol=budgets.round_trip_floor)
            assert_allclose(xy[:, 1], expected[:, 1])
    found = heads(ax)
    assert len(found) >= len(drawn) - 4
    for point, direction in found:
        assert any(
            on_flow(p + [shift, 0.0], plane.plane_rate(body, c.points, G), point, direction, 1e-6)
            for p, c in zip(points, drawn)
            for shift in (-8.0, -4.0, 0.0, 4.0, 8.0)
        )


def phase_plane_points(body, g, G):
    """l / (pi/2) and L / G from Andoyer's chart, checked against the Hamiltonian in l and L."""
    chart = polhode.to_andoyer(polhode.RotorState([1, 0, 0, 0], g))
    l, L = np.unwrap(chart.l), np.asarray(chart.L)
    I1, I2, I3 = body.moments
    T = 0.5 * (G * G - L * L) * (np.sin(l) ** 2 / I1 + np.cos(l) ** 2 / I2) + 0.5 * L * L / I3
    assert_allclose(T, T[0], rtol=budgets.round_trip_floor)
    return np.stack([l / (np.pi / 2), L / G], axis=-1)


def test_the_shaded_region_is_the_long_axis_mode():
    ax = figures.phase_plane(BODIES["sorted"])
    region = ax.collections[0].get_paths()[0]
    assert region.contains_point((1.0, 0.5)) and region.contains_point((-1.0, -0.6))
    assert not region.contains_point((0.0, 0.3)) and not region.contains_point((1.0, 0.8))


@pytest.mark.parametrize("moments", [(3, 3, 5), (2, 2, 2)])
def test_nothing_is_shaded_where_there_is_no_long_axis_mode(moments):
    assert list(figures.phase_plane(polhode.Body(*moments)).collections) == []


@every_body
def test_the_momentum_flips_at_the_rate_of_the_separatrix(body):
    """g_2 / G = tanh u, from the exact motion."""
    flip = motion(polhodes.separatrix(body, 2.0)[0].points[180], body)
    t = np.linspace(-1.0, 1.0, 5)
    u = np.arctanh(flip.at(t).g[:, polhodes.sorted_axes(body)[1]] / 2.0)
    u *= np.sign(u[-1])
    assert_allclose(u, polhodes.separatrix_rate(body, 2.0) * t, atol=budgets.free_attitude)


def test_the_rate_in_the_plane_is_the_derivative():
    body = BODIES["sorted"]
    run = motion([0.3, 0.2, 1.0])
    G = run.momentum
    by_differences = slope(lambda t: plane.plane_points(run.at([t]).g, G)[0], 1.0)
    rate = plane.plane_rate(body, run.at([1.0]).g, G)[0]
    assert_allclose(by_differences, rate, atol=budgets.numpy_differences)


@every_body
@pytest.mark.parametrize("g", [[0.3, 0.2, 1.0], [1.0, 0.2, 0.3]], ids=["one", "other"])
def test_herpolhode_stays_in_its_plane_and_touches_its_circles(body, g):
    run = motion(g, body)
    points = polhode_curves.herpolhode_points(run, 2.0, 2000)
    assert_allclose(points[:, 2], 2.0 * run.energy / run.momentum, rtol=budgets.free_attitude)
    radius = np.hypot(points[:, 0], points[:, 1])
    inner, outer = polhode_curves.herpolhode_radii(run)
    slack = budgets.free_attitude * np.linalg.norm(points[0])
    assert radius.min() >= inner - slack and radius.max() <= outer + slack
    sampled = budgets.figure_sampled * outer
    assert radius.min() < inner + sampled and radius.max() > outer - sampled


def test_herpolhode_starts_where_the_motion_is():
    run = motion([0.3, 0.2, 1.0])
    axes = polhode_curves.invariable_axes(run)
    assert_allclose(axes @ axes.T, np.eye(3), atol=budgets.chart_rounding)
    assert_allclose(np.linalg.det(axes), 1.0)
    omega = polhode.charts.inertial_angular_velocity(run.body, run.initial_state)
    assert_allclose(
        polhode_curves.herpolhode_points(run)[0] @ axes, omega, rtol=budgets.free_attitude
    )


def test_herpolhode_of_a_flip_and_of_a_steady_spin():
    flip = motion([1.0, 0.5, 1.0])
    points = polhode_curves.herpolhode_points(flip)
    radius = np.hypot(points[:, 0], points[:, 1])
    inner, outer = polhode_curves.herpolhode_radii(flip)
    assert_allclose(inner, 0.0, atol=budgets.free_attitude)
    assert_allclose(radius.max(), outer, rtol=budgets.figure_sampled)
    assert radius[[0, -1]].max() < 1e-2 * outer
    spin = motion([0.0, 0.0, 1.0])
    assert polhode_curves.herpolhode_points(spin).shape == (1, 3)
    assert polhode_curves.herpolhode_radii(spin) == (0.0, 0.0)
    for run in (flip, spin):
        assert figures.polhode_and_herpolhode(run).shape == (2,)
    with pytest.raises(ValueError, match="herpolhode: got a body at rest"):
        figures.herpolhode(motion([0.0, 0.0, 0.0]))


@every_body
def test_the_polhode_lies_on_the_energy_ellipsoid(body):
    run = motion([0.9, 0.3, 0.8], body)
    view = View(30.0, 20.0)
    ax = figures.polhode_on_ellipsoid(run, view)
    lines = {line.get_gid(): line.get_xydata() for line in ax.lines}
    omega = polhodes.polhode(run).points / body.moments
    assert_allclose(
        np.sum(body.moments * omega**2, -1), 2.0 * run.energy, rtol=budgets.free_invariants
    )
    near, far = lines["polhode-near"], lines["polhode-far"]
    assert_allclose(np.where(np.isnan(near), far, near), view.paper(omega))
    rates = polhodes.momentum_rate(body, omega * body.moments) / body.moments
    for point, direction in heads(ax):
        assert on_flow(view.paper(omega), view.paper(rates), point, direction, 1e-6)


def test_a_polhode_on_the_far_side_shows_no_sense_of_motion():
    run = motion([0.1, 0.1, 1.0])
    assert len(heads(figures.polhode_on_ellipsoid(run, View(80.0, 0.0)))) == 2
    assert heads(figures.polhode_on_ellipsoid(run, View(-80.0, 0.0))) == []


def test_herpolhode_axes_name_node_and_unit():
    ax = figures.herpolhode(motion([0.3, 0.2, 1.0]), unit="rad/h")
    assert ax.get_xlabel() == r"$\omega$ along the node $\mathbf{i}$ (rad/h)"
    points = polhode_curves.herpolhode_points(motion([0.3, 0.2, 1.0]))
    drawn = next(line for line in ax.lines if line.get_gid() == "herpolhode")
    assert_allclose(drawn.get_xydata(), points[:, :2])
    for point, direction in heads(ax):
        radial = point @ direction
        assert radial > 0.0


def test_a_head_has_its_size_on_paper_and_needs_a_direction():
    _, ax = plt.subplots(figsize=(4.0, 2.0), dpi=100)
    ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1000.0))
    drawn = arrows.head(ax, (0.5, 500.0), (1.0, 1000.0), size=10.0)
    ends = ax.transData.transform([drawn.get_position(), drawn.xy])
    middle = ax.transData.transform((0.5, 500.0))
    half = 0.5 * arrows.HEAD_LENGTH * 10.0 * 100.0 / 72.0
    assert_allclose(np.linalg.norm(ends[1] - middle), half)
    along = np.diff(ends, axis=0)[0] @ (ends[1] - middle)
    assert_allclose(along, 0.1 * half * half, rtol=budgets.numpy_pixels)
    pixels = np.diff(ax.transData.transform([[0.0, 0.0], [arrows.data_per_point(ax), 0.0]]), axis=0)
    assert_allclose(pixels[0, 0], 100.0 / 72.0)
    with pytest.raises(ValueError, match=r"got direction \[0.0, 0.0\]; expected a vector"):
        arrows.head(ax, (0.5, 500.0), (0.0, 0.0))
