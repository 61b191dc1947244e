# SPDX-License-Identifier: MIT
"""Leading frequencies from Python. Oracle: sums of lines that are known."""

import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from rejections import rejected

TIMES = np.arange(3000) * 0.5 - 200.0
LINES = np.array([[0.3, 2.0, 0.4], [1.1, 0.7, -2.0], [2.5, 1e-3, 1.0]])


def signal(t):
    return sum(a * np.exp(1j * (nu * t + phase)) for nu, a, phase in LINES)


@pytest.mark.parametrize("part", [np.real, lambda x: x])
def test_lines_of_real_and_complex_values(part):
    found = polhode.analysis.spectrum(part(signal(TIMES)), 0.5, TIMES[0])
    assert len(found) == 3 and found.frequency.shape == (3,)
    assert_allclose(found.frequency, LINES[:, 0], atol=budgets.spectrum_python)
    assert_allclose(found.amplitude, LINES[:, 1], atol=budgets.spectrum_amplitude)
    assert_allclose(found.phase, LINES[:, 2], atol=budgets.spectrum_phase)
    assert found.residual < budgets.spectrum_amplitude < found.size
    assert repr(found).startswith("<Spectrum: 3 lines, residual ")
    again = pickle.loads(pickle.dumps(found))
    assert_allclose(again.frequency, found.frequency, atol=0)
    assert again.resolution == found.resolution < found.isolation.min()


def test_close_lines_warn():
    close = np.cos(0.3 * TIMES) + np.cos(0.31 * TIMES)
    with pytest.warns(RuntimeWarning, match="10 turns over the samples"):
        found = polhode.analysis.spectrum(close, 0.5, lines=2)
    assert (found.isolation < found.resolution).all()


@pytest.mark.parametrize(("arguments", "message"), [
    ({"values": np.zeros((3, 3)), "interval": 1.0}, r"got shape \(3, 3\); expected \(N,\)"),
    ({"values": np.full(50, np.nan), "interval": 1.0, "lines": 2}, "sample 0 that is not finite"),
    ({"values": np.zeros(50), "interval": -1.0, "lines": 2}, "expected a positive one"),
    ({"values": np.zeros(50), "interval": 1.0, "window": 7, "lines": 2}, "got window 7"),
])
def test_what_is_wrong_is_named(arguments, message):
    rejected(ValueError, message, polhode.analysis.spectrum, **arguments)


def test_planets_and_what_shines_on_them():
    orbit = polhode.secular.shipped_orbit("earth", year=1e-3)
    assert (orbit.first_time, orbit.last_time) == (-20e3, 20e3)
    rates = polhode.secular.planet_rates("earth", year=1e-3)
    pole = polhode.secular.planet_pole("earth")
    assert pole.shape == (3,)
    found = polhode.secular.spin_history(
        orbit, rates, pole, [0.0, -100.0], polhode.Splitting(2, "order8")
    )
    # La2004 at -100 kyr
    assert abs(np.degrees(found.obliquity[1] - 0.4130265591582125)) < budgets.shipped_orbit_100_kyr
    light = polhode.secular.daily_insolation(found.obliquity, found.pericentre, found.eccentricity,
                                     np.radians(65), np.pi / 2, 1361.0)
    assert light.shape == (2,) and abs(light[0] - 479) < 2.5  # Berger & Loutre (1991)
    assert np.isnan(polhode.secular.daily_insolation(0.4, 0.0, 0.0, 2.0, 0.0))
    for call in (
        polhode.secular.shipped_orbit, polhode.secular.planet_rates, polhode.secular.planet_pole
    ):
        rejected(ValueError, 'got "pluto"; expected earth or mars', call, "pluto")
