# SPDX-License-Identifier: MIT
"""Orbits: Kepler's against the equation of two bodies, and what serves as one."""

import copy
import math
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from differences import slope
from polhode import KeplerElements, KeplerOrbit, PrecessingKeplerOrbit
from polhode.satellites import (
    SecularRates,
    j2_rates,
    mean_elements,
    mean_motion,
    pericentre_distance,
    semi_major_axis,
)
from polhode.types import Dual
from public_names import PUBLIC
from rejections import rejected

ROUNDED = budgets.numpy_formula
SLOPES = budgets.numpy_differences
ELLIPSE = KeplerElements(gm=2.0, pericentre=3.0, eccentricity=0.3, inclination=0.5, node=0.7,
                         argument=1.1, mean_anomaly=0.2, epoch=4.0)
FLYBY = KeplerElements(gm=398600.4418, pericentre=38068.0, eccentricity=4.2291, inclination=0.4)


def solved_position(e: KeplerElements, t: float) -> np.ndarray:
    """Kepler's equation by bisection, then the textbook's rotations."""
    a = e.pericentre / (1 - e.eccentricity)
    M = e.mean_anomaly + math.sqrt(e.gm / abs(a) ** 3) * (t - e.epoch)
    ellipse = e.eccentricity < 1

    def equation(E):
        return (E - e.eccentricity * math.sin(E) if ellipse
                else e.eccentricity * math.sinh(E) - E) - M

    low, high = M - 20.0, M + 20.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if equation(middle) < 0 else (low, middle)
    E = 0.5 * (low + high)
    if ellipse:
        x, y = a * (math.cos(E) - e.eccentricity), a * math.sqrt(
            1 - e.eccentricity**2) * math.sin(E)
    else:
        x, y = a * (math.cosh(E) - e.eccentricity), -a * math.sqrt(
            e.eccentricity**2 - 1) * math.sinh(E)

    def turn(axis, angle):
        c, s = math.cos(angle), math.sin(angle)
        return np.array({1: [[1, 0, 0], [0, c, -s], [0, s, c]],
                         3: [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis])

    return turn(3, e.node) @ turn(1, e.inclination) @ turn(3, e.argument) @ [x, y, 0.0]


@pytest.mark.parametrize("elements", [ELLIPSE, FLYBY], ids=["ellipse", "flyby"])
def test_positions_solve_keplers_equation(elements):
    orbit = KeplerOrbit(elements)
    times = elements.epoch + np.linspace(-2.0, 2.0, 5) / mean_motion(elements)
    expected = [solved_position(elements, t) for t in times]
    assert_allclose(orbit.position(times), expected, rtol=ROUNDED,
                    atol=ROUNDED * elements.pericentre)


@pytest.mark.parametrize("elements", [ELLIPSE, FLYBY], ids=["ellipse", "flyby"])
def test_velocity_is_the_slope_and_gravity_its_slope(elements):
    orbit = KeplerOrbit(elements)
    t = 4.3 / mean_motion(elements) / 10
    step = 2.0**-10 / mean_motion(elements)
    velocity = slope(orbit.position, t, step)
    size = np.linalg.norm(velocity)
    assert_allclose(orbit.velocity(t), velocity, atol=SLOPES * size)
    x = orbit.position(t)
    gravity = -elements.gm * x / np.linalg.norm(x) ** 3
    assert_allclose(slope(orbit.velocity, t, step), gravity,
                    atol=SLOPES * np.linalg.norm(gravity))


def test_times_of_any_shape():
    orbit = KeplerOrbit(ELLIPSE)
    assert orbit.position(1.0).shape == (3,)
    assert orbit.position([[1.0, 2.0]]).shape == orbit([[1, 2]]).shape == (1, 2, 3)
    assert orbit.velocity(np.arange(100).reshape(4, 25)).shape == (4, 25, 3)
    assert orbit.position([]).shape == (0, 3)
    assert (orbit.position([1.0, 2.0])[1] == orbit.position(2.0)).all()
    assert np.isnan(orbit.position([math.nan, 1.0])).tolist() == [[True] * 3, [False] * 3]
    rejected(TypeError, "expected real numbers", orbit.position, "noon")


def test_an_orbit_from_a_state_goes_through_it():
    there = KeplerOrbit(ELLIPSE)
    again = KeplerOrbit.from_state(there.position(9.0), there.velocity(9.0), gm=2.0, epoch=9.0)
    assert_allclose(again.elements.eccentricity, 0.3, rtol=budgets.kepler_elements)
    assert_allclose(again.elements.pericentre, 3.0, rtol=budgets.kepler_elements)
    assert_allclose(again.position(20.0), there.position(20.0), rtol=budgets.kepler_elements)
    rejected(ValueError, "not along one line", KeplerOrbit.from_state, [1, 0, 0], [1, 0, 0], gm=1.0)
    with pytest.raises(ValueError, match=r"position: got shape \(2,\)"):
        KeplerOrbit.from_state([1, 0], [1, 0, 0], gm=1.0)


def test_sizes():
    assert semi_major_axis(ELLIPSE) == 3.0 / (1 - 0.3)
    gm = mean_motion(ELLIPSE) ** 2 * semi_major_axis(ELLIPSE) ** 3
    assert_allclose(gm, 2.0, rtol=budgets.numpy_rounding)
    assert pericentre_distance(10.0, 0.25) == 7.5
    assert semi_major_axis(FLYBY) < 0 < mean_motion(FLYBY)
    assert KeplerOrbit(ELLIPSE).mean_motion == mean_motion(ELLIPSE)
    assert KeplerOrbit(ELLIPSE).gm == 2.0


def test_the_node_of_a_sun_synchronous_orbit_turns_once_a_year():
    e = KeplerElements(gm=398600.4418, pericentre=7178.1363, eccentricity=0.0,
                       inclination=np.radians(98.6))
    rates = j2_rates(e, J2=1.08262668e-3, equatorial_radius=6378.1363)
    p = 7178.1363
    expected = -1.5 * mean_motion(e) * 1.08262668e-3 * (6378.1363 / p) ** 2 * np.cos(e.inclination)
    assert_allclose(rates.node, expected, rtol=budgets.numpy_rounding)
    orbit = PrecessingKeplerOrbit(e, rates)
    assert orbit.rates == rates and orbit.elements == e and orbit.gm == e.gm
    year = 365.2422 * 86400.0
    assert abs(np.degrees(rates.node * year) - 360.0) < 0.5
    # at any time it is an orbit whose three angles have turned
    turned = KeplerElements(e.gm, p, 0.0, e.inclination, rates.node * year,
                            rates.argument * year, rates.mean_anomaly * year)
    assert_allclose(orbit.position(year), KeplerOrbit(turned).position(year),
                    atol=ROUNDED * p)
    rejected(ValueError, "j2_rates", j2_rates, FLYBY, 1e-3, 1.0)


def test_an_orbit_from_a_state_about_the_earth_keeps_its_place():
    gm, J2, R, step = 398600.4418, 1.08262668e-3, 6378.1363, 20.0

    def rates(y):
        x, r = y[:3], np.linalg.norm(y[:3])
        s = 5.0 * (x[2] / r) ** 2
        k = 1.5 * J2 * gm * R**2 / r**5
        return np.append(y[3:], -gm / r**3 * x - k * np.array([1.0 - s, 1.0 - s, 3.0 - s]) * x)

    speed = math.sqrt(gm / 7144.5)
    y = np.array([7144.5, 0, 0, 0, -0.139 * speed, 0.990 * speed])
    state = KeplerOrbit.from_state(y[:3], y[3:], gm)
    e = mean_elements(state.elements, J2=J2, equatorial_radius=R)
    assert e.eccentricity == state.elements.eccentricity
    for _ in range(4320):  # a day
        a = rates(y)
        b = rates(y + 0.5 * step * a)
        c = rates(y + 0.5 * step * b)
        d = rates(y + step * c)
        y = y + step / 6.0 * (a + 2.0 * b + 2.0 * c + d)

    def missed(elements):
        orbit = PrecessingKeplerOrbit(elements, j2_rates(elements, J2, R))
        return np.linalg.norm(orbit.position(86400.0) - y[:3])

    assert missed(e) < budgets.j2_low_orbit_km
    assert missed(state.elements) > 10 * budgets.j2_low_orbit_km
    rejected(ValueError, "mean_elements", mean_elements, FLYBY, 1e-3, 1.0)


def test_precessing_velocity_is_the_slope_of_position():
    orbit = PrecessingKeplerOrbit(ELLIPSE, SecularRates(node=0.05, argument=-0.1))
    assert_allclose(orbit.velocity(2.0), slope(orbit.position, 2.0), rtol=SLOPES)


def test_tilt_and_eccentricity_change():
    """The ellipse of each instant: its own elements, the axis kept."""
    rates = SecularRates(0.01, 0.02, 0.03, inclination=0.04, eccentricity=0.005)
    orbit = PrecessingKeplerOrbit(ELLIPSE, rates)
    e, n = ELLIPSE, polhode.satellites.mean_motion(ELLIPSE)
    for t in (0.0, 3.0, 21.5):
        age, now = t - e.epoch, e.eccentricity + 0.005 * (t - e.epoch)
        there = KeplerElements(
            e.gm, polhode.satellites.pericentre_distance(
                polhode.satellites.semi_major_axis(e), now
            ), now,
            e.inclination + 0.04 * age, e.node + 0.01 * age, e.argument + 0.02 * age,
            e.mean_anomaly + (n + 0.03) * age, t,
        )  # fmt: skip
        assert_allclose(orbit.position(t), KeplerOrbit(there).position(t), rtol=ROUNDED)
        assert_allclose(orbit.velocity(t), slope(orbit.position, t), atol=SLOPES)
        # the rates are in the velocity, and so it is not that of the ellipse
        assert np.linalg.norm(orbit.velocity(t) - KeplerOrbit(there).velocity(t)) > 1e-3
    assert orbit.last_time == e.epoch + (1 - e.eccentricity) / 0.005
    assert np.isnan(orbit.position(orbit.last_time + 1)).all()
    assert orbit.first_time == e.epoch - e.eccentricity / 0.005
    with pytest.raises(polhode.DomainError, match="of the eccentricity 0.1 must be 0 for a hyper"):
        PrecessingKeplerOrbit(FLYBY, SecularRates(eccentricity=0.1))


@pytest.mark.parametrize("orbit", [KeplerOrbit(ELLIPSE),
                                   PrecessingKeplerOrbit(ELLIPSE, SecularRates(0.01, 0.02, 0.03)),
                                   PrecessingKeplerOrbit(ELLIPSE, SecularRates(
                                       inclination=0.1, eccentricity=-0.01))])
def test_a_dual_time_carries_the_velocity(orbit):
    moved = orbit.position(Dual(2.5, [1.0]))
    assert [x.value for x in moved] == orbit.position(2.5).tolist()
    velocity = [x.derivative[0] for x in moved]
    assert_allclose(velocity, orbit.velocity(2.5), rtol=budgets.numpy_rounding)


def test_a_dual_velocity_is_gravity():
    orbit = KeplerOrbit(ELLIPSE)
    x = orbit.position(2.5)
    change = [v.derivative[0] for v in orbit.velocity(Dual(2.5, [1.0]))]
    assert_allclose(change, -2.0 * x / np.linalg.norm(x) ** 3, rtol=ROUNDED)
    with pytest.raises(TypeError, match="second derivative"):
        PrecessingKeplerOrbit(ELLIPSE, SecularRates()).velocity(Dual(2.5, [1.0]))


@pytest.mark.parametrize(("change", "message"), [
    ({"gm": 0.0}, "gm"),
    ({"pericentre": -1.0}, "pericentre"),
    ({"eccentricity": 1.0}, "eccentricity"),
    ({"eccentricity": -0.1}, "eccentricity"),
    ({"node": math.nan}, "node"),
])
def test_elements_of_no_orbit(change, message):
    good = {"gm": 1.0, "pericentre": 1.0, "eccentricity": 0.1}
    rejected(polhode.DomainError, message, KeplerElements, **{**good, **change})


VALUES = [ELLIPSE, SecularRates(0.1, 0.2, 0.3), KeplerOrbit(ELLIPSE),
          PrecessingKeplerOrbit(ELLIPSE, SecularRates(0.1)), SecularRates(inclination=0.1),
          PrecessingKeplerOrbit(ELLIPSE, SecularRates(eccentricity=0.1))]


@pytest.mark.parametrize("value", VALUES, ids=lambda v: type(v).__name__)
def test_values_compare_copy_and_pickle(value):
    again = pickle.loads(pickle.dumps(value))
    assert again == value and hash(again) == hash(value) and again is not value
    assert copy.copy(value) == value == copy.deepcopy(value)
    assert eval(repr(value), {**PUBLIC}) == value
    assert value != 1 and value != KeplerOrbit(FLYBY)
