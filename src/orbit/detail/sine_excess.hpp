// SPDX-License-Identifier: MIT
// |x - sin x| and |x - sinh x| without cancellation.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// 1 / (2k (2k + 1)), k = 2, 3, ...
template <Real T, std::size_t N>
constexpr std::array<T, N> excess_ratios() {
  std::array<T, N> ratios;
  for (std::size_t i = 0; i < N; ++i) {
    const double k2 = 2.0 * static_cast<double>(i + 2);
    ratios[i] = T(1.0) / T(k2 * (k2 + 1.0));
  }
  return ratios;
}

// x^3/3! - x^5/5! + ... with the sign of `alternating`, for |x| <= 1.6: 21 ratios leave 1e-36, ten
// 1e-18.
template <Real T>
T excess_series(const T& x, bool alternating) {
  constexpr std::size_t terms = std::same_as<T, double> ? 10 : 21;
  static constexpr std::array<T, terms> ratios = excess_ratios<T, terms>();
  const T z = alternating ? -(x * x) : x * x;
  T sum(1.0);
  for (std::size_t i = terms; i-- > 0;) sum = T(1.0) + z * sum * ratios[i];
  return x * x * x * sum * (T(1.0) / T(6.0));
}

inline constexpr double excess_series_end = 1.6;

// x - sin x, given s = sin x.
template <Real T>
T sine_excess(const T& x, const T& s) {
  using std::abs;
  return abs(x) < T(excess_series_end) ? excess_series(x, true) : x - s;
}
// sinh x - x, given s = sinh x.
template <Real T>
T sinh_excess(const T& x, const T& s) {
  using std::abs;
  return abs(x) < T(excess_series_end) ? excess_series(x, false) : s - x;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
