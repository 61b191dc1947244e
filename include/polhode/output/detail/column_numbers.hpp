// SPDX-License-Identifier: MIT
// The numbers of a group of columns in a row, from what its function returns.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

constexpr std::size_t most_columns = 16;  // of a group
using ColumnNumbers = std::array<double, most_columns>;

namespace detail {

template <class T>
constexpr std::size_t column_count = 0;
template <>
inline constexpr std::size_t column_count<double> = 1;
template <>
inline constexpr std::size_t column_count<Vec3> = 3;
template <>
inline constexpr std::size_t column_count<Quaternion> = 4;
template <std::size_t N>
constexpr std::size_t column_count<std::array<double, N>> = N;

inline ColumnNumbers column_numbers(double x) { return {x}; }
inline ColumnNumbers column_numbers(const Vec3& v) { return {v.x, v.y, v.z}; }
inline ColumnNumbers column_numbers(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }
template <std::size_t N>
ColumnNumbers column_numbers(const std::array<double, N>& x) {
  ColumnNumbers numbers{};
  std::copy(x.begin(), x.end(), numbers.begin());
  return numbers;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
