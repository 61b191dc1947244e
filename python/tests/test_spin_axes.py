# SPDX-License-Identifier: MIT
"""Spin axes over ages, against published obliquities of the Earth and the closed form."""

import copy
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import Splitting, secular
from polhode.secular import (
    ElementSeries,
    ElementTable,
    HistoryOrbit,
    PrecessionRates,
    TidalRates,
    spin_history,
)

DEG = np.pi / 180
ARCSEC = DEG / 3600

# The largest terms of e exp(i varpi) and sin(i/2) exp(i Omega) of the Earth: arcsec/yr, amplitude,
# deg (Laskar 1988, Astronomy and Astrophysics 198, 341).
ELLIPSE = [
    (4.248976, 0.01897001, 30.613021),
    (7.455487, 0.01631751, 199.811097),
    (17.922491, 0.01298909, 151.997510),
    (17.377742, 0.00813631, 310.028552),
    (5.568471, 0.00387047, 77.058878),
    (17.104716, 0.00255684, 36.737898),
    (17.654277, 0.00224715, 38.339829),
    (6.922888, 0.00199607, 143.317597),
    (16.833084, 0.00183885, 110.602530),
    (27.960642, 0.00152836, 126.426025),
    (17.329172, 0.00133092, 287.612479),
    (17.826517, 0.00131928, 87.910250),
]
PLANE = [
    (0.000000, 0.01377224, 107.584264),
    (-18.850133, 0.00798880, 245.275610),
    (-5.604358, 0.00515448, 17.092978),
    (-17.761344, 0.00402485, 286.939567),
    (-7.052737, 0.00284848, 143.691432),
    (-18.304928, 0.00268489, 263.476756),
    (-6.962954, 0.00224745, 311.907333),
    (-5.513825, 0.00170037, 8.033427),
    (-7.004642, 0.00154555, 119.415527),
    (-7.150155, 0.00146128, 332.581197),
    (-6.861649, 0.00139612, 303.906805),
    (-19.393984, 0.00136764, 41.333570),
    (-26.330042, 0.00133576, 127.730350),
    (-7.190984, 0.00097416, 302.731053),
    (-19.123718, 0.00096140, 149.577002),
    (-2.985806, 0.00089461, 142.209681),
]
# kyr from J2000: e, obliquity (rad), perihelion from the moving equinox (rad): Laskar et al. 2004.
LA2004 = {0: (0.01670236225, 0.4090928042, 1.7962569912),
          -10: (0.01942460867, 0.4229058544, 5.1533728223),
          -20: (0.01900267226, 0.4036773689, 2.2983901715),
          -50: (0.01460015175, 0.4260582941, 0.8368973314),
          -100: (0.04006000254, 0.4130265592, 6.2669563057)}
# K0 and the Moon's part of it of Zeebe and Lourens (2022), per kyr.
RATES = PrecessionRates(17.369637 * ARCSEC * 1e3, 17.369637 * 2.161213 * ARCSEC * 1e3)
POLE = [0.0, np.sin(23.4392911111 * DEG), np.cos(23.4392911111 * DEG)]


def earth():
    scale = [ARCSEC * 1e3, 1.0, DEG]
    return ElementSeries(np.array(ELLIPSE) * scale, np.array(PLANE) * scale)


def test_the_obliquity_of_the_earth_is_the_published_one():
    times = np.array(list(LA2004), float)
    found = spin_history(earth(), RATES, POLE, times, Splitting(1.0, "order8"))
    e, obliquity, pericentre = np.transpose(list(LA2004.values()))
    assert found.t.tolist() == times.tolist() and found.outcome.ok
    assert_allclose(found.obliquity, obliquity, rtol=0, atol=budgets.la2004_obliquity)
    assert_allclose(found.climatic_precession, e * np.sin(pericentre), rtol=0,
                    atol=budgets.la2004_climatic)
    assert_allclose(found.eccentricity, e, rtol=0, atol=budgets.la2004_climatic)


def test_methods_and_tables_agree():
    series = earth()
    times = np.linspace(0.0, -1000.0, 11)
    exact = spin_history(series, RATES, POLE, times, polhode.Adaptive(1e-14))
    fast = spin_history(series, RATES, POLE, times, Splitting(2.5, "order8"))
    swept = spin_history(series, RATES, POLE, times, polhode.Collocation(1e-13))
    assert_allclose(swept.s, exact.s, rtol=0, atol=budgets.spin_methods)
    assert_allclose(fast.s, exact.s, rtol=0, atol=budgets.spin_methods)
    assert_allclose(np.linalg.norm(fast.s, axis=1), 1.0, rtol=0, atol=budgets.spin_length)
    rows = np.arange(-1020.0, 21.0)
    z = sum(a * np.exp(1j * (f * ARCSEC * 1e3 * rows + p * DEG)) for f, a, p in ELLIPSE)
    w = sum(a * np.exp(1j * (f * ARCSEC * 1e3 * rows + p * DEG)) for f, a, p in PLANE)
    table = ElementTable(rows, np.abs(z), 2 * np.arcsin(np.abs(w)), np.angle(w),
                         np.angle(z) - np.angle(w))
    assert (table.first_time, table.last_time) == (-1020.0, 20.0)
    of_table = spin_history(table, RATES, POLE, times, Splitting(2.5, "order8"))
    assert_allclose(of_table.s, exact.s, rtol=0, atol=budgets.spin_methods)
    assert_allclose(of_table.pericentre, exact.pericentre, rtol=0, atol=budgets.spin_methods)


