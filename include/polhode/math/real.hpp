// SPDX-License-Identifier: MIT
// The concept Real: one real number, ordered by <. Decisions, loops to convergence and formulas of
// the user are written with it; kernels that packs of lanes run too ask for a Number (number.hpp).
//
// Units       none: a Real is a pure number.
// Domain      double, DoubleDouble, Dual<T, N>, and any multiprecision type with the same
//             operators.
// Accuracy    constants are correct to the last digit of T.
// Cost        pi<T>() is a constant for double and DoubleDouble; other types call atan once per
//             use.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include "polhode/math/number.hpp"

namespace polhode {
inline namespace v0 {

// A Number that behaves like one real: field operations, order, construction from double, and the
// elementary functions (sqrt, sin, cos, exp, log, atan2, ...) found by argument-dependent lookup.
// Kernels write `using std::sqrt;` and then call sqrt(x) without a qualifier.
template <class T>
concept Real = Number<T> && requires(T a, T b) {
  { a < b } -> std::convertible_to<bool>;
  { a == b } -> std::convertible_to<bool>;
};

// The customization point for constants and rounding of a number type. Specialized next to each
// type that needs it.
template <class T>
struct RealTraits {
  static T pi() {
    using std::atan;
    return T(4) * atan(T(1));
  }
  // Unit of relative rounding that loops iterate down to.
  static double epsilon() { return static_cast<double>(std::numeric_limits<T>::epsilon()); }
  // The nearest double: for decisions (branches, counts), never for values.
  static double to_double(const T& x) { return static_cast<double>(x); }
};

template <>
struct RealTraits<double> {
  static constexpr double pi() { return 3.141592653589793; }
  static constexpr double epsilon() { return std::numeric_limits<double>::epsilon(); }
  static constexpr double to_double(double x) { return x; }
};

// How many layers of derivatives a number carries: 0, 1 for Dual<double, N>, 2 for a Dual of Duals.
// A loop that stops when its value has converged runs as many trips more, for the derivatives.
template <class T>
inline constexpr std::size_t derivative_order = 0;

template <class T>
inline T pi() {
  return RealTraits<T>::pi();
}

template <class T>
inline double to_double(const T& x) {
  return RealTraits<T>::to_double(x);
}

template <class T>
inline double epsilon() {
  return RealTraits<T>::epsilon();
}

}  // namespace v0
}  // namespace polhode
