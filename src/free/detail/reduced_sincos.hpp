// SPDX-License-Identifier: MIT
// Sine and cosine of an angle already reduced to about [-pi, pi], given as an unevaluated sum.
//
// A kernel that has reduced its phase in double-double need not pay the C library for a second
// reduction, and the same bits must come out on every processor and in every lane.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "polhode/math/error_free.hpp"
#include "polhode/math/trigonometry.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// |a.hi| <= 4, |a.lo| <= ulp(a.hi). Taylor polynomials on [-pi/4, pi/4]: the first terms left out
// are (pi/4)^19 / 19! and (pi/4)^18 / 18!, both below 2^-58.
[[gnu::always_inline]] inline SinCos<double> reduced_sincos(const TwoTerms<double>& a) {
  constexpr double two_over_pi = 0.6366197723675814;
  // pi/2 in three parts; the first two have 33 bits, so that their products with |k| <= 3 are
  // exact.
  constexpr double part1 = 0x1.921fb544p+0, part2 = 0x1.0b4611a6p-34, part3 = 0x1.3198a2e037073p-69;
  // Adding 1.5 2^52 rounds to an integer and leaves it in the low bits; NaN does no harm.
  constexpr double integer_bits = 0x1.8p52;
  const double shifted = a.hi * two_over_pi + integer_bits;
  const double k = shifted - integer_bits;
  const double r = (a.hi - k * part1) - k * part2;
  const double tail = a.lo - k * part3;
  const double z = r * r;
  const double sin_sum =
      z * (-1.0 / 6 +
           z * (1.0 / 120 +
                z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                            z * (1.0 / 6227020800.0 +
                                                                 z * (-1.0 / 1307674368000.0 +
                                                                      z / 355687428096000.0)))))));
  const double cos_sum =
      z * z *
      (1.0 / 24 +
       z * (-1.0 / 720 +
            z * (1.0 / 40320 +
                 z * (-1.0 / 3628800 + z * (1.0 / 479001600.0 +
                                            z * (-1.0 / 87178291200.0 + z / 20922789888000.0))))));
  const double sine = r + (r * sin_sum + tail);
  const double half_z = 0.5 * z;
  const double w = 1.0 - half_z;
  const double cosine = w + (((1.0 - w) - half_z) + (cos_sum - r * tail));
  // Quarter turns: k mod 4 decides which is which, and the signs; by bits, as a branch that depends
  // on the phase is mispredicted half of the time.
  const auto quarter = std::bit_cast<std::uint64_t>(shifted);
  auto first = std::bit_cast<std::uint64_t>(sine);
  auto second = std::bit_cast<std::uint64_t>(cosine);
  const std::uint64_t swapped = (first ^ second) & (0 - (quarter & 1));
  first = (first ^ swapped) ^ ((quarter & 2) << 62);
  second = (second ^ swapped) ^ (((quarter + 1) & 2) << 62);
  return {std::bit_cast<double>(first), std::bit_cast<double>(second)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
