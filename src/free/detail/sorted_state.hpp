// SPDX-License-Identifier: MIT
// States seen from the body axes sorted by moment, and states displaced off a steady rotation.
#pragma once

#include <cmath>
#include <cstdlib>

#include "polhode/free/detail/axis_order.hpp"
#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline bool is_sphere(const Body& body) {
  const Vec3& I = body.moments();
  return I.x == I.y && I.y == I.z;
}

inline Vec3 sorted_doubles(const Body& body) {
  const AxisOrder order = ascending_order(body.moments());
  const Vec3& I = body.moments();
  return {I[order.axis[0]], I[order.axis[1]], I[order.axis[2]]};
}

// Rising, scaled by a power of two so that the largest is in [1, 2).
inline BasicVec3<DoubleDouble> sorted_moments(const Body& body) {
  return converted<DoubleDouble>(scaled(sorted_doubles(body), exponent_of_largest(body.moments())));
}

template <Real T>
BasicRotorState<T> in_sorted_axes(const Body& body, const BasicRotorState<T>& s) {
  const AxisOrder order = ascending_order(body.moments());
  return {s.q * conj(quaternion_of<T>(order)), reordered(order, s.g)};
}
template <Real T>
BasicRotorState<T> in_body_axes(const Body& body, const BasicRotorState<T>& s) {
  const AxisOrder order = ascending_order(body.moments());
  return {s.q * quaternion_of<T>(order), restored(order, s.g)};
}

// The power of two that brings the largest momentum of a state to [1, 2); 0 where squares are far
// from the ends of double range, so that most states are read as they are.
inline int momentum_exponent(const Vec3& g) {
  const int exponent = exponent_of_largest(g);
  return std::abs(exponent) < 400 ? 0 : exponent;
}

// A momentum of a steady rotation, moved by 2^-440 |g| to where a polhode exists, so that
// flow-adapted variables are read as their limit. The displacement is far below the rounding of the
// state, and so is what is dropped: components that FreeRotation takes for 0. g of order 1.
inline RotorState displaced(const Body& body, const RotorState& s) {
  const AxisOrder order = ascending_order(body.moments());
  const Vec3 I = sorted_doubles(body);
  Vec3 g = reordered(order, s.g);
  const double shift = std::ldexp(1.0, exponent_of_largest(s.g) - 440);
  for (int i = 0; i < 3; ++i)
    if (std::abs(g[i]) < 0x1p20 * shift) g[i] = 0.0;
  if (g.x == 0.0 && (I.y == I.z || g.y == 0.0))
    g.x = shift;
  else
    g.z = shift;
  return {s.q, restored(order, g)};
}

inline RotorState rounded_state(const BasicRotorState<DoubleDouble>& s) {
  return {{s.q.w.hi, s.q.x.hi, s.q.y.hi, s.q.z.hi}, {s.g.x.hi, s.g.y.hi, s.g.z.hi}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
