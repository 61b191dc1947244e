// SPDX-License-Identifier: MIT
// The polhode of an action in each lane: with y = 1 - a3/G, a3 the largest momentum along the axis
// that is circulated about, the deficit d of the action is a convex function of y, and
// d' = sqrt(1 + kappa^2) 2K / pi. It lies between its chord and its tangent at y = 0, so Newton's
// steps from between these settle soon. docs/design/0036-threads-and-the-way-back.md.
#pragma once

#include "polhode/math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The deficit of an action at y, and its derivative.
template <class T>
struct DeficitSlope {
  T deficit, slope;
};

// A polhode by y, for momentum 1.
template <class T>
struct PolhodeOfDeficit {
  T a3, r2, k2, kp2;
};
template <class T>
[[gnu::always_inline]] inline PolhodeOfDeficit<T> polhode_at(const T& y, const T& kap2,
                                                             const T& most, const T& least) {
  const T one(1.0), s = one - y, over = one / (s * s);
  const T r2 = y * (one + s) * over;
  return {s, r2, kap2 * r2, (one + kap2) * (most - y) * (s + least) * over};
}

template <class T>
[[gnu::always_inline]] inline DeficitSlope<T> deficit_at(const PolhodeOfDeficit<T>& c, const T& y,
                                                         const T& root_of_kap2) {
  const T one(1.0), two(2.0);
  T kc = sqrt(c.kp2), product = kc, mean = one, p = one / c.a3, inverse_p = c.a3, a = one, b(0.0);
#pragma GCC unroll 7
  for (int n = 0; n < 7; ++n) {  // Bulirsch's loop for cel(k', 1 + r2, 1, 0)
    const T part = product * inverse_p;
    const T next_a = a + b * inverse_p;
    b = two * (a * part + b);
    a = next_a;
    p = part + p;
    mean = kc + mean;
    if (n < 6) kc = two * sqrt(product);
    product = kc * mean;
    if (n < 6) inverse_p = one / p;
  }
  const T cel = (b + a * mean) / (mean * (mean + p));
  return {root_of_kap2 * (y * (one + c.a3) / c.a3) * cel, root_of_kap2 * (T(128.0) / mean)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
