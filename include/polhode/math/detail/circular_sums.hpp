// SPDX-License-Identifier: MIT
// What sine and cosine are made of within an eighth of a turn.
#pragma once

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace detail {

// Minimax on [-pi/4, pi/4], to 6e-18 and 1.5e-19; in pairs, for a short chain of operations: sin r
// is r + r sine_sum(r^2), cos r is 1 - r^2 / 2 + cosine_sum(r^2).
template <class T>
[[gnu::always_inline]] inline T sine_sum(const T& z) {
  const T z2 = z * z;
  return z * ((T(-0.166666666666666421) + z * T(0.00833333333332365953)) +
              z2 * ((T(-0.000198412698301419668) + z * T(2.75573136509418872e-6)) +
                    z2 * (T(-2.50507344214099954e-8) + z * T(1.5894701645535202e-10))));
}
template <class T>
[[gnu::always_inline]] inline T cosine_sum(const T& z) {
  const T z2 = z * z;
  return z2 * ((T(0.0416666666666666513) + z * T(-0.00138888888888828375)) +
               z2 * ((T(0.0000248015872946264862) + z * T(-2.75573157380429347e-7)) +
                     z2 * (T(2.08758976450215912e-9) + z * T(-1.13679762881793603e-11))));
}

}  // namespace detail

}  // namespace v0
}  // namespace polhode
