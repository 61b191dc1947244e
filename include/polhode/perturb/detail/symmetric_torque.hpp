// SPDX-License-Identifier: MIT
// a x (I b) + b x (I a), of principal moments.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The components of a x (I b) + b x (I a), differences of moments first.
template <Number T>
BasicVec3<T> turning(const Vec3& I, const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return {(T(I.z) - T(I.y)) * (a.y * b.z + a.z * b.y), (T(I.x) - T(I.z)) * (a.z * b.x + a.x * b.z),
          (T(I.y) - T(I.x)) * (a.x * b.y + a.y * b.x)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
