// SPDX-License-Identifier: MIT
// The kernels of a scheme by its number of stages.
#pragma once

#include <cstddef>

namespace polhode {
inline namespace v0 {
namespace detail {

// of.operator()<s>() for s = 4, 8, 16 or 32 stages, up to `most`.
template <std::size_t most = 32, class Of>
auto of_stages(std::size_t stages, const Of& of) {
  if constexpr (most == 32)
    if (stages == 32) return of.template operator()<32>();
  switch (stages) {
    case 4:
      return of.template operator()<4>();
    case 8:
      return of.template operator()<8>();
    default:
      return of.template operator()<16>();
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
