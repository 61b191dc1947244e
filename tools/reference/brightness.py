#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Brightness of ellipsoids by quadrature of the definition at 18 digits: S(mu, mu0) dA over what
is lit and seen. It writes tests/unit/light/typed_values.hpp."""

import pathlib
import sys

import numpy as np
from mpmath import mp, nstr, pi
from mpmath.calculus.quadrature import GaussLegendre

CASES = (  # semi-axes, to the Sun, to the observer
    ((1.0, 1.0, 1.0), (1.0, 0.0, 0.0), (0.5, 1.0, 0.25)),
    ((2.0, 1.5, 1.0), (1.0, 2.0, -0.5), (1.5, 1.0, 0.5)),
    ((2.0, 1.5, 1.0), (1.0, 2.0, -0.5), (-1.5, 1.0, 2.0)),
    ((1.0, 0.75, 2.5), (0.25, 1.0, 1.0), (0.5, 1.0, 0.75)),
    ((1.0, 0.75, 2.5), (0.25, 1.0, 1.0), (0.5, -1.0, -0.25)),
    ((1.25, 1.0, 0.875), (3.0, -1.0, 2.0), (-2.5, 1.25, -1.0)),
    ((5.0, 1.0, 1.0), (1.0, 0.25, 0.0), (1.0, -0.25, 0.5)),
)


def nodes(degree=6):
    """96 points of Gauss and Legendre on [-1, 1] and their weights; at 5 : 1 Lambert's law has 11
    digits with them, all others have 16."""
    pairs = GaussLegendre(mp).calc_nodes(degree, mp.prec)
    return [np.array([np.longdouble(nstr(p[k], 25)) for p in pairs]) for k in (0, 1)]


def unit(v):
    v = np.array(v, dtype=np.longdouble)
    return v / np.sqrt(np.sum(v * v))


def brightness(axes, to_sun, to_observer, law):
    """Over points x = A u, u on the unit sphere, where both terminators are great circles."""
    axes = np.array(axes, dtype=np.longdouble)
    s, o = unit(to_sun), unit(to_observer)
    S, O = unit(s / axes), unit(o / axes)
    pole = unit(np.cross(S, O))
    east = np.cross(pole, S)
    half_turn = np.longdouble(nstr(pi, 25))
    angle = np.arctan2(np.sum(np.cross(S, O) * pole), np.sum(S * O))
    x, w = nodes()
    half = (half_turn - angle) / 2
    longitude, latitude = (angle / 2 + half * x)[:, None, None], (half_turn / 2 * x)[:, None]
    u = np.cos(latitude) * (np.cos(longitude) * S + np.sin(longitude) * east) + np.sin(
        latitude) * pole
    gradient = u / axes
    length = np.sqrt(np.sum(gradient**2, axis=-1))
    mu, mu0 = gradient @ o / length, gradient @ s / length
    area = np.prod(axes) * length * np.cos(latitude[..., 0])
    return half * half_turn / 2 * (w @ (law(mu, mu0) * area) @ w)


TYPED = """\
// SPDX-License-Identifier: MIT
// Written by tools/reference/brightness.py: quadrature of the definition, at 18 digits.
#pragma once

#include <array>

#include "polhode/light/ellipsoid.hpp"

namespace polhode::test {

struct TypedBrightness {
  Ellipsoid body;
  Vec3 to_sun;
  Vec3 to_observer;
  double lommel_seeliger;
  double lambert;
};

// clang-format off
inline constexpr std::array<TypedBrightness, COUNT> typed_brightness{{
ROWS
}};
// clang-format on

}  // namespace polhode::test
"""


def main():
    mp.dps = 30
    lines = []
    for axes, sun, observer in CASES:
        values = (brightness(axes, sun, observer, lambda mu, mu0: mu * mu0 / (mu + mu0)),
                  brightness(axes, sun, observer, lambda mu, mu0: mu * mu0))
        vectors = ", ".join("{" + ", ".join(map(repr, v)) + "}" for v in (axes, sun, observer))
        lines.append(f"    {{{vectors},\n     {float(values[0])!r}, {float(values[1])!r}}},")
    path = pathlib.Path(__file__).resolve().parents[2] / "tests/unit/light/typed_values.hpp"
    path.write_text(TYPED.replace("COUNT", str(len(lines))).replace("ROWS", "\n".join(lines)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
