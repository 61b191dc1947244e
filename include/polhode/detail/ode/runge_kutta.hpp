// SPDX-License-Identifier: MIT
// One step of an explicit Runge-Kutta pair, and the compensated state that steps add up in.
//
// Equations   k_i = f(t + c_i h, y + h sum_j a_ij k_j); increment h sum_i b_i k_i, error h sum_i
//             e_i k_i. `Tableau` names the coefficients (Verner98).
// Units       those of the problem: y' = f(t, y).
// Domain      f is a callable of (DoubleDouble t, const std::array<T, N>& y) that returns y'. T =
//             double, DoubleDouble or a Dual. Time is a double-double whatever T is: after 1e4
//             turns a rounding of t is a larger error than all others.
// Accuracy    the update y + increment is exact to 2^-53 of the increment (Kahan, Babuska): what a
//             double loses is carried along.
// Errors      none of its own; what f throws passes through. NaN in, NaN out.
// Cost        stages - 1 calls of f (the first is given), and 2 N flops for every coefficient.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/ode/detail/rounded_tableau.hpp"
#include "polhode/ode/detail/stage_sums.hpp"

namespace polhode {
inline namespace v0 {

template <Real T, std::size_t N>
struct RungeKuttaStep {
  std::array<T, N> increment;
  std::array<T, N> error;  // of the lower order of the pair
};

// A sum of many increments: values and what they have lost to rounding.
template <Real T, std::size_t N>
struct CompensatedState {
  std::array<T, N> y;
  std::array<T, N> carry{};

  void add(const std::array<T, N>& increment) {
    for (std::size_t i = 0; i < N; ++i) detail::add_compensated(y[i], carry[i], increment[i]);
  }
};

// One step of h from (t, y); `rate` is f(t, y).
template <class Tableau, Real T, std::size_t N, class F>
RungeKuttaStep<T, N> runge_kutta_step(const F& f, const DoubleDouble& t, const std::array<T, N>& y,
                                      const std::array<T, N>& rate, double h) {
  constexpr auto stages = static_cast<std::size_t>(Tableau::stages);
  std::array<std::array<T, N>, stages> k;
  k[0] = rate;
  using C = detail::Coefficients<Tableau, T>;
  const auto stage = [&]<std::size_t i>() {
    constexpr auto weight = [](std::size_t j) { return C::a(i, j); };
    const std::array<T, N> sum =
        detail::weighted_sum<decltype(weight)>(k, std::make_index_sequence<i>{});
    k[i] = f(detail::stage_time<T>(t, h, C::c(i)), detail::moved(y, h, sum));
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (stage.template operator()<I + 1>(), ...);
  }(std::make_index_sequence<stages - 1>{});
  constexpr std::make_index_sequence<stages> all{};
  constexpr auto b = [](std::size_t j) { return C::b(j); };
  constexpr auto e = [](std::size_t j) { return C::e(j); };
  RungeKuttaStep<T, N> step{detail::weighted_sum<decltype(b)>(k, all),
                            detail::weighted_sum<decltype(e)>(k, all)};
  for (std::size_t i = 0; i < N; ++i) {
    step.increment[i] = step.increment[i] * h;
    step.error[i] = step.error[i] * h;
  }
  return step;
}

}  // namespace v0
}  // namespace polhode
