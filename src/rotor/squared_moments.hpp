// SPDX-License-Identifier: MIT
// Whether squares of moments, and of their inverses, are doubles next to each other.
#pragma once

#include <algorithm>

#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline bool squared_moments_are_doubles(const Body& body) {
  const Vec3& I = body.moments();
  return std::min({I.x, I.y, I.z}) / std::max({I.x, I.y, I.z}) >= 1e-150;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
