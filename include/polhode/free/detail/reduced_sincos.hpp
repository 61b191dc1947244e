// SPDX-License-Identifier: MIT
// Sine and cosine of an angle already reduced to about [-pi, pi], given as an unevaluated sum.
//
// A kernel that has reduced its phase in double-double need not pay the C library for a second
// reduction, and the same bits must come out on every processor and in every lane.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Sine and cosine after k quarter turns: k mod 4 decides which is which, and the signs. shifted is
// k + 1.5 2^52, with k in its low bits.
template <Number T>
SinCos<T> quarters_turned(const T& sine, const T& cosine, const T& /*shifted*/, const T& k) {
  using std::floor;
  const T quarter = k - T(4.0) * floor(T(0.25) * k);
  const auto odd = quarter == T(1.0) || quarter == T(3.0);
  const T first = select(odd, cosine, sine), second = select(odd, sine, cosine);
  return {select(quarter >= T(2.0), T(-first), first),
          select(quarter == T(1.0) || quarter == T(2.0), T(-second), second)};
}
// By bits, as a branch that depends on the phase is mispredicted half of the time.
[[gnu::always_inline]] inline SinCos<double> quarters_turned(double sine, double cosine,
                                                             double shifted, double /*k*/) {
  const auto quarter = std::bit_cast<std::uint64_t>(shifted);
  auto first = std::bit_cast<std::uint64_t>(sine);
  auto second = std::bit_cast<std::uint64_t>(cosine);
  const std::uint64_t swapped = (first ^ second) & (0 - (quarter & 1));
  first = (first ^ swapped) ^ ((quarter & 2) << 62);
  second = (second ^ swapped) ^ (((quarter + 1) & 2) << 62);
  return {std::bit_cast<double>(first), std::bit_cast<double>(second)};
}

// |a.hi| <= 4, |a.lo| <= ulp(a.hi). Taylor polynomials on [-pi/4, pi/4]: the first terms left out
// are (pi/4)^19 / 19! and (pi/4)^18 / 18!, both below 2^-58.
template <Number T>
[[gnu::always_inline]] inline SinCos<T> reduced_sincos(const TwoTerms<T>& a) {
  const T two_over_pi(0.6366197723675814);
  // pi/2 in three parts; the first two have 33 bits, so that their products with |k| <= 3 are
  // exact.
  const T part1(0x1.921fb544p+0), part2(0x1.0b4611a6p-34), part3(0x1.3198a2e037073p-69);
  // Adding 1.5 2^52 rounds to an integer and leaves it in the low bits; NaN does no harm.
  const T integer_bits(0x1.8p52);
  const T shifted = a.hi * two_over_pi + integer_bits;
  const T k = shifted - integer_bits;
  const T r = (a.hi - k * part1) - k * part2;
  const T tail = a.lo - k * part3;
  const T z = r * r;
  const T sin_sum =
      z * (T(-1.0 / 6) +
           z * (T(1.0 / 120) +
                z * (T(-1.0 / 5040) +
                     z * (T(1.0 / 362880) +
                          z * (T(-1.0 / 39916800) + z * (T(1.0 / 6227020800.0) +
                                                         z * (T(-1.0 / 1307674368000.0) +
                                                              z * T(1.0 / 355687428096000.0))))))));
  const T cos_sum =
      z * z *
      (T(1.0 / 24) + z * (T(-1.0 / 720) +
                          z * (T(1.0 / 40320) + z * (T(-1.0 / 3628800) +
                                                     z * (T(1.0 / 479001600.0) +
                                                          z * (T(-1.0 / 87178291200.0) +
                                                               z * T(1.0 / 20922789888000.0)))))));
  const T sine = r + (r * sin_sum + tail);
  const T half_z = T(0.5) * z;
  const T w = T(1.0) - half_z;
  const T cosine = w + (((T(1.0) - w) - half_z) + (cos_sum - r * tail));
  return quarters_turned(sine, cosine, shifted, k);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
