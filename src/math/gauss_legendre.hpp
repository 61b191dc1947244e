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

// Nodes from -1 up, their weights, and Legendre's polynomials there.
template <Real T, std::size_t N>
struct GaussNodes {
  std::array<T, N> x;
  std::array<T, N> w;
  std::array<std::array<T, N + 1>, N> P;

  GaussNodes() {
    const GaussRule<T, N> rule = gauss_legendre<T, N>();
    w = rule.w;
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = -rule.x[i];
      P[i] = legendre_polynomials<N>(x[i]);
    }
  }

  // The integral from -1 to x_i of the Lagrange polynomial of node j, times 2 / w_j: by its
  // expansion in Legendre polynomials, of which the integral is (P_(k+1) - P_(k-1)) / (2k + 1).
  T integral(std::size_t i, std::size_t j) const {
    T sum = T(1.0) + x[i];
    for (std::size_t k = 1; k < N; ++k) sum += P[j][k] * (P[i][k + 1] - P[i][k - 1]);
    return sum;
  }
};

}  // namespace v0
}  // namespace polhode
