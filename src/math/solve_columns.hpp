// SPDX-License-Identifier: MIT
// Three linear equations, by Cramer's rule.
#pragma once

#include <array>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline double determinant(const std::array<Vec3, 3>& columns) {
  return dot(columns[0], cross(columns[1], columns[2]));
}

// x with x_0 columns[0] + x_1 columns[1] + x_2 columns[2] = right. T: of the right-hand side.
template <Real T>
BasicVec3<T> solve_columns(const std::array<Vec3, 3>& columns, const BasicVec3<T>& right) {
  const auto& [a, b, c] = columns;
  const double det = determinant(columns);
  const auto along = [&](const Vec3& normal) {
    return (right.x * T(normal.x) + right.y * T(normal.y) + right.z * T(normal.z)) / T(det);
  };
  return {along(cross(b, c)), along(cross(c, a)), along(cross(a, b))};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
