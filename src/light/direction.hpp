// SPDX-License-Identifier: MIT
// A vector taken as a direction, and the way back of a derivative by the direction to one by the
// vector.
#pragma once

#include <cmath>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

// Component by component.
constexpr Vec3 product(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

struct Direction {
  double inverse_length;
  Vec3 unit;

  explicit Direction(const Vec3& v)
      : inverse_length(1.0 / std::sqrt(dot(v, v))), unit(inverse_length * v) {}

  Vec3 by_vector(const Vec3& by_unit) const {
    return inverse_length * (by_unit - dot(unit, by_unit) * unit);
  }
};

}  // namespace v0
}  // namespace polhode
