# SPDX-License-Identifier: MIT
"""A satellite of a precessing oblate planet: which velocity the elements return, and how the
ellipses meet the orbit [SA section 4.4.3, footnote; Figs. 5 and 6]."""

import importlib

import budgets
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from matplotlib.colors import to_rgba
from numpy.polynomial import chebyshev
from polhode import figures
from polhode.figures import oblate_planet, style

ellipses = importlib.import_module("polhode.figures.ellipses")
PATH = ellipses.example_orbit()
STOP = PATH.stop
TIMES = np.linspace(0.0, STOP, 23)
MU = np.asarray(PATH.planet.mu)


def piece(rates, start, length):
    """Chebyshev series of z' = rates(z), by Picard's iteration to rounding: another integrator than
    that of the library."""
    count = 48
    nodes = chebyshev.chebpts1(count)
    to_series = np.linalg.inv(chebyshev.chebvander(nodes, count - 1))
    values = np.broadcast_to(start, (count, start.size))
    last = np.inf
    for _ in range(100):
        series = chebyshev.chebint(to_series @ rates(values), lbnd=-1.0) * (length / 2.0)
        series[0] += start
        new = chebyshev.chebval(nodes, series).T
        change = float(np.max(np.abs(new - values)))
        values = new
        rounding = 1e-12 * float(np.max(np.abs(values)))  # kilometres have larger ones than radii
        if change == 0.0 or (change >= last and change < rounding):
            return series
        last = change
    raise RuntimeError("no solution")


def inertial_path():
    """Position and velocity at TIMES in components of the frame of date, from the equations of
    motion in inertial axes, where only the planet turns: without any of the frame's terms."""
    rate = float(np.linalg.norm(MU))
    k = MU / rate

    def turned(v, angle):
        angle = np.asarray(angle)[..., None]
        along = (v @ k)[..., None] * k
        return along + np.cos(angle) * (v - along) + np.sin(angle) * np.cross(k, v)

    def rates(z):  # r, v, t
        r, v, t = z[..., :3], z[..., 3:6], z[..., 6]
        force = turned(PATH.planet.acceleration(turned(r, -rate * t)), rate * t)
        return np.concatenate([v, force, np.ones_like(t)[..., None]], axis=-1)

    z = np.concatenate([PATH.position(0.0), PATH.momentum(0.0), [0.0]])
    found = [z]
    for start, stop in zip(TIMES[:-1], TIMES[1:]):
        for _ in range(2):
            series = piece(rates, z, (stop - start) / 2)
            z = chebyshev.chebval(1.0, series)
        found.append(z)
    z = np.array(found)
    return turned(z[:, :3], -rate * TIMES), turned(z[:, 3:6], -rate * TIMES)


def delaunay_formulas(elements, gm):
    """r and v of Kepler's problem from Delaunay's l, g, h, L, G, H; also of complex elements."""
    m, w, h, L, G, H = np.moveaxis(elements, -1, 0)
    a, e = L * L / gm, np.sqrt(1.0 - (G / L) ** 2)
    E = m + 0.0
    for _ in range(12):
        E = E - (E - e * np.sin(E) - m) / (1.0 - e * np.cos(E))
    x, y = a * (np.cos(E) - e), a * (G / L) * np.sin(E)
    n_over = np.sqrt(gm / a) / (1.0 - e * np.cos(E))
    vx, vy = -n_over * np.sin(E), n_over * (G / L) * np.cos(E)
    ci = H / G
    si = np.sqrt(1.0 - ci * ci)
    cw, sw, ch, sh = np.cos(w), np.sin(w), np.cos(h), np.sin(h)
    P = np.stack([ch * cw - sh * sw * ci, sh * cw + ch * sw * ci, sw * si], axis=-1)
    Q = np.stack([-ch * sw - sh * cw * ci, -sh * sw + ch * cw * ci, cw * si], axis=-1)
    return x[..., None] * P + y[..., None] * Q, vx[..., None] * P + vy[..., None] * Q


