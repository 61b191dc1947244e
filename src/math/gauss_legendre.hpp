// SPDX-License-Identifier: MIT
// Gauss' quadrature: the zeros of Legendre's polynomials and the weights there.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

// P_0 ... P_N at x, by recurrence.
template <std::size_t N, Real T>
std::array<T, N + 1> legendre_polynomials(const T& x) {
  std::array<T, N + 1> P{T(1.0), x};
  for (std::size_t k = 2; k <= N; ++k) {
    const auto n = static_cast<double>(k);
    P[k] = (T(2.0 * n - 1.0) * x * P[k - 1] - T(n - 1.0) * P[k - 2]) / T(n);
  }
  return P;
}

template <Real T, std::size_t N>
struct GaussRule {
  std::array<T, N> x;  // from 1 down to -1
  std::array<T, N> w;
};

// By Newton's method from Tricomi's first guess.
template <Real T, std::size_t N>
GaussRule<T, N> gauss_legendre() {
  GaussRule<T, N> rule{};
  const double n = static_cast<double>(N);
  for (std::size_t i = 0; i < N; ++i) {
    T x(std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5)));
    T slope(1.0);
    for (int trip = 0; trip < 8; ++trip) {  // 8 trips, quadratic
      const std::array<T, N + 1> P = legendre_polynomials<N>(x);
      slope = T(n) * (x * P[N] - P[N - 1]) / (x * x - T(1.0));
      x = x - P[N] / slope;
    }
    rule.x[i] = x;
    rule.w[i] = T(2.0) / ((T(1.0) - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace v0
}  // namespace polhode
