// SPDX-License-Identifier: MIT
// The kernels of a scheme by its number of stages.
#pragma once

#include <cstddef>

namespace polhode {
inline namespace v0 {
namespace detail {

// of.operator()<s>() for s = 4, 8, 16 or 32 stages.
template <class Of>
auto dispatch_stage_count(std::size_t stages, const Of& of) {
  switch (stages) {
    case 4:
      return of.template operator()<4>();
    case 8:
      return of.template operator()<8>();
    case 16:
      return of.template operator()<16>();
    default:
      return of.template operator()<32>();
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
