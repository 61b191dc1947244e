// SPDX-License-Identifier: MIT
// Ellipsoid: semi-axes along the axes of the body, and what moments of inertia it has when it is
// filled evenly.
//
// Equations   x^2/a^2 + y^2/b^2 + z^2/c^2 = 1; Ixx = M (b^2 + c^2) / 5, and so on; from it a^2 =
//             5 (Iyy + Izz - Ixx) / (2 M).
// Units       semi-axes in any unit of length, moments in mass length^2.
// Domain      a, b, c > 0 in any order. Moments that are no body's, or one's that is flat, give
//             NaN or 0. Moments in units of their largest, and mass 1, give a body of the same
//             shape: a relative light curve knows no size.
// Accuracy    a few roundings; a^2 loses what its sum cancels for bodies that are nearly needles.
// Cost        a few flops and three square roots.
#pragma once

#include <cmath>

#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

template <Real T>
struct BasicEllipsoid {
  T a;
  T b;
  T c;

  constexpr bool operator==(const BasicEllipsoid&) const = default;
};
using Ellipsoid = BasicEllipsoid<double>;

// Ixx, Iyy, Izz of an ellipsoid of constant density.
template <Real T>
constexpr BasicVec3<T> homogeneous_moments(const BasicEllipsoid<T>& body, const T& mass) {
  const T a2 = body.a * body.a, b2 = body.b * body.b, c2 = body.c * body.c;
  const T fifth = mass / T(5.0);
  return {fifth * (b2 + c2), fifth * (c2 + a2), fifth * (a2 + b2)};
}

// The ellipsoid of constant density with these Ixx, Iyy, Izz.
template <Real T>
BasicEllipsoid<T> homogeneous_ellipsoid(const BasicVec3<T>& moments, const T& mass) {
  using std::sqrt;
  const T k = T(2.5) / mass;
  return {sqrt(k * ((moments.y - moments.x) + moments.z)),
          sqrt(k * ((moments.z - moments.y) + moments.x)),
          sqrt(k * ((moments.x - moments.z) + moments.y))};
}

}  // namespace light
}  // namespace v0
}  // namespace polhode
