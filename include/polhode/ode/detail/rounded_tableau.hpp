// SPDX-License-Identifier: MIT
// The coefficients of a Runge-Kutta pair on a number type.
#pragma once

#include <cstddef>

#include "polhode/detail/ode/is_double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
