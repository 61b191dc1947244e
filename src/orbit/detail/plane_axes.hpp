// SPDX-License-Identifier: MIT
// Rotations of vectors in double-double: an orbit's own axes in those of its elements.
#pragma once

#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
BasicVec3<T> turned_about_z(const SinCos<T>& angle, const BasicVec3<T>& v) {
  return {angle.cos * v.x - angle.sin * v.y, angle.sin * v.x + angle.cos * v.y, v.z};
}
template <Real T>
BasicVec3<T> turned_about_x(const SinCos<T>& angle, const BasicVec3<T>& v) {
  return {v.x, angle.cos * v.y - angle.sin * v.z, angle.sin * v.y + angle.cos * v.z};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
