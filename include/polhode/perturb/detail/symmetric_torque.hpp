// SPDX-License-Identifier: MIT
// a x (I b) + b x (I a), of principal moments.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The components of a x (I b) + b x (I a), differences of moments first.
template <Number T>
BasicVec3<T> turning(const BasicVec3<T>& I, const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return {(I.z - I.y) * (a.y * b.z + a.z * b.y), (I.x - I.z) * (a.z * b.x + a.x * b.z),
          (I.y - I.x) * (a.x * b.y + a.y * b.x)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
