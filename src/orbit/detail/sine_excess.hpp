// SPDX-License-Identifier: MIT
// |x - sin x| and |x - sinh x| without cancellation.
#pragma once

#include <cmath>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// x^3/3! - x^5/5! + ... with the sign of `alternating`, for |x| <= 1.6: 22 terms leave 1e-36.
template <Real T>
T excess_series(const T& x, bool alternating) {
  constexpr int double_terms = 11, more_terms = 22;
  const int terms = epsilon<T>() < epsilon<double>() ? more_terms : double_terms;
  const T z = alternating ? -(x * x) : x * x;
  T sum(1.0);
  for (int k = terms; k >= 2; --k) {
    sum = T(1.0) + z * sum / T(2.0 * k * (2.0 * k + 1.0));
  }
  return x * x * x * sum / T(6.0);
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
