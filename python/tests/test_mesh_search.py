# SPDX-License-Identifier: MIT
"""A given mesh and its light curves: the spin state from periods alone, from a scan on, the pole
that stays beside it, and Ctrl-C."""

import budgets
import fit_calls
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest, smallest
from interrupts import LATEST, seconds_from_signal

SUN, OBSERVER = [1.0, 0.2, 0.3], [0.7, 0.9, 0.1]


def lump(rows=7):
    """Some 170 facets, one end thick and one side flat: no half turn leaves it as it is."""
    theta = np.pi * np.arange(rows + 1) / rows
    phi = np.pi * np.arange(2 * rows) / rows
    n = np.stack([np.outer(np.sin(theta), np.cos(phi)), np.outer(np.sin(theta), np.sin(phi)),
                  np.outer(np.cos(theta), np.ones(2 * rows))], axis=-1)  # fmt: skip
    n[[0, -1], :, :2] = 0.0
    x, y, z = np.moveaxis(n, -1, 0)
    along = 1.0 + 0.25 * x
    up = np.where(z > 0.3, 0.3 + 0.4 * (z - 0.3), z)
    corners = np.stack([1.5 * x, (0.9 + 0.1 * y) * along * y, 0.8 * along * up], axis=-1)

    def at(i, j):
        return 2 * rows * i + (0 if i in (0, rows) else j % (2 * rows))

    faces = [[at(i, j), at(i + 1, j), at(i + 1, j + 1)]
             for i in range(rows - 1) for j in range(2 * rows)]  # fmt: skip
    faces += [[at(i, j), at(i + 1, j + 1), at(i, j + 1)]
              for i in range(1, rows) for j in range(2 * rows)]  # fmt: skip
    return polhode.shape.FacetShape(corners.reshape(-1, 3), faces)


@pytest.fixture(scope="module")
def night():
    """In long-axis mode, at the middle of its light curve."""
    body = polhode.light.LightModel.homogeneous([0.9, 0.1, 0.3, 0.2], [1.5, 0.6, 0.4], lump())
    motion = body.spin.free_rotation
    assert motion.regime.name == "long_axis"
    periods = ("LAM", 2.0 * np.pi / motion.precession_rate_long, motion.polhode_period)
    t = np.linspace(-4.0, 4.0, 140) * periods[1]
    (flux,) = polhode.light.model_fluxes(
        body, polhode.light.LightCurve(t, np.ones(140), 1.0, SUN, OBSERVER)
    )
    sigma = 0.02 * flux.mean()
    seen = flux + sigma * np.random.default_rng(8).normal(size=140)
    return body, polhode.light.LightCurve(t, seen, sigma, SUN, OBSERVER), periods


def turn_between(one, other):
    part = one.spin.q @ other.spin.q / np.linalg.norm(one.spin.q) / np.linalg.norm(other.spin.q)
    return 2.0 * np.arccos(smallest(1.0, np.abs(part)))


def test_periods_are_enough(night):
    body, curve, (mode, phi, psi) = night
    # its own attitude and rate are not looked at
    known = polhode.light.LightModel.homogeneous([1.0, 0, 0, 0], [0.0, 0.0, 1.0], body.shape)
    pairs = [("LAM", phi, 0.01 * psi), (mode, 1.002 * phi, 0.998 * psi)]
    how = {"body": known, "starts": 80, "seed": 1}
    found = [polhode.light.search_light(curve, pairs, threads=n, **how) for n in (1, 3)]
    best, same = (one.solutions[0] for one in found)
    assert best.values.tobytes() == same.values.tobytes() and repr(found[0]) == repr(found[1])
    assert found[0].starts == 40 and "1 of 2 pairs" in found[0].notes[0]
    assert np.isinf(found[0].chi_square_of_periods[0])
    near = [one for one in found[0].solutions[:2]
            if turn_between(one.body, body) < budgets.mesh_found]  # fmt: skip
    assert len(near) == 1 and isinstance(near[0].body.shape, polhode.shape.FacetShape)
    off = (near[0].body.spin.w - body.spin.w) / near[0].errors[3:]
    assert largest(np.abs(off)) < budgets.mesh_off
    # the half turn about the bisector, with the same light: one night leaves two poles
    first, second = found[0].solutions[:2]
    assert second.beside == "image" and "bisector" in second.relation
    assert_allclose(first.chi_square, second.chi_square, rtol=budgets.mesh_image)
    assert first.body.shape is known.shape
    (model,) = first.model(curve)
    assert_allclose(np.sum(((model - curve.flux) / curve.sigma) ** 2), first.chi_square,
                    rtol=budgets.fit_freedom)  # fmt: skip


def test_from_a_scan_on(night):
    """No start and no period is given: the scan has both, among its labels."""
    body, curve, (_, phi, psi) = night
    lines = (0.3 / phi, 3.2 / phi)
    scan = polhode.light.fourier_scan(curve, lines, order=2, minima=5, threads=2)
    periods = scan.periods(pairs=2, labels=12)
    found = polhode.light.search_light(
        curve, periods, body=body, starts=40 * len(periods), threads=2
    )
    assert smallest(*(turn_between(one.body, body) for one in found.solutions[:2])) < (
        budgets.mesh_found
    )
    assert_allclose(found.solutions[0].precession_period, phi, rtol=budgets.labelled_period)
    assert_allclose(found.solutions[0].rotation_period, psi, rtol=budgets.labelled_period)


@pytest.mark.parametrize(("change", "error", "said"), [
    ({"body": 3}, TypeError, "search_light: got 3; expected LightModel"),
    ({"periods": []}, ValueError, "no periods"),
    ({"periods": [("SAM", 1.0, -2.0)]}, ValueError, "period -2 must be positive"),
    ({"periods": [("XAM", 1.0, 2.0)]}, ValueError, "periods: got 'XAM'"),
    ({"within": 0.5}, ValueError, "within = 0.5 must be 1 or more"),
    ({"moments": "shape"}, ValueError, "moments"),
])  # fmt: skip
def test_what_is_no_search_is_refused(change, error, said):
    keywords = {"body": fit_calls.MESH, "curves": fit_calls.CURVE, "periods": [("SAM", 10.0, 25.0)]}
    with pytest.raises(error, match=said):
        polhode.light.search_light(**{**keywords, **change})


def test_ctrl_c_ends_it(night):
    body, curve, periods = night
    call = lambda: polhode.light.search_light(curve, [periods], body=body, starts=1_000_000)  # noqa: E731
    assert seconds_from_signal(call) < LATEST
