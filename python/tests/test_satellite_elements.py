# SPDX-License-Identifier: MIT
"""Satellites of a precessing planet and their elements in any gauge, from Python."""

import copy
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose

GM, J2, RADIUS = 1.3, 2e-3, 0.8
START = polhode.satellites.SatelliteState([1.1, -0.2, 0.4], [0.1, 0.9, 0.35])


def bent(t, r, p):
    """dH'/dp is quadratic in p and depends on time."""
    return 0.002 * p[0] * p[1] * p[2] + 0.004 * np.cos(0.7 * t) * p[0] * r[1]


def general(C, t):
    return [0.002 * np.sin(C[0] + 0.3 * t) * C[4], 0.001 * C[3], 0.0015 * np.sin(C[2]) * C[5]]


SYSTEM = polhode.satellites.SatelliteSystem(
    GM, polhode.Frame.precessing([0.36, 0.48, 0.8], 0.03),
    [polhode.OrbitalPerturbation.oblateness(GM, J2, RADIUS), polhode.OrbitalPerturbation(bent)])
SETS = ("delaunay", "keplerian")


@pytest.mark.parametrize("gauge", ["canonical", "osculating", general])
@pytest.mark.parametrize("chosen", SETS)
def test_elements_and_states_go_there_and_back(chosen, gauge):
    C = polhode.charts.elements_of_state(SYSTEM, 0.4, START, chosen, gauge)
    back = polhode.charts.element_state(SYSTEM, 0.4, C, gauge, chosen)
    assert_allclose(back.r, START.r, atol=budgets.element_maps)
    assert_allclose(back.p, START.p, atol=budgets.element_maps)
    velocity = polhode.satellites.satellite_rates(SYSTEM, 0.4, START)[:3]
    free = polhode.charts.element_state(
        polhode.satellites.SatelliteSystem(GM), 0.4, C, chart=chosen
    ).p
    phi = polhode.rates.element_convective_term(SYSTEM, 0.4, C, gauge, chosen)
    assert_allclose(free + phi, velocity, atol=budgets.element_maps)


@pytest.mark.parametrize("gauge", ["canonical", "osculating"])
def test_rates_are_those_along_a_path(gauge):
    h = 1e-3
    path = polhode.satellites.satellite_path(SYSTEM, START, 0.0, 1.0)
    elements = polhode.charts.elements_of_state(
        SYSTEM, [0.5 - h, 0.5 + h], path.at([0.5 - h, 0.5 + h]), "keplerian", gauge)
    here = polhode.charts.elements_of_state(SYSTEM, 0.5, path.at(0.5), "keplerian", gauge)
    rates = polhode.rates.element_rates(SYSTEM, 0.5, here, gauge, "keplerian")
    assert_allclose(rates, (elements[1] - elements[0]) / (2 * h), atol=budgets.orbital_differences)


def test_energy_is_constant_and_arrays_broadcast():
    system = polhode.satellites.SatelliteSystem(GM, SYSTEM.frame, SYSTEM.terms[:1])
    path = polhode.satellites.satellite_path(system, START, 0.0, 20.0)
    assert path.outcome.ok and (path.start, path.stop) == (0.0, 20.0)
    states = path.at(np.linspace(0, 20, 6).reshape(2, 3))
    assert_allclose(polhode.energy(system, 0.0, states), polhode.energy(system, 0.0, START),
                    atol=budgets.element_maps)
    C = polhode.charts.elements_of_state(system, 0.0, states, "delaunay")
    assert C.shape == (2, 3, 6)
    rates = polhode.rates.element_rates(system, 0.0, C)
    np.testing.assert_array_equal(rates[1, 2], polhode.rates.element_rates(system, 0.0, C[1, 2]))


def test_systems_are_values():
    oblate = polhode.OrbitalPerturbation.oblateness(GM, J2, RADIUS)
    system = polhode.satellites.SatelliteSystem(GM, polhode.Frame.inertial(), [oblate])
    for again in (pickle.loads(pickle.dumps(system)), copy.deepcopy(system)):
        assert again == system and hash(again) == hash(system)
    assert system.gm == GM and system.terms == (oblate,) and system.frame.is_inertial
    assert "oblateness" in repr(system)


@pytest.mark.parametrize(("call", "message"), [
    (lambda: polhode.satellites.SatelliteSystem(-1.0), "got gm = -1"),
    (lambda: polhode.OrbitalPerturbation.oblateness(1.0, 1e-3, -2.0), "radius > 0"),
    (lambda: polhode.rates.element_rates(SYSTEM, 0.0, [0.1, 0.2, 0.3, 1, 1, 0.5]),
     "a singularity of Delaunay's elements"),
    (lambda: polhode.rates.element_rates(SYSTEM, 0.0, [1, 1.5, 0.3, 1, 1, 0.5], chart="keplerian"),
     "not a bound orbit"),
    (lambda: polhode.charts.elements_of_state(SYSTEM, 0.0, START, "andoyer"),
     'expected "delaunay" or "keplerian"'),
    (lambda: polhode.satellites.SatelliteState(
        [1, 2, np.nan], [0, 0, 1]
    ), "expected finite numbers"),
])
def test_bad_input_is_rejected(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_a_perturbation_returns_a_number():
    bad = polhode.satellites.SatelliteSystem(
        GM, terms=[polhode.OrbitalPerturbation(lambda t, r, p: "much")]
    )
    with pytest.raises(ValueError, match="a number, the energy"):
        polhode.satellites.satellite_rates(bad, 0.0, START)
    with pytest.raises(TypeError, match="expected OrbitalPerturbation"):
        polhode.satellites.SatelliteSystem(GM, terms=[bent])
