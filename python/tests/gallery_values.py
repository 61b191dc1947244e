# SPDX-License-Identifier: MIT
"""What is drawn in the gallery, against numbers that polhode does not make: laws of the free
rotation, SciPy's integrator, and MuJoCo's steps written in NumPy."""

import budgets
import numpy as np
from closeness import assert_allclose
from scipy.integrate import solve_ivp


def rates(moments):
    return lambda t, w: np.cross(moments * w, w) / moments


def phase_plane(axes, made):
    """Every curve is one of constant energy: 2 T / G^2 of l and L / G."""
    (ax,) = axes
    low, high = ax.get_ylim()
    assert (low, high) == (-1.0, 1.0)
    seen = 0
    for line in ax.get_lines():
        l, y = line.get_xdata() * np.pi / 2, line.get_ydata()
        if len(l) < 20:
            continue
        twice_T = (1 - y**2) * (np.sin(l) ** 2 / 3 + np.cos(l) ** 2 / 4) + y**2 / 6
        inside = np.isfinite(twice_T)
        assert np.ptp(twice_T[inside]) <= budgets.gallery_law
        seen += 1
    assert seen > 20


def time_series(axes, made):
    """A wing nut about its middle axis: the rates by SciPy, L from them."""
    moments = np.array([30.53, 83.87, 113.3])
    w0 = np.radians([0.6, 360.0, 0.0])
    momentum, rate = axes[1].get_lines()[0], axes[2].get_lines()
    t = rate[0].get_xdata()
    tolerance = budgets.oracle_tolerance
    w = solve_ivp(rates(moments), (0, t[-1]), w0, "DOP853", t_eval=t, rtol=tolerance,
                  atol=tolerance).y  # fmt: skip
    for line, mine in zip(rate, np.degrees(w), strict=True):
        assert_allclose(line.get_ydata(), mine, atol=budgets.gallery_integrated * 360)
    L = moments[2] * w[2]
    drawn = momentum.get_ydata()
    scale = drawn[np.argmax(np.abs(L))] / L[np.argmax(np.abs(L))]
    size = np.abs(drawn).max()
    assert_allclose(drawn, scale * L, atol=budgets.gallery_integrated * size)


def apophis_tumbles(axes, made):
    """The dot of each view is the end of the long axis, by SciPy, if it faces the observer."""
    moments, state, hours = made["moments"], made["state"], made["hours"]
    w, x, y, z = state.q
    columns = np.array([
        [1 - 2 * (y**2 + z**2), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x**2 + z**2), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x**2 + y**2)],
    ])  # fmt: skip

    def rate(t, s):
        turn, w = s[:9].reshape(3, 3), s[9:]
        return [*np.cross(turn, w).ravel(), *(np.cross(moments * w, w) / moments)]

    tolerance = budgets.oracle_tolerance
    start = [*columns.ravel(), *(state.g / moments)]
    motion = solve_ivp(rate, (0, hours[-1]), start, "DOP853", t_eval=hours, rtol=tolerance,
                       atol=tolerance).y  # fmt: skip
    views, seen = axes[: hours.size], 0
    for view, tip in zip(views, motion[[0, 3, 6]].T, strict=True):
        dots = view.get_lines()
        assert len(dots) == (tip @ made["observer"] > 0)
        for dot in dots:
            (drawn,) = dot.get_xydata()
            mine = [tip @ np.cross([0, 0, 1], made["observer"]), tip[2]]
            assert_allclose(drawn, mine, atol=budgets.gallery_integrated)
            seen += 1
    assert seen == 6


