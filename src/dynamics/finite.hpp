// SPDX-License-Identifier: MIT
// Whether a vector is a number.
#pragma once

#include <cmath>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
bool is_finite(const BasicVec3<T>& v) {
  using std::isfinite;
  return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
