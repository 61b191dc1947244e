// SPDX-License-Identifier: MIT
// In this header: number, real.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

// The concept Number: what a kernel may ask of the type that it computes with, be it one real
// number or a pack of them, one per lane.
//
// Units       none: a Number is a pure number.
// Domain      every Real (real.hpp), and packs of lanes. A pack offers + - * / and comparisons lane
//             by lane, conversion from a double, which goes to all lanes, and, found by
//             argument-dependent lookup, select, any, all and the functions that the kernel calls:
//             sqrt, abs, rint and floor; sin, cos, exp, ... A comparison of packs is a mask: one
//             truth value per lane, with !, && and || lane by lane and construction from a bool.
//             LaneTraits reads and writes single lanes.
// Accuracy    select returns one of its arguments, bit by bit.
// Cost        select of scalars is a conditional expression.

// A kernel that runs on packs takes no branch on a value: it computes both sides and selects. A
// branch on any(mask) or all(mask) may leave out work whose result no lane takes.
template <class T>
constexpr T select(bool mask, const T& a, const T& b) {
  return mask ? a : b;
}
constexpr bool any(bool mask) { return mask; }
constexpr bool all(bool mask) { return mask; }

// f() where the mask holds and g() elsewhere, each computed only if some lane takes it.
template <class F, class G>
constexpr auto where(bool mask, const F& f, const G& g) {
  return mask ? f() : g();
}
template <class Mask, class F, class G>
auto where(const Mask& mask, const F& f, const G& g) {
  if (all(mask)) return f();
  if (!any(mask)) return g();
  return select(mask, f(), g());
}

template <class T>
concept Number = std::copyable<T> && std::constructible_from<T, double> && requires(T a, T b) {
  { a + b } -> std::convertible_to<T>;
  { a - b } -> std::convertible_to<T>;
  { a* b } -> std::convertible_to<T>;
  { a / b } -> std::convertible_to<T>;
  { -a } -> std::convertible_to<T>;
  { select(a < b, a, b) } -> std::convertible_to<T>;
  { select(a == b, a, b) } -> std::convertible_to<T>;
  { any(a < b) } -> std::convertible_to<bool>;
  { all(a < b) } -> std::convertible_to<bool>;
};

// What a comparison yields: bool, or one bool per lane.
template <class T>
using Mask = decltype(std::declval<const T&>() < std::declval<const T&>());

// The lanes of a pack; specialized next to its type. A scalar is a pack of one.
template <class T>
struct LaneTraits {
  using Scalar = T;
  static constexpr std::size_t count = 1;
  static const T& get(const T& x, std::size_t /*lane*/) { return x; }
  static void set(T& x, std::size_t /*lane*/, const T& value) { x = value; }
  static void set_mask(bool& mask, std::size_t /*lane*/, bool value) { mask = value; }
};
template <class T>
using ScalarOf = typename LaneTraits<T>::Scalar;

// f of each lane by itself: for the rare pack in which some lane needs another way.
template <class T, class F, class... Rest>
T each_lane(const F& f, const T& x, const Rest&... rest) {
  using L = LaneTraits<T>;
  T r(0.0);
  for (std::size_t i = 0; i < L::count; ++i)
    L::set(r, i, f(L::get(x, i), LaneTraits<Rest>::get(rest, i)...));
  return r;
}

// The concept Real: one real number, ordered by <. Decisions, loops to convergence and formulas of
// the user are written with it; kernels that packs of lanes run too ask for a Number (number.hpp).
//
// Units       none: a Real is a pure number.
// Domain      double, DoubleDouble, Dual<T, N>, and any multiprecision type with the same
//             operators.
// Accuracy    constants are correct to the last digit of T.
// Cost        pi<T>() is a constant for double and DoubleDouble; other types call atan once per
//             use.

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
