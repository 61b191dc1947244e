// SPDX-License-Identifier: MIT
// Whether all components of a vector are finite numbers.
#pragma once

#include <cmath>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
