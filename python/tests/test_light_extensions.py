# SPDX-License-Identifier: MIT
"""Sessions of light curves that join one by one, in Python."""

import budgets
import numpy as np
import polhode
import pytest
from polhode.light import LightCurve, LightModel

# that of tests/unit/fit/light_extension.cpp
BODY = LightModel.homogeneous([0.6, 0.3, -0.5, 0.2], [2.4, 0.9, 0.3], [1.0, 0.6, 0.45])
SUN, OBSERVER = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
PERIOD = 2.0 * np.pi / BODY.spin.free_rotation.precession_rate_long


def night(begin):
    random = np.random.default_rng(int(begin))
    t = (begin + np.sort(random.uniform(0.0, 6.0, 60))) * PERIOD
    blank = LightCurve(t, np.ones(60), 1.0, SUN, OBSERVER)
    (flux,) = polhode.light.model_fluxes(BODY, blank)
    return LightCurve(t, flux * (1.0 + 0.02 * random.normal(size=60)), 0.02 * flux, SUN, OBSERVER)


NIGHTS = [night(40), night(0)]


def test_two_nights_join():
    first = polhode.light.fit_light(BODY, NIGHTS[1])
    found = polhode.light.extend_light(NIGHTS, first.body, first=1, threads=2)
    assert found.failure == "" and [one.session for one in found.joined] == [1, 0]
    assert found.joined[1].counts > 1
    assert abs(found.joined[1].distance / PERIOD - 40) < 2
    best = found.solutions[0]
    assert abs(best.precession_period - PERIOD) < 2e-4 * PERIOD
    assert best.cost == found.joined[1].cost
    assert best.cost < budgets.light_noise * best.degrees_of_freedom
    alone = polhode.light.extend_light(NIGHTS, [first.body], first=1)
    assert [s.cost for s in alone.solutions] == [s.cost for s in found.solutions]
    assert f"{len(found.solutions)} solutions of 2 sessions" in repr(found)
    assert f"P_phi {best.precession_period:.6g}" in repr(found)


@pytest.mark.parametrize("shape", [polhode.light.ConvexShape.of(BODY.shape, 2, 3), None])
def test_nights_of_other_shapes_join(shape):
    """Facets of the ellipsoid, free and with their priors; and its mesh, with the moments of the
    ellipsoid."""
    facets = shape or polhode.light.ConvexShape.of(BODY.shape, 4, 4).mesh
    body = polhode.light.LightModel(BODY.spin, facets)
    flux = polhode.light.model_fluxes(body, NIGHTS)
    nights = [LightCurve(n.t, f, 0.02 * f, SUN, OBSERVER) for n, f in zip(NIGHTS, flux)]
    found = polhode.light.extend_light(nights, body, first=1, threads=2, moments="start")
    assert found.failure == "" and found.joined[1].counts > 1
    best = found.solutions[0]
    assert best.body.kind == body.kind
    assert abs(best.precession_period - PERIOD) < 2e-4 * PERIOD
    assert best.cost < budgets.light_noise * best.degrees_of_freedom


def test_a_session_that_is_too_far_is_named():
    found = polhode.light.extend_light(NIGHTS, BODY, first=1, most_counts=1)
    assert found.solutions == [] and "session 1 is too far from those before it" in found.failure
    assert found.failure in repr(found)


@pytest.mark.parametrize(("change", "said"), [
    ({"starts": []}, "no starts"),
    ({"starts": [3]}, "starts: got 3; expected LightModel"),
    ({"first": 2}, "first = 2 must be below 2"),
    ({"within": 0.5}, "within = 0.5 must be 1 or more"),
    ({"most_counts": 0}, "most_counts"),
])
def test_what_is_no_extension_is_refused(change, said):
    given = {"curves": NIGHTS, "starts": BODY, **change}
    with pytest.raises((ValueError, TypeError), match=said):
        polhode.light.extend_light(**given)
