// SPDX-License-Identifier: MIT
// A quaternion that no variable moves.
#pragma once

#include "polhode/math/dual.hpp"
#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T, int N>
BasicQuaternion<Dual<T, N>> constant(const BasicQuaternion<T>& q) {
  using D = Dual<T, N>;
  return {D(q.w), D(q.x), D(q.y), D(q.z)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
