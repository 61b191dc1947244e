// SPDX-License-Identifier: MIT
// The equations of motion of a rotor, of as many stages or bodies at a time as there are lanes.
#pragma once

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// dg/dt = (1/I3 - 1/I2) g2 g3 + ... + u, with g x v where terms have a v: not g x I^-1 g, where
// what is equal in I^-1 cancels and leaves a rounding that adds up over a run.
template <class T>
[[gnu::always_inline]] inline BasicVec3<T> momentum_rate(const BasicVec3<T>& euler,
                                                         const BasicVec3<T>& g,
                                                         const BasicVec3<T>& u) {
  return {euler.x * (g.y * g.z) + u.x, euler.y * (g.z * g.x) + u.y, euler.z * (g.x * g.y) + u.z};
}

// w/2 of one axis, by 1/(2 I) in two doubles.
template <class T>
[[gnu::always_inline]] inline T half_rate(const T& hi, const T& lo, const T& g) {
  return g * hi + g * lo;
}

// dq/dt = q (0, h), h = w/2
template <class T>
[[gnu::always_inline]] inline BasicQuaternion<T> attitude_rate(const BasicQuaternion<T>& q,
                                                               const BasicVec3<T>& h) {
  return {-(q.x * h.x) - q.y * h.y - q.z * h.z, q.w * h.x + q.y * h.z - q.z * h.y,
          q.w * h.y - q.x * h.z + q.z * h.x, q.w * h.z + q.x * h.y - q.y * h.x};
}
// Less the turn of the frame at 2 half_mu.
template <class T>
[[gnu::always_inline]] inline BasicQuaternion<T> seen_in_frame(const BasicQuaternion<T>& rate,
                                                               const BasicVec3<T>& half_mu,
                                                               const BasicQuaternion<T>& q) {
  const BasicQuaternion<T> lag = BasicQuaternion<T>{T(0.0), half_mu.x, half_mu.y, half_mu.z} * q;
  return {rate.w - lag.w, rate.x - lag.x, rate.y - lag.y, rate.z - lag.z};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