def delaunay_elements(r, p, gm):
    h, size = np.cross(r, p), np.linalg.norm(r)
    e_vector = np.cross(p, h) / gm - r / size
    e, G = np.linalg.norm(e_vector), np.linalg.norm(h)
    L = gm / np.sqrt(2.0 * gm / size - p @ p)
    node = np.array([-h[1], h[0], 0.0]) / np.hypot(h[0], h[1])
    w = np.arctan2(e_vector @ np.cross(h / G, node), e_vector @ node)
    a = L * L / gm
    E = np.arctan2(r @ p / L, 1.0 - size / a)
    return np.array([E - e * np.sin(E), w, np.arctan2(node[1], node[0]), L, G, h[2]])


def perturbation(elements, planet):
    """What is added to -gm^2 / 2 L^2: the bulge, and -mu . (r x p), at (r, p) of the formulas."""
    r, p = delaunay_formulas(elements, planet.gm)
    size2 = np.sum(r * r, axis=-1)
    bulge = planet.gm * planet.J2_R2 / size2**1.5 * (3.0 * r[..., 2] ** 2 / size2 - 1.0) / 2.0
    return bulge - np.cross(r, p) @ np.asarray(planet.mu)


def delaunay_rates(planet):
    """Hamilton's equations of the six elements; derivatives by complex steps, so to rounding."""

    def rates(elements):
        slope = np.empty_like(elements)
        for k in range(6):
            moved = elements.astype(complex)
            moved[..., k] += 1e-30j
            slope[..., k] = perturbation(moved, planet).imag / 1e-30
        slope[..., 3] += planet.gm**2 / elements[..., 3] ** 3
        return np.concatenate([slope[..., 3:], -slope[..., :3]], axis=-1)

    return rates


def test_the_path_is_that_of_the_inertial_equations_of_motion():
    r, v = inertial_path()
    assert_allclose(PATH.position(TIMES), r, atol=budgets.figure_orbit)
    assert_allclose(PATH.momentum(TIMES), v, atol=budgets.figure_orbit)


def test_the_slope_of_the_path_is_the_relative_velocity():
    r, v = inertial_path()
    assert_allclose(PATH.velocity(TIMES), v - np.cross(MU, r), atol=budgets.figure_orbit)


def test_the_hamiltonian_is_constant():
    t = np.linspace(0.0, STOP, 301)
    energy = PATH.planet.energy(np.concatenate([PATH.position(t), PATH.momentum(t)], axis=-1))
    assert np.ptp(energy) < budgets.figure_orbit * abs(energy[0])


def test_the_acceleration_is_the_slope_of_the_energy():
    r = PATH.position(TIMES)
    step, rest = 1e-5, np.zeros_like(r)
    still = polhode.figures.OblatePlanet(PATH.planet.gm, PATH.planet.J2_R2, (0.0, 0.0, 0.0))
    for k in range(3):
        up, down = (np.concatenate([r + s * step * np.eye(3)[k], rest], axis=-1) for s in (1, -1))
        slope = (still.energy(up) - still.energy(down)) / (2.0 * step)
        assert_allclose(still.acceleration(r)[:, k], -slope, atol=budgets.figure_differences)


def test_canonical_delaunay_elements_return_the_inertial_velocity():
    """The paper's claim. The six elements are integrated by their own canonical equations; put into
    the formulas of the unperturbed orbit they give the position of date, and the velocity of the
    inertial equations of motion: not the one relative to the frame."""
    planet = PATH.planet
    z = delaunay_elements(PATH.position(0.0), PATH.momentum(0.0), planet.gm)
    found = [z]
    rates = delaunay_rates(planet)
    for start, stop in zip(TIMES[:-1], TIMES[1:]):
        for _ in range(2):
            series = piece(rates, z, (stop - start) / 2)
            z = chebyshev.chebval(1.0, series)
        found.append(z)
    r, g = delaunay_formulas(np.array(found), planet.gm)
    r_of_date, v_inertial = inertial_path()
    assert_allclose(r, r_of_date, atol=budgets.figure_orbit)
    assert_allclose(g, v_inertial, atol=budgets.figure_orbit)
    relative = v_inertial - np.cross(MU, r_of_date)
    assert np.linalg.norm(g - relative, axis=-1).min() > 0.05


