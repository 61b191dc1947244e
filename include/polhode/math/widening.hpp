// SPDX-License-Identifier: MIT
// Widening: which numbers have the exponents of double, and the same numbers with a WideRange in
// their heart: for the few arguments between which a formula would overflow or underflow.
//
// Units       those of the number.
// Domain      double, DoubleDouble and Duals of them have a wide form; others have none.
// Accuracy    exact there; back, 0 or inf where T has no room.
// Cost        a few flops.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>

#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/wide_range.hpp"

namespace polhode {
inline namespace v0 {

// double, DoubleDouble and Duals of them: the types whose exponents are those of double. The same
// number with WideRange in its heart, and back.
template <class T>
struct Widening {
  static constexpr bool exists = false;
};
template <class T>
  requires(std::same_as<T, double> || std::same_as<T, DoubleDouble>)
struct Widening<T> {
  static constexpr bool exists = true;
  using Wide = WideRange<T>;
  static Wide widened(const T& x) { return x; }
  static T narrowed(const Wide& x) { return x.narrow(); }
};
template <Real T, int N>
  requires Widening<T>::exists
struct Widening<Dual<T, N>> {
  static constexpr bool exists = true;
  using Wide = Dual<typename Widening<T>::Wide, N>;
  static Wide widened(const Dual<T, N>& x) {
    Wide r(Widening<T>::widened(x.value));
    for (std::size_t i = 0; i < Wide::size; ++i)
      r.derivative[i] = Widening<T>::widened(x.derivative[i]);
    return r;
  }
  static Dual<T, N> narrowed(const Wide& x) {
    Dual<T, N> r(Widening<T>::narrowed(x.value));
    for (std::size_t i = 0; i < Wide::size; ++i)
      r.derivative[i] = Widening<T>::narrowed(x.derivative[i]);
    return r;
  }
};
template <class T>
concept NarrowRange = Widening<T>::exists;

template <NarrowRange T>
auto widened(const T& x) {
  return Widening<T>::widened(x);
}

template <class T>
inline constexpr bool is_wide = false;
template <class T>
inline constexpr bool is_wide<WideRange<T>> = true;
template <class T, int N>
inline constexpr bool is_wide<Dual<T, N>> = is_wide<T>;

template <class T>
int binary_exponent(const WideRange<T>& x) {
  return x.binary_exponent();
}
template <class T, int N>
int binary_exponent(const Dual<T, N>& x) {
  return binary_exponent(x.value);
}

// Whether every one of them is 0 or of a size in [least, most].
template <class... T>
bool within(double least, double most, const T&... x) {
  const auto fits = [&](double a) { return a == 0.0 || (a >= least && a <= most); };
  return (fits(std::abs(to_double(x))) && ...);
}

// The same of every lane of packs.
template <class Pack, class... Rest>
  requires(!Real<Pack>)
bool lanes_within(double least, double most, const Pack& x, const Rest&... rest) {
  const auto fits = [&](const Pack& y) {
    using std::abs;
    const Pack size = abs(y), zero(0.0);
    return size == zero || (size >= Pack(least) && size <= Pack(most));
  };
  return all(fits(x)) && (all(fits(rest)) && ...);
}

}  // namespace v0
}  // namespace polhode
