// SPDX-License-Identifier: MIT
// Uncertainty of a fitted spin state: the covariance of its attitude, and moments of inertia that
// the data do not determine.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>

#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/spin_fit.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Of a rotation vector that each unknown moves by `turn`, to first order. About an axis about which
// an unknown that is not determined moves it, the variance is infinite, and covariances are NaN.
inline Mat3 turn_covariance(std::span<const Vec3> turn, const UnknownsCovariance& of) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const std::size_t n = turn.size();
  const auto is_open = [&](std::size_t j) { return of.matrix[j * n + j] == infinite; };
  std::array<bool, 3> open{};
  Mat3 c;
  for (std::size_t j = 0; j < n; ++j) {
    if (is_open(j)) {
      for (int r = 0; r < 3; ++r)
        if (turn[j][r] != 0.0) open[static_cast<std::size_t>(r)] = true;
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) {
      if (is_open(k)) continue;
      const double weight = of.matrix[j * n + k];
      for (int r = 0; r < 3; ++r)
        for (int s = 0; s < 3; ++s) c(r, s) += weight * turn[j][r] * turn[k][s];
    }
  }
  for (int r = 0; r < 3; ++r) {
    if (!open[static_cast<std::size_t>(r)]) continue;
    for (int s = 0; s < 3; ++s)
      c(r, s) = c(s, r) = r == s ? infinite : std::numeric_limits<double>::quiet_NaN();
  }
  return c;
}

// `found`, or the solution with the moments held at their start if two others describe the data as
// well: a body of equal moments, and the body of the start. What was found for the moments is noise
// in that case. `fitted` fits with some of the unknowns of `fit`.
SpinSolution with_undetermined_moments(const SpinFit& fit, SpinSolution found,
                                       const std::function<SpinSolution(const SpinFit&)>& fitted);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