@pytest.mark.parametrize("osculating", [False, True])
def test_an_ellipse_passes_through_the_satellite_along_its_own_velocity(osculating):
    r, v = inertial_path()
    if osculating:
        v = v - np.cross(MU, r)
    for k, t in enumerate(TIMES):
        drawn = ellipses.instantaneous_ellipse(PATH, t, osculating)
        assert_allclose(drawn.at(drawn.anomaly), r[k], atol=budgets.figure_orbit)
        along = drawn.slope(drawn.anomaly)
        sine = np.linalg.norm(np.cross(along, v[k])) / np.linalg.norm(along) / np.linalg.norm(v[k])
        assert sine < budgets.figure_orbit and along @ v[k] > 0.0


def test_an_ellipse_is_the_orbit_of_the_library():
    t = 0.4 * STOP
    drawn = ellipses.instantaneous_ellipse(PATH, t, False)
    kepler = polhode.KeplerOrbit.from_state(PATH.position(t), PATH.momentum(t), PATH.planet.gm)
    later = kepler.position(np.linspace(0.0, 9.0, 40))
    x, y = later @ drawn.P / drawn.a + drawn.e, later @ drawn.Q / drawn.b
    assert_allclose(x * x + y * y, 1.0, atol=budgets.figure_orbit)
    assert_allclose(later @ np.cross(drawn.P, drawn.Q), 0.0, atol=budgets.figure_orbit)


def distance(drawn, point):
    """From a point to an ellipse, near the satellite: Newton's method on the eccentric anomaly."""
    E = drawn.anomaly
    for _ in range(30):
        off, along = drawn.at(E) - point, drawn.slope(E)
        bend = -drawn.a * np.cos(E) * drawn.P - drawn.b * np.sin(E) * drawn.Q
        E = E - (off @ along) / (along @ along + off @ bend)
    return np.linalg.norm(drawn.at(E) - point)


@pytest.mark.parametrize(("osculating", "order"), [(False, 1), (True, 2)])
@pytest.mark.parametrize("part", [0.2, 0.5, 0.7])
def test_ellipses_cut_or_touch_the_orbit(osculating, order, part):
    """The distance from orbit to ellipse grows as the time from the contact, or its square."""
    t = part * STOP
    drawn = ellipses.instantaneous_ellipse(PATH, t, osculating)
    steps = 1e-3 * 0.5 ** np.arange(4)
    far = [distance(drawn, PATH.position(t + step)) for step in steps]
    slopes = np.diff(np.log(far)) / np.diff(np.log(steps))
    assert_allclose(slopes, order, atol=budgets.figure_contact)


@pytest.mark.parametrize("osculating", [False, True])
def test_what_is_drawn(osculating):
    times = STOP * np.array([0.2, 0.6])
    ax = figures.orbit_ellipses(osculating=osculating, times=times)
    lines = {line.get_gid(): line.get_xydata() for line in ax.get_lines() if line.get_gid()}
    view = ellipses.VIEW
    assert set(lines) == {"orbit", "ellipse-0", "ellipse-1"}
    seen = lines["orbit"][np.isfinite(lines["orbit"][:, 0])]
    assert_allclose(seen[0], view.paper(PATH.position(0.0)))
    tips = {}
    for text in ax.texts:
        if getattr(text, "arrow_patch", None) is not None:
            tips.setdefault(tuple(np.round(text.xyann, 9)), []).append(np.asarray(text.xy))
    for k, t in enumerate(times):
        r = view.paper(PATH.position(t))
        assert np.min(np.linalg.norm(lines[f"ellipse-{k}"] - r, axis=1)) < 0.02
        drawn = np.array(tips[tuple(np.round(r, 9))])
        wanted = [PATH.velocity(t)] if osculating else [PATH.velocity(t), PATH.momentum(t)]
        assert_allclose(
            drawn - r, view.paper(ellipses.ARROW * np.array(wanted)), atol=budgets.figure_orbit
        )
    said = [text.get_text() for text in ax.get_legend().get_texts()]
    assert said == ["orbit", ("" if osculating else "non-") + "osculating ellipses"]


