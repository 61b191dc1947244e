// SPDX-License-Identifier: MIT
// The numbers of a group of columns in a row, from what its function returns.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
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

template <std::size_t N>
void put_columns(const std::array<double, N>& x, std::span<double> out) {
  std::copy(x.begin(), x.end(), out.begin());
}
inline void put_columns(double x, std::span<double> out) { out[0] = x; }
inline void put_columns(const Vec3& v, std::span<double> out) {
  put_columns(std::array{v.x, v.y, v.z}, out);
}
inline void put_columns(const Quaternion& q, std::span<double> out) {
  put_columns(std::array{q.w, q.x, q.y, q.z}, out);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
