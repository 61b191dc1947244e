// SPDX-License-Identifier: MIT
// The normal of an orbit as a function of time, on any number type that frames are called with.
#pragma once

#include <cmath>
#include <string>

#include "polhode/error.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/table_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The rate of a frame along a table takes the second derivative of its path.
inline void require_curved(const TableOrbit& orbit) {
  if (orbit.order() < 4)
    throw DomainError("a frame along a table of order " + std::to_string(orbit.order()) +
                      "; expected 4 or more, for a path with a curvature");
}

// Of position and velocity.
template <class T>
BasicVec3<T> normal_of(const BasicVec3<T>& x, const BasicVec3<T>& v) {
  const BasicVec3<T> h = cross(x, v);
  return (T(1.0) / norm(h)) * h;
}

// The shortest turn from axis 3 to a unit vector other than -axis 3.
template <class T>
BasicQuaternion<T> shortest_turn_to(const BasicVec3<T>& n) {
  using std::sqrt;
  const T one(1.0), half(0.5);
  const T c = sqrt(half * (one + n.z));
  return {c, -(half * n.y / c), half * n.x / c, T(0.0)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
