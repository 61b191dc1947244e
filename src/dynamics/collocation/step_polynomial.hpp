// SPDX-License-Identifier: MIT
// A step by collocation as a polynomial.
#pragma once

#include "dynamics/collocation/rotor_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The values at the part x of a step of h from `start`, of which rate(n, m) is the coefficient of
// P_m in the rate of number n: the integral of P_m is (P_(m+1) - P_(m-1)) / (2m + 1).
template <class Rate>
RotorStages::Values values_inside(std::size_t stages, const RotorStages::State& start, double h,
                                  double x, const Rate& rate) {
  const double z = 2.0 * x - 1.0;
  std::array<double, 7> sum{};
  const auto add = [&](double weight, std::size_t m) {
    for (std::size_t n = 0; n < 7; ++n) sum[n] += weight * rate(n, m);
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
  RotorStages::Values y = start.y;
  for (std::size_t n = 0; n < 7; ++n) y[n] += h * sum[n] + start.carry[n];
  return y;
}

// The rates inside a step as a polynomial, and where it began.
struct StepPolynomial {
  DoubleDouble t;
  RotorStages::State start;
  double h = 0.0;  // 0: none
  RotorStages::Rows rates{};

  RotorStages::Values at(std::size_t stages, double x) const {
    return values_inside(stages, start, h, x,
                         [this](std::size_t n, std::size_t m) { return rates[n][m]; });
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
