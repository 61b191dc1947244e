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

// A number type that carries double-double values.
template <class T>
inline constexpr bool is_double_double = false;
template <>
inline constexpr bool is_double_double<DoubleDouble> = true;
template <int N>
inline constexpr bool is_double_double<Dual<DoubleDouble, N>> = true;

// The coefficients as double, rounded so that the conditions of order 1 and 2 hold beyond rounding:
// sum_j a_ij = c_i, sum b_i = 1, sum b_i c_i = 1/2. The smallest of each sum takes what the others
// lose. What they miss acts in every step alike: 1e-10 rad after 1e4 turns if left.
template <class Tableau>
struct RoundedTableau {
  static constexpr std::size_t stages = Tableau::stages;
  double a[stages][stages] = {};
  double b[stages] = {};
  double c[stages] = {};
  double e[stages] = {};

  constexpr RoundedTableau() {
    for (std::size_t i = 0; i < stages; ++i) {
      b[i] = Tableau::b[i].hi;
      c[i] = Tableau::c[i].hi;
      e[i] = Tableau::e[i].hi;
      for (std::size_t j = 0; j < i; ++j) a[i][j] = Tableau::a[i][j].hi;
      if (i > 0)
        settle(
            a[i], i, [](std::size_t) { return 1.0; }, c[i]);
    }
    settle(
        b, stages, [this](std::size_t j) { return c[j]; }, 0.5);
    DoubleDouble rest(1.0);
    for (std::size_t i = 1; i < stages; ++i) rest -= DoubleDouble(b[i]);
    b[0] = rest.hi;
  }

 private:
  // The smallest weight that is not 0 becomes what makes sum_j weight_j factor(j) = value.
  template <class Factor>
  static constexpr void settle(double* weights, std::size_t n, const Factor& factor, double value) {
    const auto size = [&](std::size_t j) { return weights[j] < 0.0 ? -weights[j] : weights[j]; };
    std::size_t least = n;
    for (std::size_t j = 0; j < n; ++j)
      if (weights[j] != 0.0 && factor(j) != 0.0 && (least == n || size(j) < size(least))) least = j;
    DoubleDouble rest(value);
    for (std::size_t j = 0; j < n; ++j)
      if (j != least) rest -= DoubleDouble::product(weights[j], factor(j));
    weights[least] = (rest / DoubleDouble(factor(least))).hi;
  }
};
template <class Tableau>
inline constexpr RoundedTableau<Tableau> rounded_tableau{};

template <class Tableau, class T>
struct Coefficients {
  static constexpr auto a(std::size_t i, std::size_t j) {
    if constexpr (is_double_double<T>) {
      return wide(Tableau::a[i][j]);
    } else {
      return rounded_tableau<Tableau>.a[i][j];
    }
  }
  static constexpr auto b(std::size_t i) {
    if constexpr (is_double_double<T>) {
      return wide(Tableau::b[i]);
    } else {
      return rounded_tableau<Tableau>.b[i];
    }
  }
  static constexpr auto c(std::size_t i) {
    if constexpr (is_double_double<T>) {
      return wide(Tableau::c[i]);
    } else {
      return rounded_tableau<Tableau>.c[i];
    }
  }
  static constexpr auto e(std::size_t i) {
    if constexpr (is_double_double<T>) {
      return wide(Tableau::e[i]);
    } else {
      return rounded_tableau<Tableau>.e[i];
    }
  }

 private:
  static constexpr DoubleDouble wide(const TwoTerms<double>& x) { return {x.hi, x.lo}; }
};

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
