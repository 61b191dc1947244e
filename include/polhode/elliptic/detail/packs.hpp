// SPDX-License-Identifier: MIT
// What the kernels of packs share: decisions, which are made in double for every type of number, so
// that a lane decides as its number does alone; and the way lane by lane.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

// Numbers rounded to double: of a scalar a double, of a pack the pack of them.
template <Number T>
using Rounded = std::conditional_t<Real<T>, double, T>;

// f(x, rest...) computed in double.
template <class F, Number T, class... Rest>
Rounded<T> in_double(const F& f, const T& x, const Rest&... rest) {
  if constexpr (Real<T>) {
    return f(to_double(x), to_double(rest)...);
  } else if constexpr (std::same_as<ScalarOf<T>, double>) {
    return f(x, rest...);
  } else {
    return each_lane([&](const auto&... lane) { return ScalarOf<T>(f(to_double(lane)...)); }, x,
                     rest...);
  }
}
template <Number T>
Rounded<T> rounded(const T& x) {
  return in_double([](const auto& v) { return v; }, x);
}
template <Number T>
Rounded<T> rounded_size(const T& x) {
  return in_double(
      [](const auto& v) {
        using std::abs;
        return abs(v);
      },
      x);
}

template <Number T>
T largest(const T& a, const T& b) {
  return select(a < b, b, a);
}

// f(lane of x, ..., modulus of the lane): for packs in which some lane is not ordinary.
template <class F, Number Pack, class... Rest>
Pack each_lane_of(const F& f, const BasicModulus<Pack>& mod, const Rest&... x) {
  using L = LaneTraits<Pack>;
  Pack r(0.0);
  for (std::size_t i = 0; i < L::count; ++i) L::set(r, i, f(L::get(x, i)..., mod.lane(i)));
  return r;
}
// Whether 0 <= m < 1 in every lane.
template <Number Pack>
bool all_before_separatrix(const BasicModulus<Pack>& mod) {
  return all(mod.m() >= Pack(0.0) && mod.m1() > Pack(0.0));
}

}  // namespace detail
}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
