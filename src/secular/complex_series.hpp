// SPDX-License-Identifier: MIT
// Two real series as one complex series, for what turns with angles.
#pragma once

#include <string_view>
#include <utility>

#include "polhode/series/product.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct ComplexSeries {
  Series<double> re, im;
};

inline ComplexSeries operator+(const ComplexSeries& a, const ComplexSeries& b) {
  return {a.re + b.re, a.im + b.im};
}
inline ComplexSeries operator-(const ComplexSeries& a, const ComplexSeries& b) {
  return {a.re - b.re, a.im - b.im};
}
inline ComplexSeries conj(const ComplexSeries& a) { return {a.re, -a.im}; }
inline ComplexSeries times_i(const ComplexSeries& a) { return {-a.im, a.re}; }

inline ComplexSeries product(const Series<double>& a, const ComplexSeries& b,
                             const Truncation& keep) {
  return {product(a, b.re, keep), product(a, b.im, keep)};
}

// a exp(i n angle).
inline ComplexSeries turned(const ComplexSeries& a, const Multiples& by, const Truncation& keep) {
  const Series<double> c = cosine(a.re.symbols(), 1.0, {}, by),
                       s = sine(a.re.symbols(), 1.0, {}, by);
  return {product(a.re, c, keep) - product(a.im, s, keep),
          product(a.re, s, keep) + product(a.im, c, keep)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
