// SPDX-License-Identifier: MIT
// HalfTurns: any angle as a number of half turns and what is left, for integrals that are
// quasi-periodic.
//
// Equations   phi = turns pi + atan2(s, c), c >= 0: s = (-1)^turns sin phi, c = |cos phi|. The sine
//             and cosine are those of phi itself, never of a rounded phi - turns pi.
// Units       phi in radians.
// Domain      any phi; NaN for infinities. Beyond 2^52 half turns the number is good to its own
//             rounding, its parity is that of the cosine.
// Accuracy    that of sincos, for every phi in double and for |phi| <= 1e10 in DoubleDouble.
// Cost        one sincos and a division.
#pragma once

#include <cmath>

#include "polhode/math/real.hpp"
#include "polhode/math/trigonometry.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct HalfTurns {
  T turns;
  T s;
  T c;
};

template <Number T>
HalfTurns<T> half_turns(const T& phi) {
  using std::floor;
  using std::round;
  const T zero(0.0), one(1.0);
  const auto [s, c] = sincos(phi);
  const T turns = round(phi / pi<T>());
  const auto odd = !(turns == 2.0 * floor(T(0.5 * turns)));
  const auto left = c < zero;
  // At an odd quarter the quotient can round to the wrong side: the cosine knows.
  const T mended = where(
      odd != left,
      [&]() -> T { return select(phi - turns * pi<T>() < zero, T(turns - one), T(turns + one)); },
      [&]() -> T { return turns; });
  return {mended, select(left, T(-s), T(s)), select(left, T(-c), T(c))};
}

}  // namespace v0
}  // namespace polhode
