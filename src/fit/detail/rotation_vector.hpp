// SPDX-License-Identifier: MIT
// Rotations as vectors: exponential, logarithm, and their derivatives.
#pragma once

#include <cmath>
#include <numbers>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// exp(v / 2), the rotation by |v| about v.
inline Quaternion turn_by(const Vec3& v) {
  const double angle = norm(v), half = 0.5 * angle;
  const double s = angle < 1e-4 ? 0.5 * (1.0 - half * half / 6.0) : std::sin(half) / angle;
  return {std::cos(half), s * v.x, s * v.y, s * v.z};
}

// The rotation vector of a unit quaternion, of length pi at most.
inline Vec3 rotation_vector(Quaternion q) {
  if (q.w < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
  const Vec3 v{q.x, q.y, q.z};
  const double s = norm(v);
  const double factor =
      s < 1e-5 ? (2.0 / q.w) * (1.0 - s * s / (3.0 * q.w * q.w)) : 2.0 * std::atan2(s, q.w) / s;
  return factor * v;
}

// 1 + a hat(v) + b hat(v)^2
inline Mat3 series_of_hat(const Vec3& v, double a, double b) {
  const Mat3 h = hat(v), h2 = h * h;
  Mat3 m = Mat3::identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) += a * h(i, j) + b * h2(i, j);
  }
  return m;
}

// dtheta of exp(v + dv) = exp(v) exp(dtheta), over dv.
inline Mat3 exp_derivative(const Vec3& v) {
  const double x = norm(v), half = std::sin(0.5 * x), x2 = x * x;
  if (x < 1e-2) {
    return series_of_hat(v, -0.5 + x2 / 24.0 - x2 * x2 / 720.0,
                         1.0 / 6.0 - x2 / 120.0 + x2 * x2 / 5040.0);
  }
  return series_of_hat(v, -2.0 * half * half / x2, (x - std::sin(x)) / (x2 * x));
}

// dv of exp(v + dv) = exp(v) exp(dtheta), over dtheta.
inline Mat3 log_derivative(const Vec3& v) {
  const double x = norm(v), x2 = x * x;
  const double b = x < 1e-2 ? 1.0 / 12.0 + x2 / 720.0 + x2 * x2 / 30240.0
                            : (1.0 - 0.5 * x / std::tan(0.5 * x)) / x2;
  return series_of_hat(v, 0.5, b);
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
