# SPDX-License-Identifier: MIT
"""Charts of dual states: perturbations written in Andoyer variables and other charts."""

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import AndoyerState, to_andoyer, to_euler, to_poincare, to_rotor
from polhode.charts import Pole

BODY = polhode.Body(3, 4, 6)
STATE = polhode.rotor_state(BODY, [0.5, -0.7, 0.3, 0.4], [0.4, -0.2, 0.35])


def of_charts(convert):
    """H' = 0.01 G sin^2 J cos 2l + 0.02 H, written in the Andoyer variables of `convert`(s)."""

    def energy(t, s):
        a = convert(s)
        return 0.01 * (a.G - a.L**2 / a.G) * np.cos(2 * a.l) + 0.02 * a.H

    return polhode.System(BODY, terms=[polhode.HamiltonianTerm(energy)])


def by_hand(t, s):
    """The same in q and g: G sin^2 J cos 2l = (g2^2 - g1^2) / G."""
    g = s.g
    G = np.sqrt(g @ g)
    return 0.01 * (g[1] ** 2 - g[0] ** 2) / G + 0.02 * (
        polhode.charts.attitude_matrix(s.q).T @ g
    )[2]


@pytest.mark.parametrize("convert", [
    to_andoyer,
    lambda s: to_andoyer(to_rotor(to_euler(s))),
    lambda s: to_andoyer(to_rotor(to_poincare(s, Pole.zero, "pi"))),
    lambda s: to_andoyer(to_rotor(AndoyerState(*(getattr(to_andoyer(s), x) for x in "lghLGH")))),
    lambda s: to_andoyer(to_rotor(BODY, polhode.charts.to_euler_rates(BODY, s))),
    lambda s: to_andoyer(polhode.RotorState(s.q, s.g)),
    lambda s: to_andoyer(to_rotor(BODY, polhode.to_sadov(BODY, s))),
    lambda s: to_andoyer(to_rotor(BODY, polhode.to_serret(BODY, s, 0.3), 0.3)),
])
def test_an_energy_in_any_chart(convert):
    system = of_charts(convert)
    expected = polhode.System(BODY, terms=[polhode.HamiltonianTerm(by_hand)])
    for name in ("v", "u"):
        assert_allclose(getattr(polhode.rates.effect(system, 0.0, STATE), name),
                        getattr(polhode.rates.effect(expected, 0.0, STATE), name),
                        atol=budgets.element_maps)
    assert polhode.energy(system, 0.0, STATE) == pytest.approx(
        polhode.energy(expected, 0.0, STATE), abs=budgets.element_maps)


def test_runs_and_second_derivatives():
    system = of_charts(to_andoyer)
    expected = polhode.System(BODY, terms=[polhode.HamiltonianTerm(by_hand)])
    ends = [polhode.integrate(polhode.Problem(of, STATE, 0.0, 5.0)).at(5.0)
            for of in (system, expected)]
    assert_allclose(ends[0].g, ends[1].g, atol=budgets.orbital_differences)
    canonical = [polhode.charts.canonical_state(of, 0.0, STATE).g for of in (system, expected)]
    assert_allclose(canonical[0], canonical[1], atol=budgets.element_maps)


def test_canonical_sets_in_one_line():
    z = to_andoyer(STATE)
    z = [z.l, z.g, z.h, z.L, z.G, z.H]
    assert polhode.charts.canonical_defect(
        lambda z: to_rotor(AndoyerState(*z)), z
    ) < budgets.element_maps
    system = polhode.System(BODY, polhode.Frame.precessing([0.6, 0, 0.8], 0.05))
    rates = polhode.rates.equations_of_motion(system, 0.0, z, lambda z: to_rotor(AndoyerState(*z)))
    assert_allclose(rates, polhode.rates.element_rates(system, 0.0, AndoyerState(*z)),
                    atol=budgets.element_maps)


def test_serrets_and_sadovs_elements():
    """First derivatives in double by the Jacobian of the set."""
    energy = polhode.HamiltonianTerm(lambda t, s: 0.1 * polhode.to_serret(BODY, s).T)
    w = polhode.angular_velocity(BODY, STATE)
    assert_allclose(polhode.rates.effect(
        polhode.System(BODY, terms=[energy]), 0.0, STATE
    ).v, 0.1 * w,
                    atol=budgets.element_maps)
    system = polhode.System(BODY, polhode.Frame.precessing([0.6, 0, 0.8], 0.05))
    sadov = polhode.to_sadov(BODY, STATE)
    names = ("phi_l", "phi_g", "phi_h", "I_l", "I_g", "I_h")
    z = [getattr(sadov, name) for name in names]
    last = {"region": sadov.region, "lobe": sadov.lobe}
    rates = polhode.rates.equations_of_motion(
        system, 0.0, z, lambda z: to_rotor(BODY, polhode.SadovState(*z, **last)))
    assert_allclose(
        rates, polhode.rates.element_rates(system, 0.0, sadov), atol=budgets.dual_jacobian
    )
    with pytest.raises(TypeError, match="first derivatives in double only"):
        polhode.charts.canonical_state(polhode.System(BODY, terms=[energy]), 0.0, STATE)


def test_functions_of_dual_states():
    seen = {}

    def energy(t, s):
        if isinstance(s, polhode.types.DualState):
            seen.update(chart=s.chart, names=dir(s), text=repr(to_andoyer(s)))
            with pytest.raises(AttributeError, match='has no "omega"'):
                assert s.omega
        w = polhode.angular_velocity(BODY, s)
        return polhode.kinetic_energy(BODY, s) * 1e-3 + (w @ w) * 1e-3 + (
            polhode.charts.inertial_momentum(s) @ [0, 0, 1e-3])

    def expected(t, s):
        w = s.g / np.array([3.0, 4.0, 6.0])
        return (s.g @ w) * 5e-4 + (w @ w) * 1e-3 + (
            polhode.charts.attitude_matrix(s.q).T @ s.g @ [0, 0, 1e-3])

    found, known = (polhode.rates.effect(polhode.System(
        BODY, terms=[polhode.HamiltonianTerm(H)]
    ), 0.0,
                                   STATE) for H in (energy, expected))
    assert_allclose(found.v, known.v, atol=budgets.element_maps)
    assert_allclose(found.u, known.u, atol=budgets.element_maps)
    assert seen["chart"] == "RotorState" and set(seen["names"]) == {"q", "g"}
    assert seen["text"].startswith("DualState of AndoyerState(l=Dual(")


def test_what_is_no_number_is_rejected():
    def energy(t, s):
        return to_rotor(AndoyerState(s.g[0], "x", 0, 0, 1, 0)).g[0]

    system = polhode.System(BODY, terms=[polhode.HamiltonianTerm(energy)])
    with pytest.raises(TypeError):
        polhode.rates.effect(system, 0.0, STATE)
