# SPDX-License-Identifier: MIT
"""Equations of motion of elements in any gauge, from Python."""

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose

BODY = polhode.Body(3, 4, 6)
STATE = polhode.rotor_state(BODY, [0.5, -0.7, 0.3, 0.4], [0.4, -0.2, 0.35])
BENT = polhode.HamiltonianTerm(lambda t, s: 0.002 * (s.q @ s.q) * s.g[0] * s.g[1] * s.g[2])
SYSTEM = polhode.System(BODY, polhode.Frame.precessing([0.6, 0, 0.8], 0.05), [BENT])
SETS = ("andoyer", "fukushima-ishizaki", "serret", "sadov")


def general(C, t):
    return [0.02 * np.sin(C[0] + 0.3 * t) * C[4], 0.01 * C[3], 0.015 * np.sin(C[2]) * C[5]]


@pytest.mark.parametrize("gauge", ["canonical", "osculating", general])
@pytest.mark.parametrize("chosen", SETS)
def test_elements_and_states_go_there_and_back(chosen, gauge):
    elements = polhode.charts.elements_of_state(SYSTEM, 0.4, STATE, chosen, gauge)
    back = polhode.charts.element_state(SYSTEM, 0.4, elements, gauge)
    assert_allclose(back.g, STATE.g, atol=budgets.element_maps)
    free = polhode.charts.element_state(polhode.System(BODY), 0.4, elements)
    rate = polhode.angular_velocity(BODY, free)
    phi = polhode.rates.element_convective_term(SYSTEM, 0.4, elements, gauge)
    assert_allclose(rate + phi, polhode.angular_velocity(SYSTEM, 0.4, STATE).relative,
                    atol=budgets.element_maps)


def test_canonical_elements_have_the_canonical_rates():
    expected = polhode.rates.canonical_rates(SYSTEM, 0.4, STATE, "andoyer")
    assert_allclose(polhode.rates.element_rates(SYSTEM, 0.4, polhode.to_andoyer(STATE)), expected,
                    atol=budgets.element_maps)
    modified = polhode.charts.elements_of_state(SYSTEM, 0.4, STATE, "fukushima-ishizaki", t0=0.1)
    known = polhode.rates.modified_andoyer_rates(SYSTEM, 0.4, STATE, 0.1)
    expected = [getattr(known, name) for name in ("l", "g", "h", "L", "G", "H")]
    assert_allclose(polhode.rates.element_rates(SYSTEM, 0.4, modified), expected,
                    atol=budgets.element_maps)


@pytest.mark.parametrize("chosen", SETS)
def test_no_convective_term_is_the_osculating_gauge(chosen):
    elements = polhode.charts.elements_of_state(SYSTEM, 0.4, STATE, chosen, "osculating")
    assert_allclose(polhode.rates.element_rates(SYSTEM, 0.4, elements, lambda C, t: [0, 0, 0]),
                    polhode.rates.element_rates(SYSTEM, 0.4, elements, "osculating"),
                    atol=budgets.element_maps)


def test_many_at_once():
    motion = polhode.FreeRotation(BODY, STATE)
    states = motion.at(np.linspace(0, 3, 6).reshape(2, 3))
    elements = polhode.charts.elements_of_state(SYSTEM, 0.4, states, "andoyer", "osculating")
    rates = polhode.rates.element_rates(SYSTEM, 0.4, elements, "osculating")
    assert rates.shape == (2, 3, 6)
    np.testing.assert_array_equal(
        rates[1, 2], polhode.rates.element_rates(SYSTEM, 0.4, elements[1, 2], "osculating"))


def test_what_is_no_gauge_is_rejected():
    elements = polhode.to_andoyer(STATE)
    with pytest.raises(ValueError, match='got "tangent"; expected "canonical", "osculating" or'):
        polhode.rates.element_rates(SYSTEM, 0.0, elements, "tangent")
    with pytest.raises(TypeError, match="gauge"):
        polhode.rates.element_rates(SYSTEM, 0.0, elements, 7)
    with pytest.raises((TypeError, ValueError), match="3 numbers, the convective term"):
        polhode.rates.element_rates(SYSTEM, 0.0, elements, lambda C, t: [C[0], t])
    with pytest.raises(ValueError, match='expected "andoyer", "fukushima-ishizaki", '):
        polhode.charts.elements_of_state(SYSTEM, 0.0, STATE, "euler")
    upright = polhode.RotorState([1, 0, 0, 0], [0, 0, 1])
    with pytest.raises(polhode.DomainError, match="a singularity of Andoyer's variables"):
        polhode.rates.element_rates(SYSTEM, 0.0, polhode.to_andoyer(upright))
