# SPDX-License-Identifier: MIT
"""A rigid body on a Kepler orbit under the gravity gradient, for solvers that are given equations.

States: q (w, x, y, z; body to inertial), omega (body axes), and the orbit in its plane (x, y, vx,
vy): eleven. `number` is the type of the constants: float, or numpy.longdouble for references.
"""

import numpy as np


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def body_axes(q, r):
    """The vector r in body axes."""
    w, x, y, z = q
    a, b, c = r
    return ((1.0 - 2.0 * (y * y + z * z)) * a + 2.0 * ((x * y + w * z) * b + (x * z - w * y) * c),
            (1.0 - 2.0 * (x * x + z * z)) * b + 2.0 * ((x * y - w * z) * a + (y * z + w * x) * c),
            (1.0 - 2.0 * (x * x + y * y)) * c + 2.0 * ((x * z + w * y) * a + (y * z - w * x) * b))


def kinematics(q, w, half):
    """dq/dt."""
    qw, qx, qy, qz = q
    wx, wy, wz = w
    return (-half * (qx * wx + qy * wy + qz * wz), half * (qw * wx + qy * wz - qz * wy),
            half * (qw * wy + qz * wx - qx * wz), half * (qw * wz + qx * wy - qy * wx))


def gravity_gradient(heyoka, moments, number=float):
    """The right-hand sides, for heyoka."""
    names = ("qw", "qx", "qy", "qz", "wx", "wy", "wz", "x", "y", "vx", "vy")
    state = heyoka.make_vars(*names)
    q, w, (x, y, vx, vy) = state[:4], state[4:7], state[7:]
    A, B, C = (number(m) for m in moments)
    r2 = x * x + y * y
    pull = r2 ** number(-1.5)
    k = 3.0 * pull / r2
    n = _in_plane(q, x, y)
    rates = [*kinematics(q, w, number(0.5)),
             ((B - C) / A) * (w[1] * w[2] - k * n[1] * n[2]),
             ((C - A) / B) * (w[2] * w[0] - k * n[2] * n[0]),
             ((A - B) / C) * (w[0] * w[1] - k * n[0] * n[1]),
             vx, vy, -pull * x, -pull * y]
    return list(zip(state, rates, strict=True))


def _in_plane(q, x, y):
    w, a, b, c = q
    return ((1.0 - 2.0 * (b * b + c * c)) * x + 2.0 * (a * b + w * c) * y,
            2.0 * (a * b - w * c) * x + (1.0 - 2.0 * (a * a + c * c)) * y,
            2.0 * (a * c + w * b) * x + 2.0 * (b * c - w * a) * y)


def start(rates, eccentricity, number=float):
    """The eleven numbers at pericentre, body axes along the inertial ones; gm = a = 1."""
    e = number(eccentricity)
    one = number(1)
    return [one, number(0), number(0), number(0), *(number(w) for w in rates),
            one - e, number(0), number(0), np.sqrt((one + e) / (one - e))]


def angle(q, exact):
    """The angle (rad) between two attitudes, to the last digit of the wider of them."""
    a, b = (np.asarray(x, dtype=np.longdouble) for x in (q, exact))
    a, b = a / np.sqrt((a * a).sum()), b / np.sqrt((b * b).sum())
    d = a - b if (a * b).sum() > 0 else a + b
    return float(4 * np.arcsin(np.sqrt((d * d).sum()) / 2))