def test_the_two_figures_compare_and_leave_settings_alone():
    before = dict(matplotlib.rcParams)
    figure, (left, right) = plt.subplots(1, 2)
    assert figures.orbit_ellipses(ax=left) is left
    assert figures.orbit_ellipses(osculating=True, ax=right) is right
    assert left.get_xlim() == right.get_xlim() and left.get_ylim() == right.get_ylim()
    colours = {to_rgba(line.get_color()) for line in left.get_lines()}
    assert to_rgba(style.VERMILLION) in colours and to_rgba(style.BLUE) not in colours
    assert dict(matplotlib.rcParams) == before


def test_no_ellipse_goes_through_an_escaping_satellite():
    with pytest.raises(ValueError, match=r"eccentricity 3\.0; expected less than 1"):
        oblate_planet.ellipse([1.0, 0.0, 0.0], [0.0, 2.0, 0.0], 1.0)
    with pytest.raises(ValueError, match="expected less than 1"):
        oblate_planet.ellipse([1.0, 0.0, 0.0], [0.5, 0.0, 0.0], 1.0)


def test_a_circle_has_its_axis_where_the_satellite_is():
    circle = oblate_planet.ellipse([0.0, 2.0, 0.0], [-(0.5**0.5), 0.0, 0.0], 1.0)
    assert circle.e < 4 * np.finfo(float).eps and circle.anomaly == pytest.approx(
        0.0, abs=budgets.chart_rounding
    )
    assert_allclose(circle.at(np.pi / 2), [-2.0, 0.0, 0.0], atol=budgets.chart_rounding)


def test_a_figure_of_an_orbit_needs_a_path():
    with pytest.raises(TypeError, match="orbit_ellipses: got path = 3; expected a path from"):
        figures.orbit_ellipses(3)
    assert plt.get_fignums() == []


@pytest.mark.parametrize("stop", [0, -1.0, np.nan, np.inf])
def test_a_path_takes_time(stop):
    with pytest.raises(ValueError, match=f"path: got stop = {stop!r}; expected a positive, finite"):
        PATH.planet.path([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], stop)


def test_a_path_without_a_solution_says_so():
    planet = figures.OblatePlanet(1.0, 0.01, (0.0, 0.0, 0.0))
    with pytest.raises(RuntimeError, match="path: "):
        planet.path([1.0, 0.0, 0.0], [0.0, 0.0, 0.0], 3.0)  # it falls into the middle
    with pytest.raises(ValueError, match="SatelliteState: r: got nan; expected finite numbers"):
        planet.path([np.nan, 0.0, 0.0], [0.0, 1.0, 0.0], 3.0)


def test_a_path_is_the_same_in_other_units():
    """Lengths of kilometres round at 1e-12: the iteration comes to rest there, too."""
    km, s = 7000.0, 930.0
    planet = PATH.planet
    other = figures.OblatePlanet(
        planet.gm * km**3 / s**2, planet.J2_R2 * km**2, tuple(np.divide(planet.mu, s))
    )
    start, momentum = PATH.position(0.0), PATH.momentum(0.0)
    path = other.path(km * start, km / s * momentum, s * STOP)
    assert_allclose(path.position(s * TIMES) / km, PATH.position(TIMES), atol=budgets.figure_orbit)
