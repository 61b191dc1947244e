// SPDX-License-Identifier: MIT
// Elements of a Kepler orbit in double-double: its shape, and its own axes in those of the
// elements.
#pragma once

#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

PlanarKepler::Shape kepler_shape(const KeplerElements& elements);

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
