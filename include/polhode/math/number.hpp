// SPDX-License-Identifier: MIT
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
#pragma once

#include <concepts>
#include <cstddef>
#include <utility>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