def test_a_rate_that_was_observed_is_that_of_the_motion():
    """Of the equinox, over a moment; geodetic precession apart."""
    e, tilt = 0.3, 0.4
    still = ElementSeries([[0.0, e, 0.0]], [[0.0, 0.0, 0.0]])
    rates = secular.rates_of_precession(2.0, tilt, e, 1.5)
    assert rates.satellites == 1.5 * rates.star
    found = spin_history(still, rates, [0, np.sin(tilt), np.cos(tilt)], [0.0, 0.5])
    assert_allclose(found.precession[1], 1.0, rtol=0, atol=budgets.spin_methods)


def test_on_a_circle_that_stays_the_equinox_goes_back_evenly():
    still = ElementSeries([[0.0, 0.0, 0.0]], [[0.0, 0.0, 0.0]])
    tilt, rates = 0.4, PrecessionRates(2.0, 1.0, geodetic=0.3)
    found = spin_history(still, rates, [0, np.sin(tilt), np.cos(tilt)], [0.0, 0.5, 1.0])
    assert_allclose(found.precession, (3.0 * np.cos(tilt) - 0.3) * found.t, rtol=0,
                    atol=budgets.spin_methods)
    assert_allclose(found.obliquity, tilt, rtol=0, atol=budgets.spin_methods)
    upright = spin_history(still, rates, [0, 0, 3.0], [1.0])
    assert upright.obliquity.tolist() == [0.0] and np.isnan(upright.precession).all()


def test_it_is_pickled_and_shown():
    found = spin_history(earth(), RATES, POLE, [0.0, 1.0], Splitting(0.5))
    again = pickle.loads(pickle.dumps(found))
    assert again.s.tobytes() == found.s.tobytes() and len(again) == 2
    assert repr(found) == "<SpinHistory: 2 samples; splitting ABA864, step 0.5>"
    assert repr(RATES).startswith("PrecessionRates(star=") and "drift" not in repr(RATES)


def round_the_star():
    return HistoryOrbit(secular.shipped_orbit("mars"), 4 * np.pi**2, 1.5237, 0.3)


def test_a_table_that_ends_ends_the_run():
    rows = np.arange(0.0, 30.0)
    table = ElementTable(rows, 0.01, 0.02, 0.3, 0.4 + 0.001 * rows)
    with pytest.warns(RuntimeWarning, match="does what it depends on end there"):
        found = spin_history(table, RATES, POLE, [10.0, 20.0, 40.0], Splitting(1.0))
    assert found.t.tolist()[:2] == [10.0, 20.0] and not found.outcome.ok


