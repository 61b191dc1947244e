// SPDX-License-Identifier: MIT
// What a product of packs loses to rounding.
#pragma once

#include "polhode/detail/math/pack.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class T>
[[gnu::always_inline]] inline T product_error(const T& a, const T& b) {
  if constexpr (T::set == InstructionSet::baseline) {
    return two_prod(a, b).lo;
  } else {
    return two_prod_fma(a, b).lo;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
