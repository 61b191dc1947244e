// SPDX-License-Identifier: MIT
// 6x6 matrices: Jacobians of charts and state transition matrices.
//
// Units       mixed: row i, column j carries unit(output i) / unit(input j).
// Domain      any entries.
// Accuracy    products are plain rounded sums.
// Cost        a product is 432 flops.
#pragma once

#include <array>
#include <cstddef>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicMatrix6 {
  std::array<std::array<T, 6>, 6> a{};

  static constexpr BasicMatrix6 identity() {
    BasicMatrix6 m;
    for (int i = 0; i < 6; ++i) m(i, i) = T(1.0);
    return m;
  }
  constexpr const T& operator()(int i, int j) const {
    return a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  constexpr T& operator()(int i, int j) {
    return a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  bool operator==(const BasicMatrix6&) const
    requires Real<T>
  = default;
};
using Matrix6 = BasicMatrix6<double>;

template <Number T>
constexpr BasicMatrix6<T> operator*(const BasicMatrix6<T>& a, const BasicMatrix6<T>& b) {
  BasicMatrix6<T> c;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) c(i, j) = c(i, j) + a(i, k) * b(k, j);
  return c;
}

template <Number T>
constexpr std::array<T, 6> operator*(const BasicMatrix6<T>& a, const std::array<T, 6>& x) {
  std::array<T, 6> y{};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      y[static_cast<std::size_t>(i)] += a(i, j) * x[static_cast<std::size_t>(j)];
  return y;
}

template <Number T>
constexpr BasicMatrix6<T> transpose(const BasicMatrix6<T>& a) {
  BasicMatrix6<T> c;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) c(i, j) = a(j, i);
  return c;
}

}  // namespace v0
}  // namespace polhode
