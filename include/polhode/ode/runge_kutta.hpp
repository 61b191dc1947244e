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

namespace polhode {
inline namespace v0 {

template <Real T, std::size_t N>
struct RungeKuttaStep {
  std::array<T, N> increment;
  std::array<T, N> error;  // of the lower order of the pair
};

namespace detail {

// A coefficient in the working precision of T.
template <class T>
inline constexpr bool is_double_double = false;
template <>
inline constexpr bool is_double_double<DoubleDouble> = true;
template <int N>
inline constexpr bool is_double_double<Dual<DoubleDouble, N>> = true;

template <class T>
constexpr auto coefficient(const TwoTerms<double>& c) {
  if constexpr (is_double_double<T>) {
    return DoubleDouble{c.hi, c.lo};
  } else {
    return c.hi;
  }
}

// sum + c k, component by component.
template <Real T, std::size_t N, class C>
[[gnu::always_inline]] inline void accumulate(std::array<T, N>& sum, const C& c,
                                              const std::array<T, N>& k) {
  for (std::size_t i = 0; i < N; ++i) sum[i] = sum[i] + k[i] * c;
}

// sum_j weights[j] k_j over the first sizeof...(J) rates; coefficients that are 0 cost nothing.
template <class Weights, Real T, std::size_t N, std::size_t S, std::size_t... J>
[[gnu::always_inline]] inline std::array<T, N> weighted_sum(
    const std::array<std::array<T, N>, S>& k, std::index_sequence<J...>) {
  std::array<T, N> sum{};
  const auto add = [&]<std::size_t j>() {
    constexpr TwoTerms<double> c = Weights::at(j);
    if constexpr (c.hi != 0.0) accumulate(sum, coefficient<T>(c), k[j]);
  };
  (add.template operator()<J>(), ...);
  return sum;
}

template <class Tableau, std::size_t I>
struct StageWeights {
  static constexpr TwoTerms<double> at(std::size_t j) { return Tableau::a[I][j]; }
};
template <class Tableau>
struct StepWeights {
  static constexpr TwoTerms<double> at(std::size_t j) { return Tableau::b[j]; }
};
template <class Tableau>
struct ErrorWeights {
  static constexpr TwoTerms<double> at(std::size_t j) { return Tableau::e[j]; }
};

template <Real T, std::size_t N>
[[gnu::always_inline]] inline std::array<T, N> moved(const std::array<T, N>& y, double h,
                                                     const std::array<T, N>& rate) {
  std::array<T, N> r;
  for (std::size_t i = 0; i < N; ++i) r[i] = y[i] + rate[i] * h;
  return r;
}

// The time of a stage: exact for double-double states, else to 2^-53 of h.
template <class T>
inline DoubleDouble stage_time(const DoubleDouble& t, double h, const TwoTerms<double>& c) {
  if constexpr (is_double_double<T>) {
    return t + DoubleDouble{c.hi, c.lo} * h;
  } else {
    return DoubleDouble::sum(t.hi, t.lo + c.hi * h);
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
  const auto stage = [&]<std::size_t i>() {
    const std::array<T, N> sum =
        detail::weighted_sum<detail::StageWeights<Tableau, i>>(k, std::make_index_sequence<i>{});
    k[i] = f(detail::stage_time<T>(t, h, Tableau::c[i]), detail::moved(y, h, sum));
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (stage.template operator()<I + 1>(), ...);
  }(std::make_index_sequence<stages - 1>{});
  constexpr std::make_index_sequence<stages> all{};
  RungeKuttaStep<T, N> step{detail::weighted_sum<detail::StepWeights<Tableau>>(k, all),
                            detail::weighted_sum<detail::ErrorWeights<Tableau>>(k, all)};
  for (std::size_t i = 0; i < N; ++i) {
    step.increment[i] = step.increment[i] * h;
    step.error[i] = step.error[i] * h;
  }
  return step;
}

}  // namespace v0
}  // namespace polhode
