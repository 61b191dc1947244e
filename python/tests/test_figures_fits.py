# SPDX-License-Identifier: MIT
"""Figures of fits: what is drawn is what the functions returned."""

import dataclasses

import budgets
import matplotlib
import pytest
from closeness import assert_allclose, largest, smallest

matplotlib.use("Agg")
import fit_calls  # noqa: E402
import matplotlib.pyplot as plt
import numpy as np
import polhode
from numpy.testing import assert_array_equal
from polhode import figures
from polhode.figures.body_as_seen import DARK
from polhode.figures.pole_sky import pole_and_covariance
from rejections import rejected

SUN, OBSERVER = fit_calls.SUN, fit_calls.OBSERVER
BODY = fit_calls.BODY


def curve(count=60, seed=1, name="night"):
    random = np.random.default_rng(seed)
    t = np.sort(random.uniform(0.0, 40.0, count))
    blank = polhode.light.LightCurve(t, np.ones(count), 1.0, SUN, OBSERVER)
    (flux,) = polhode.light.model_fluxes(BODY, blank)
    flux *= 1.0 + 0.01 * random.normal(size=count)
    return polhode.light.LightCurve(t, flux, 0.01 * flux.mean(), SUN, OBSERVER, name=name)


CURVE = curve()


@pytest.fixture(scope="module")
def solution():
    found = polhode.light.fit_light(BODY, CURVE)
    assert found.converged
    return found


def lines(axis):
    return {line.get_gid(): line for line in axis.get_lines() if line.get_gid()}


def test_residuals_are_below_the_light_curve(solution):
    sessions = [CURVE, curve(40, 2, "second")]
    axes = figures.light_curve_fit(sessions, solution, unit="h", scale=2.0)
    assert axes.shape == (2, 2)
    for (above, below), session, model in zip(axes, sessions, solution.model(sessions)):
        residuals = lines(below)["residuals"]
        assert_array_equal(residuals.get_ydata(), (session.flux - model) / session.sigma)
        assert_array_equal(residuals.get_xdata(), 2.0 * session.t)
        drawn = lines(above)["model"]
        at_points = np.interp(session.t, drawn.get_xdata() / 2.0, drawn.get_ydata())
        assert_allclose(at_points, model / session.flux.mean(), atol=budgets.drawn_between)
        assert session.name in above.get_title(loc="left") and "(h)" in below.get_xlabel()
    rejected(ValueError, "no light curves", figures.light_curve_fit, [], solution)
    one = figures.light_curve_fit(CURVE, solution.body)
    assert one.shape == (1, 2)


def test_a_landscape_has_the_least_of_its_cells_and_its_minima():
    scan = polhode.light.fourier_scan(CURVE, (0.05, 0.4, 0.0004), (0.1, 0.3, 0.005), order=1)
    axis = figures.scan_landscape(scan, minima=2, unit="h")
    (mesh,) = axis.collections[:1]
    drawn = mesh.get_array()
    freedom = scan.points - 9
    assert drawn.shape[0] <= 700 < len(scan.f1)
    assert_allclose(drawn.min(), scan.chi_square.min() / freedom)
    marks = lines(axis)
    for k, best in enumerate(scan.minima[:2], 1):
        mark = marks[f"minimum-{k}"]
        assert (mark.get_xdata()[0], mark.get_ydata()[0]) == (best.f2, best.f1)
    assert [text.get_text() for text in axis.texts] == ["1", "2"]
    best = scan.minima[0]
    near = figures.scan_landscape(dataclasses.replace(scan, unit="h"), zoom=1)
    left, right = near.get_xlim()
    assert left < best.f2 < right and right - left < 32 * 0.005
    low, high = near.get_ylim()
    assert low < best.f1 < high and high - low < 32 * 0.0004
    assert near.get_xlabel() == "$f_2$ (1/h)"
    with pytest.raises(ValueError, match="zoom: got 99; expected 0, or the place of a minimum"):
        figures.scan_landscape(scan, zoom=99)
    rejected(TypeError, "expected what fourier_scan returns", figures.scan_landscape, 3)


