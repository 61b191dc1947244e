// SPDX-License-Identifier: MIT
// F(w) = (1 - (1 - w^2) atanh(w) / w) / w^2 of polhode/light/lommel_seeliger.hpp, from w^2 and e =
// 1 - w^2, which is not formed here: it cancels.
#pragma once

#include <cmath>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace light {
namespace detail {

// Added to what a logarithm is taken of: 0 log 0 is 0 then, with its derivative, as the limit is.
inline constexpr double least_argument = 1e-300;
// Below this w^2 the series, above the closed form, which loses a factor 1 / w^2.
inline constexpr double lune_series_end = 0.125;

// The power of w^2 up to which F = sum over k >= 0 of 2 w^(2k) / (4 (k + 1)^2 - 1) is to be summed.
template <Real T>
int lune_terms() {
  // 8^-19 = 1e-17
  return 2 + static_cast<int>(-std::log(epsilon<T>()) / 2.07) + 4 * int{derivative_order<T>};
}

// atanh(w) / w
template <Real T>
T atanh_ratio(const T& w, const T& e) {
  using std::log;
  return (log(T(1.0) + w) - T(0.5) * log(e + T(least_argument))) / w;
}

template <Real T>
T lune_function(const T& w2, const T& e) {
  using std::sqrt;
  if (w2 < T(lune_series_end)) {
    T sum(0.0);
    for (int k = lune_terms<T>(); k >= 0; --k) {  // 19 trips in double
      const double n = 2.0 * (k + 1.0);
      sum = sum * w2 + T(2.0) / T(n * n - 1.0);
    }
    return sum;
  }
  return (T(1.0) - e * atanh_ratio(T(sqrt(w2)), e)) / w2;
}

struct LuneSlope {
  double value;
  double slope;  // dF / de
};

inline LuneSlope lune_slope(double w2, double e) {
  if (w2 < lune_series_end) {
    double sum = 0.0, slope = 0.0;
    for (int k = lune_terms<double>(); k >= 0; --k) {
      const double n = 2.0 * (k + 1.0);
      slope = slope * w2 + sum;
      sum = sum * w2 + 2.0 / (n * n - 1.0);
    }
    return {sum, -slope};
  }
  const double h = atanh_ratio(std::sqrt(w2), e);
  const double F = (1.0 - e * h) / w2;
  return {F, (1.5 * F - h) / w2};
}

}  // namespace detail
}  // namespace light
}  // namespace v0
}  // namespace polhode
