// SPDX-License-Identifier: MIT
// What a free rotation misses: its state against the oracle's.
#pragma once

#include <cmath>
#include <limits>

#include "oracle/free_body.hpp"
#include "oracle/free_cases.hpp"
#include "polhode/free/free_rotation.hpp"

namespace oracle {

struct FreeError {
  double angle = 0.0;     // of the rotation between the attitudes, rad
  double momentum = 0.0;  // |g - g*| / G
};

// The angle of conj(exact) q, q taken as q/|q|; infinite when q has a component that is not finite.
inline double attitude_error(const WideQuaternion& exact, const polhode::Quaternion& q) {
  if (!std::isfinite(q.w + q.x + q.y + q.z)) return std::numeric_limits<double>::infinity();
  const WideQuaternion d = conj(exact) * polhode::normalized(widened(q));
  const Wide v = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  return static_cast<double>(Wide(2 * atan2(v, Wide(abs(d.w)))));
}

// |g - exact| / G; G = 0 admits no error.
inline double momentum_error(const WideVec3& exact, const polhode::Vec3& g, const Wide& G) {
  const WideVec3 d = widened(g) - exact;
  const Wide error = sqrt(dot(d, d));
  if (!std::isfinite(g.x + g.y + g.z) || (G == 0 && error != 0))
    return std::numeric_limits<double>::infinity();
  return G == 0 ? 0.0 : static_cast<double>(Wide(error / G));
}

inline FreeError error_at(FreeBody& body, const polhode::RotorState& got, double t, double t0) {
  const WideState exact = body.at(t, t0);
  return {attitude_error(exact.q, got.q), momentum_error(exact.g, got.g, body.momentum())};
}

inline FreeError free_error(const FreeCase& c) {
  FreeBody body(c.moments, c.start.q, c.start.g);
  const polhode::FreeRotation rotation(polhode::Body(c.moments.x, c.moments.y, c.moments.z),
                                       c.start, c.t0);
  return error_at(body, rotation.at(c.t), c.t, c.t0);
}

}  // namespace oracle