def test_the_error_of_a_pole_is_that_of_draws(solution):
    """Unknowns drawn from the covariance have poles with the covariance that is drawn."""
    pole, covariance = pole_and_covariance(solution, scaled=False)
    assert_allclose(pole, solution.pole, atol=budgets.fit_motion)
    f = polhode.light.LightResiduals(solution.body, CURVE)
    random = np.random.default_rng(1)
    step = 1e-3  # so small that the pole is linear
    x = np.append(np.zeros(3), solution.values[3:])
    drawn = random.multivariate_normal(x, step**2 * solution.covariance, 400)
    poles = []
    for one in drawn:
        body = f.state(one)
        motion = body.spin.free_rotation
        momentum = polhode.charts.inertial_momentum(motion.at(motion.epoch))
        poles.append(momentum / np.linalg.norm(momentum))
    spread = np.trace(np.cov(np.array(poles), rowvar=False)) / step**2
    assert_allclose(np.sqrt(np.trace(covariance) / spread), 1.0, atol=budgets.sampled_spread)


def test_poles_of_all_solutions_are_on_the_sky(solution):
    (toutatis,) = polhode.fit.fit_scenario(fit_calls.TOUTATIS).solutions
    spin = polhode.fit.fit_spin(fit_calls.STATE, fit_calls.RATES, "rate")
    axis = figures.pole_sky([solution, toutatis, spin], labels=["asteroid"])
    said = [text.get_text() for text in axis.get_legend().get_texts()]
    assert said[0] == "asteroid" and said[1].startswith("2: ")
    marks = lines(axis)
    x, y, z = solution.pole
    assert_allclose(marks["pole-1"].get_ydata(), np.arcsin(z), atol=budgets.fit_motion)
    place = np.mod(marks["pole-2"].get_xdata() + np.pi, 2 * np.pi)
    assert_allclose(np.degrees(place), 180.9371752, atol=budgets.drawn_degrees)  # of `polhode fit`
    assert "error-1" in marks and "error-2" in marks
    rejected(TypeError, "mollweide", figures.pole_sky, solution, plt.figure().add_subplot())
    rejected(TypeError, "expected a solution", figures.pole_sky, 3)
    assert len(lines(figures.pole_sky(polhode.fit.fit_scenario(fit_calls.TOUTATIS)))) == 2
    marks = lines(figures.pole_sky([solution] * 17))
    looks = {(marks[f"pole-{k}"].get_marker(), marks[f"pole-{k}"].get_color())
             for k in range(1, 18)}  # fmt: skip
    assert len(looks) == 17


def test_a_body_is_seen_where_its_ellipsoid_is():
    """The edge of the picture is the shadow of the ellipsoid: sup of n.r over it, for each n."""
    axes = figures.body_as_seen(BODY, [0.0, 3.0], SUN, OBSERVER, unit="h", scale=2.0)
    assert len(axes) == 2 and axes[1].get_title() == "$t$ = 6 h"
    eye = np.array(OBSERVER) / np.linalg.norm(OBSERVER)
    up = np.array([0.0, 0.0, 1.0]) - eye[2] * eye
    up /= np.linalg.norm(up)
    right = np.cross(up, eye)
    for axis, t in zip(axes, [0.0, 3.0]):
        q = BODY.spin.free_rotation.at(t).q
        edge = axis.patches[0].get_xy()
        for angle in np.linspace(0.0, 3.0, 7):
            n = np.cos(angle) * right + np.sin(angle) * up
            reach = np.linalg.norm(BODY.shape * (polhode.charts.attitude_matrix(q) @ n))
            drawn = (edge @ [np.cos(angle), np.sin(angle)]).max()
            assert_allclose(drawn, reach, atol=budgets.drawn_edge)
    light = axes[0].images[0].get_array()
    seen = light[np.isfinite(light)]
    assert largest(seen) == 1.0 and smallest(seen) >= DARK
    with pytest.raises(TypeError, match="expected a solution or a LightModel"):
        figures.body_as_seen(3, [0.0], SUN, OBSERVER)
    rejected(ValueError, "to_sun: got shape", figures.body_as_seen, BODY, [0.0], [1.0], OBSERVER)


def test_a_posterior_is_a_corner_plot():
    pytest.importorskip("mici")
    f = polhode.fit.SpinResiduals(fit_calls.STATE, fit_calls.RATES, "rate")
    draws = fit_calls.quietly(polhode.fit.posterior)(f, draws=30, chains=2, warm_up=20)
    axes = figures.corner_plot(draws)
    assert axes.shape == (3, 3) and "rad/time" in axes[-1, 0].get_xlabel()
