// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Number T>
struct SeriesValues {
  T A, B, C, D;
};

// The four polynomials of a CayleyKleinSeries by Horner's rule, side by side.
template <class Series, Number T>
[[gnu::always_inline]] inline SeriesValues<T> polynomials_at(const Series& s, const T& y) {
  auto i = static_cast<std::size_t>(s.terms - 1);
  SeriesValues<T> r{s.A[i], s.B[i], s.C[i], s.D[i]};
  while (i-- > 0)  // <= 7 trips
    r = {r.A * y + s.A[i], r.B * y + s.B[i], r.C * y + s.C[i], r.D * y + s.D[i]};
  return r;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