@pytest.mark.parametrize("call, what", [
    (lambda: ElementTable([0, 1, 1, 2], 0.1, 0.1, 0.1, 0.1), "row 2: got time 1 after 1"),
    (lambda: ElementTable([0, 1, 2, 3], [0.1, 1.2, 0.1, 0.1], 0, 0, 0), "eccentricity 1.2"),
    (lambda: ElementTable(0.0, 0.1, 0.1, 0.1, 0.1), r"got shape \(\); expected columns"),
    (lambda: ElementSeries([[0, 1.5, 0]], [[0, 0.1, 0]]), "amplitudes that add up to 1.5"),
    (lambda: spin_history(earth(), RATES, [0, 0, 0], [1.0]), "direction of length 0"),
    (lambda: spin_history(earth(), RATES, POLE, []), "times: got none"),
    (lambda: spin_history(earth(), RATES, POLE, [-1.0, 1.0]), "on two sides of the epoch 0"),
    (lambda: spin_history(earth(), RATES, POLE, [-1.0, 0.0]), "running towards the epoch 0"),
    (lambda: spin_history(earth(), PrecessionRates(np.nan), POLE, [1.0]), "rates: got nan"),
    (lambda: ElementTable([0.0, 1.0, 2.0], 0.1, [0.1, 4.0, 0.1], 0.0, 0.0),
     "row 1: orbit_elements: got inclination 4"),
    (lambda: ElementTable([0.0, 1.0, 2.0, 9.0, 10.0, 11.0], 0.1, 0.1, 0.1, 0.1),
     "row 3: a gap of 7 before this row; expected a table without gaps"),
    (lambda: spin_history(ElementTable(np.arange(4.0), 0.1, 0.1, 0.1, 0.1), RATES, POLE, [5.0],
                          epoch=4.0),
     "epoch: got 4.0; expected one that the table covers, 0.0 to 3.0"),
    (lambda: spin_history(earth(), PrecessionRates(1.0, drift=-0.1), POLE, [20.0]),
     "a drift of -0.1 turns the torques round before t = 20"),
    (lambda: secular.rates_of_precession(1.0, np.pi / 2), "at an obliquity of 90 deg no rate"),
    (lambda: secular.rates_of_precession(1.0, 0.4, 1.0), r"e\^2 from 0 to below 1"),
    (lambda: spin_history(earth(), RATES, POLE, [0.0, 2.0, 1.0]), "1 comes after 2"),
    (lambda: spin_history(earth(), RATES, POLE, [1.0], tides=TidalRates(0.0, 1.0)),
     "TidalRates: spin 0 must be positive"),
    (lambda: spin_history(earth(), PrecessionRates(1.0, drift=0.1), POLE, [1.0],
                          tides=TidalRates(1.0, 1.0)),
     "expected no drift of the rates next to tides"),
    (lambda: spin_history(round_the_star(), RATES, POLE, [1.0], tides=TidalRates(1.0, 1.0)),
     "tides: expected none on a HistoryOrbit"),
    (lambda: spin_history(round_the_star(), PrecessionRates(1.0, 1.0), POLE, [1.0]),
     "expected star alone on a HistoryOrbit"),
    (lambda: HistoryOrbit(earth(), -1.0, 1.0), "HistoryOrbit: gm -1 must be positive"),
    (lambda: spin_history(earth(), RATES, POLE, [1.0], polhode.VariationOfConstants()),
     "must be Adaptive, Collocation or Splitting"),
])
def test_what_cannot_be_says_why(call, what):
    with pytest.raises(ValueError, match=what):
        call()


def test_no_method_is_named_with_who_wants_one():
    with pytest.raises(TypeError, match="spin_history: method: got int; expected Adaptive"):
        spin_history(earth(), RATES, POLE, [1.0], 3)


def test_orbits_have_copies_and_pickles():
    table = secular.shipped_orbit("mars")
    for orbit in (earth(), table):
        for other in (copy.copy(orbit), copy.deepcopy(orbit), pickle.loads(pickle.dumps(orbit))):
            assert other == orbit and not other != orbit
    assert earth() != ElementSeries([[0.0, 0.1, 0.0]], [[0.0, 0.1, 0.0]])
    assert table != secular.shipped_orbit("earth") and table != 1
    with pytest.raises(ValueError, match="its bytes are damaged"):
        ElementSeries.__new__(ElementSeries).__setstate__((b"1", b"2"))


def test_a_planet_on_an_orbit_that_changes():
    orbit = round_the_star()
    assert orbit.mean_motion == pytest.approx(2 * np.pi / 1.5237**1.5, rel=budgets.numpy_rounding)
    assert (orbit.gm, orbit.semi_major_axis, orbit.longitude) == (4 * np.pi**2, 1.5237, 0.3)
    assert orbit.elements == secular.shipped_orbit("mars")
    assert orbit.position([[0.0, 1.0]]).shape == (1, 2, 3) and orbit(0.5).shape == (3,)
    assert np.isnan(orbit.position(3e7)).all()
    again = pickle.loads(pickle.dumps(orbit))
    assert np.array_equal(again.position([1.0, 1e4]), orbit.position([1.0, 1e4]))
    system = polhode.System(polhode.Body(1, 1, 1.1), terms=[polhode.GravityGradient(orbit, 1.0)])
    assert system.terms[0].orbit.gm == orbit.gm


def test_tides_slow_the_spin_and_lift_the_moon():
    """Against the theory without them the spin and the distance change as their rates say."""
    tides = TidalRates(spin=2e3, orbit=6.0, star=1e-7, satellite=5e-7, satellite_orbit=80.0,
                       satellite_momentum=1e4)
    times = np.linspace(0.0, 1e3, 11)
    found = spin_history(earth(), RATES, POLE, times, tides=tides)
    plain = spin_history(earth(), RATES, POLE, times)
    assert (plain.spin == 1).all() and (plain.distance == 1).all()
    assert (np.diff(found.spin) < 0).all() and (np.diff(found.distance) > 0).all()
    assert found.obliquity[-1] != plain.obliquity[-1]
    split = spin_history(earth(), RATES, POLE, times, Splitting(1.0, "order8"), tides=tides)
    assert_allclose(split.s, found.s, atol=budgets.tidal_methods)
    assert_allclose(split.spin, found.spin, atol=budgets.tidal_methods)
    assert secular.tidal_rate(0.3, 2.0, 5.0, 0.1, 0.5, 0.4, 2.0) == pytest.approx(
        3 * 0.3 * 2.0 * 5.0 / 8 * 0.1 * (0.5 / 2) ** 3 / 0.4, rel=budgets.numpy_rounding)
