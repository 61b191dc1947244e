// SPDX-License-Identifier: MIT
// Sums over the stages of a Runge-Kutta step, and over steps.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "polhode/detail/ode/is_double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// sum + c k, component by component.
template <Real T, std::size_t N, class C>
[[gnu::always_inline]] inline void accumulate(std::array<T, N>& sum, const C& c,
                                              const std::array<T, N>& k) {
  for (std::size_t i = 0; i < N; ++i) sum[i] = sum[i] + k[i] * c;
}

// sum_j weight(j) k_j over the rates of J; coefficients that are 0 cost nothing.
template <class Weight, Real T, std::size_t N, std::size_t S, std::size_t... J>
[[gnu::always_inline]] inline std::array<T, N> weighted_sum(
    const std::array<std::array<T, N>, S>& k, std::index_sequence<J...>) {
  std::array<T, N> sum{};
  const auto add = [&]<std::size_t j>() {
    constexpr auto c = Weight{}(j);
    if constexpr (!(c == 0.0)) accumulate(sum, c, k[j]);
  };
  (add.template operator()<J>(), ...);
  return sum;
}

template <Real T, std::size_t N>
[[gnu::always_inline]] inline std::array<T, N> moved(const std::array<T, N>& y, double h,
                                                     const std::array<T, N>& rate) {
  std::array<T, N> r;
  for (std::size_t i = 0; i < N; ++i) r[i] = y[i] + rate[i] * h;
  return r;
}

// The time of a stage: to 2^-53 of h, or of double-double.
template <class T, class C>
inline DoubleDouble stage_time(const DoubleDouble& t, double h, const C& c) {
  if constexpr (is_double_double<T>) {
    return t + c * h;
  } else {
    return DoubleDouble::sum(t.hi, t.lo + c * h);
  }
}

inline void add_compensated(double& y, double& carry, double increment) {
  const TwoTerms<double> s = two_sum(y, carry + increment);
  y = s.hi;
  carry = s.lo;
}
inline void add_compensated(DoubleDouble& y, DoubleDouble&, const DoubleDouble& increment) {
  y += increment;
}
template <class T, int N>
void add_compensated(Dual<T, N>& y, Dual<T, N>& carry, const Dual<T, N>& increment) {
  add_compensated(y.value, carry.value, increment.value);
  for (std::size_t i = 0; i < y.derivative.size(); ++i)
    add_compensated(y.derivative[i], carry.derivative[i], increment.derivative[i]);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
