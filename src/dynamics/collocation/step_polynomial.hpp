// SPDX-License-Identifier: MIT
// A step by collocation as a polynomial.
#pragma once

#include <algorithm>

#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// As many numbers, all 0.
template <class Values>
Values zeros_like(Values y) {
  std::fill(y.begin(), y.end(), 0.0);
  return y;
}

// The first `numbers` values at the part x of a step of h from `start`, of which rate(n, m) is the
// coefficient of P_m in the rate of number n: the integral of P_m is (P_(m+1) - P_(m-1)) / (2m +
// 1).
template <class State, class Rate>
auto values_inside(std::size_t numbers, std::size_t stages, const State& start, double h, double x,
                   const Rate& rate) {
  const double z = 2.0 * x - 1.0;
  auto sum = zeros_like(start.y);
  const auto add = [&](double weight, std::size_t m) {
    for (std::size_t n = 0; n < numbers; ++n) sum[n] += weight * rate(n, m);
  };
  double before = 1.0, P = z;
  add(x, 0);
  for (std::size_t m = 1; m < stages; ++m) {
    const double k = static_cast<double>(m);
    const double next = ((2.0 * k + 1.0) * z * P - k * before) / (k + 1.0);
    add((next - before) / (2.0 * (2.0 * k + 1.0)), m);
    before = P;
    P = next;
  }
  auto y = start.y;
  for (std::size_t n = 0; n < numbers; ++n) y[n] += h * sum[n] + start.carry[n];
  return y;
}

// The rates inside a step as a polynomial, and where it began.
template <class Stages>
struct StepPolynomial {
  DoubleDouble t;
  typename Stages::State start;
  double h = 0.0;  // 0: none
  typename Stages::Rows rates{};

  typename Stages::Values at(std::size_t stages, double x) const {
    return values_inside(rates.size(), stages, start, h, x,
                         [this](std::size_t n, std::size_t m) { return rates[n][m]; });
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