def energy_error(axes, made):
    """The energy in the frame of the planet by hand: T - w_z G_z + (3 x.I x - tr I) / 2."""
    moments = np.array([1.0, 1.6, 2.0])
    lines = axes[0].get_lines()
    for line, run in zip(lines, made["runs"].values(), strict=True):
        q, g = run.states.q, run.states.g
        w, x, y, z = q.T / np.linalg.norm(q, axis=1)
        to_planet = np.array([1 - 2 * (y**2 + z**2), 2 * (x * y - w * z), 2 * (x * z + w * y)])
        up = np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x**2 + y**2)])
        E = (g**2 / moments).sum(1) / 2 - (up * g.T).sum(0)
        E += (3 * (to_planet.T**2 * moments).sum(1) - moments.sum()) / 2
        error = np.abs(E / E[0] - 1)
        drawn = line.get_ydata()
        there = drawn > budgets.gallery_energy  # what is 0 has no place on a logarithmic axis
        assert_allclose(drawn[there], error[-len(drawn) :][there], atol=budgets.gallery_energy)
        assert np.isfinite(error).all() and there.any()


def mujoco_drift(axes, made):
    """MuJoCo's semi-implicit Euler in NumPy: rates by the torque of the old ones, then attitude."""
    for case in made["cases"]:
        moments, w = case.moments, np.array(case.omega0)
        q = case.q0 / np.linalg.norm(case.q0)
        step = 0.01
        each = round(made["STOP"] / made["ROWS"] / step)
        states = made["engine"](case, "Euler", step)[1]
        for k in range(40):
            for _ in range(each):
                w = w + step * np.cross(moments * w, w) / moments
                angle = step * np.linalg.norm(w)
                turn = np.append(np.cos(angle / 2), np.sin(angle / 2) * w / np.linalg.norm(w))
                q = product(q, turn)
            assert_allclose(states.g[k] / moments, w, atol=budgets.gallery_law)
            assert_allclose(states.q[k], q, atol=budgets.gallery_law)


def product(a, b):
    scalar = a[0] * b[0] - a[1:] @ b[1:]
    return np.append(scalar, a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))


def andoyer_section(axes, made):
    """Every point is on the level of the energy, its G by hand, and between the poles."""
    point = made["chaotic"]
    moments = np.array([1.0, 1.6, 2.0])
    states = point.states
    q, g = states.q, states.g
    w, x, y, z = q.T / np.linalg.norm(q, axis=1)
    E = (g**2 / moments).sum(1) / 2 - 0.3 * 2 * (x * z - w * y)
    assert_allclose(E, made["E"], atol=budgets.gallery_run)


def ensemble_fan(axes, made):
    """Quantiles of the pitch of all draws by SciPy: I2 y'' = -3 n^2 (I1 - I3) sin y cos y."""
    results = made["results"]
    (rates_drawn,) = results.drawn.values()
    n2 = 398600.4418 * 3600**2 / 7178.137**3
    strength = 3 * n2 * (100 - 20) / 110

    def motion(t, y):
        pitch, rate = y.reshape(2, -1)
        return np.concatenate([rate, -strength * np.sin(pitch) * np.cos(pitch)])

    start = np.concatenate([np.zeros(results.size), np.radians(rates_drawn)])
    t, tolerance = results["t"], budgets.oracle_tolerance
    y = solve_ivp(motion, (0, t[-1]), start, "DOP853", t_eval=t, rtol=tolerance, atol=tolerance).y
    pitch = np.degrees(y[: results.size])
    for p, numbers in results.quantiles("pitch").items():
        mine = np.quantile(pitch, p, axis=0)
        assert_allclose(numbers, mine, atol=budgets.gallery_integrated * 90)
    (median,) = (line for line in axes[0].get_lines())
    mine = np.median(pitch, axis=0)
    assert_allclose(median.get_ydata(), mine, atol=budgets.gallery_integrated * 90)


CHECKS = {
    "apophis_tumbles": apophis_tumbles,
    "ensemble_fan": ensemble_fan,
    "phase_plane": phase_plane,
    "time_series": time_series,
    "energy_error": energy_error,
    "mujoco_drift": mujoco_drift,
    "andoyer_section": andoyer_section,
}
