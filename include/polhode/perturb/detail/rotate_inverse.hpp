// SPDX-License-Identifier: MIT
// Vectors turned by quaternions of any length.
#pragma once

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// q* x q, |q|^2 times the vector turned back: the form that is homogeneous in q. Inside a step |q|
// = 1 holds to 1e-13 or so, and x + 2 w (u x x) + ..., the form for |q| = 1, would turn by as much
// too far.
template <Number T>
constexpr BasicVec3<T> turned_back_longer(const BasicQuaternion<T>& q, const BasicVec3<T>& x) {
  const BasicVec3<T> u{q.x, q.y, q.z};
  const T two(2.0);
  return (q.w * q.w - dot(u, u)) * x + (two * dot(u, x)) * u - (two * q.w) * cross(u, x);
}
template <Number T>
constexpr BasicVec3<T> rotate_inverse(const BasicQuaternion<T>& q, const BasicVec3<T>& x) {
  const T square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  return (T(1.0) / square) * turned_back_longer(q, x);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
