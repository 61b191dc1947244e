// SPDX-License-Identifier: MIT
// A unit vector turned about another one: the motion of a spin axis while its orbit stays.
#pragma once

#include "polhode/math/trigonometry.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// s turned about n by twice the angle of these sines: 1 - cos without cancellation. What rounding
// does to the length is taken out to first order.
template <class T>
[[gnu::always_inline]] inline BasicVec3<T> turned_axis(const BasicVec3<T>& s, const BasicVec3<T>& n,
                                                       const SinCos<T>& half) {
  const T twice = T(2.0) * half.sin;
  const BasicVec3<T> across = cross(n, s);
  const BasicVec3<T> next =
      s + T(twice * half.cos) * across + T(twice * half.sin) * cross(n, across);
  return T(T(1.5) - T(0.5) * dot(next, next)) * next;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
