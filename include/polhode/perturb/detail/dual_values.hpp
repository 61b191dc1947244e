// SPDX-License-Identifier: MIT
// Dual numbers among number types, and the values of a vector of them.
#pragma once

#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T, int N>
BasicVec3<T> values_of(const BasicVec3<Dual<T, N>>& x) {
  return {x.x.value, x.y.value, x.z.value};
}
template <class T>
inline constexpr bool is_dual_number = false;
template <Real T, int N>
inline constexpr bool is_dual_number<Dual<T, N>> = true;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
