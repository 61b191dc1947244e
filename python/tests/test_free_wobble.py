# SPDX-License-Identifier: MIT
"""without_free_wobble: what is left of a motion is what the torques make of it."""

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import RotorState
from polhode.analysis import without_free_wobble

Q = [0.9, 0.1, 0.3, -0.2]
BODY = polhode.Body(1.0, 2.0, 3.0)
FREE = polhode.System(BODY)


def at_rate(*omega, body=BODY):
    return RotorState(Q, np.asarray(body.moments) * omega)


@pytest.mark.parametrize(("omega", "axis"), [
    ((0.2, 0.1, 1.0), 3), ((0.2, 0.1, -1.0), 3), ((0.8, 0.2, 1.0), 3),
    ((1.0, 0.1, 0.1), 1), ((-1.0, 0.3, 0.1), 1),
])  # fmt: skip
def test_a_free_body_is_left_in_pure_rotation(omega, axis):
    start = without_free_wobble(FREE, at_rate(*omega))
    k = axis - 1
    i, j = (k + 1) % 3, (k + 2) % 3
    moments = np.asarray(BODY.moments)
    assert start.axis == axis
    assert_allclose(start.state.q, at_rate(*omega).q, atol=0)
    assert start.state.g[k] == moments[k] * omega[k]
    assert np.abs(start.state.g[[i, j]]).max() < budgets.numpy_rounding
    # Euler's small wobble about the axis that is left
    product = (moments[k] - moments[i]) * (moments[k] - moments[j]) / (moments[i] * moments[j])
    assert_allclose(
        start.period, 2 * np.pi / (abs(omega[k]) * np.sqrt(product)), rtol=budgets.wobble_period
    )
    # the largest angle from the axis along the polhode 2 I_k T - G^2 = const
    circle = np.abs(moments[k] - moments[[i, j]]) * moments[[i, j]]
    level = circle @ np.square(omega)[[i, j]]
    widest = np.sqrt(level * moments[[i, j]] / np.abs(moments[k] - moments[[i, j]])).max()
    assert_allclose(
        np.tan(start.removed), widest / abs(moments[k] * omega[k]), rtol=budgets.wobble_period
    )


def test_nothing_is_taken_from_pure_rotation():
    start = without_free_wobble(FREE, at_rate(0, 0, 1))
    assert start.removed == 0 and start.left == 0
    assert_allclose(start.state.g, [0, 0, 3.0], atol=0)


def satellite(gm=2e-3):
    """A triaxial body that turns 22 times a revolution, its axis inclined to the orbit."""
    body = polhode.Body(1.0, 1.3, 1.7)
    orbit = polhode.KeplerOrbit(polhode.KeplerElements(gm, 1.0, 0.05, inclination=0.5))
    return polhode.System(body, terms=[polhode.GravityGradient(orbit, gm)])


def lines_at(t, y, period):
    """Amplitude at a period in y (N,), beside a cubic: plain least squares."""
    x = 2 * np.pi * t / period
    window = np.sin(np.pi * t / t[-1]) ** 2
    columns = np.column_stack([np.cos(x), np.sin(x), *(t**k / t[-1] ** k for k in range(4))])
    a = np.linalg.lstsq(window[:, None] * columns, window * y, rcond=None)[0]
    return np.hypot(a[0], a[1])


def test_a_satellite_keeps_its_forced_motion_alone():
    system = satellite()
    wobbling = [at_rate(w, 0.02, 1.0, body=system.body) for w in (0.0, 0.05)]
    found = [without_free_wobble(system, state, periods=20) for state in wobbling]
    # whatever wobble there was, the same forced path is found
    assert_allclose(found[0].state.g, found[1].state.g, atol=budgets.wobble_forced)
    assert found[1].removed > 0.02

    t = np.linspace(0, 40 * found[1].period, 8001)
    lines = []
    for state in (wobbling[1], found[1].state):
        run = polhode.integrate(polhode.Problem(system, state, 0.0, t[-1]), t, dense=False)
        lines.append(lines_at(run.t, run.g[:, 0], found[1].period))
    assert lines[1] < budgets.wobble_left * lines[0]
    assert np.abs(run.g[:, 0]).max() > 1e-4  # the forced motion is there


def test_the_figure_axis_of_the_earth_goes_on_its_forced_path():
    """Against z' = P - kappa z x P' - kappa^2 P'', the path without free motion (1/s)."""
    earth = polhode.load("examples/earth.toml")
    spin, day = 7.292115e-5, 86400.0
    moments = np.asarray(earth.body.moments)
    h, kappa = (moments[2] - moments[0]) / moments[2], moments[0] / moments[2] / spin
    z = polhode.charts.attitude_matrix(earth.initial_state.q) @ [0, 0, 1]
    tilt = np.radians(84381.448 / 3600)
    to_ecliptic = np.array([
        [1, 0, 0], [0, np.cos(tilt), np.sin(tilt)], [0, -np.sin(tilt), np.cos(tilt)]
    ])  # fmt: skip
    epoch = polhode.ephemeris.Date("TT", 2451545.0)

    def pull(seconds):
        total = np.zeros(3)
        for body in ("sun", "moon"):
            date = polhode.ephemeris.date_after(epoch, seconds)
            r = to_ecliptic @ polhode.ephemeris.planetary_position(body, "earth", date)
            gm = polhode.ephemeris.planetary_gm(body)
            total += 3 * gm * h * (r @ z) / np.linalg.norm(r) ** 5 * np.cross(r, z)
        return total / spin

    step = 7200.0
    first = (pull(step) - pull(-step)) / (2 * step)
    second = (pull(step) + pull(-step) - 2 * pull(0)) / step**2
    drift = pull(0) - kappa * np.cross(z, first) - kappa**2 * second
    forced = polhode.charts.attitude_matrix(earth.initial_state.q).T @ np.cross(z, drift)

    kicked = np.array(earth.initial_state.g)
    kicked[:2] += [1e-6, -2e-6]
    start = without_free_wobble(
        earth.system, RotorState(earth.initial_state.q, kicked), method=earth.method
    )
    rates = np.asarray(start.state.g)[:2] / moments[:2] / day
    assert_allclose(rates, forced[:2], atol=budgets.wobble_earth * np.linalg.norm(forced))
    assert_allclose(start.period, 303.6, rtol=budgets.wobble_chandler)  # Euler's period, A/(C-A)


@pytest.mark.parametrize(("state", "changed", "message"), [
    (at_rate(0, 1, 0), {}, "rotation near an axis of the largest or smallest moment"),
    (at_rate(0, 0, 0), {}, r"got omega_B = \[0.0, 0.0, 0.0\]"),
    (at_rate(0, 0, 1), {"periods": 6.5}, "whole number"),
    (at_rate(0, 0, 1), {"periods": 1}, "got periods = 1; expected a whole number, 6 or more"),
])  # fmt: skip
def test_what_has_no_wobble_is_refused(state, changed, message):
    with pytest.raises(ValueError, match=message):
        without_free_wobble(FREE, state, **changed)


def test_an_axis_of_equal_moments_is_refused():
    body = polhode.Body(1.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="no other axis shares"):
        without_free_wobble(polhode.System(body), at_rate(0, 0, 1, body=body))


def test_a_wobble_that_torques_keep_up_is_not_called_free():
    shaker = polhode.TorqueTerm(lambda t, s: [0.005 * np.cos(t), 0.0, 0.0])  # Euler's rate is 1
    with pytest.raises(ValueError, match="does not go away"):
        without_free_wobble(polhode.System(BODY, terms=[shaker]), at_rate(0.1, 0, 1))
