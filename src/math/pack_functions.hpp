// SPDX-License-Identifier: MIT
// Sines, cosines, angles and a few more functions of packs, with the same bits by every set of
// instructions.
//
// Equations   sin, cos; atan2(y, x) = arg(x + i y).
// Units       radians.
// Domain      any numbers. Angles beyond 1e6, and pairs whose size or ratio is beyond 2^500 and
//             2^200, go through the C library lane by lane. Signs of zeros as in <cmath>, but the
//             sine of -0 is 0.
// Accuracy    budgets pack_sincos_ulp, pack_atan2_ulp and others of packs in tests/budgets.hpp:
//             sines, cosines and atan2 below one unit in the last place. Not the bits of <cmath>.
// Errors      none; NaN in, NaN out, in the same lane; NaN for the sine of an infinity.
// Cost        some 35 multiplications, and one division for atan2, for all lanes.
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

#include "polhode/detail/math/pack.hpp"
#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/math/detail/circular_sums.hpp"
#include "polhode/math/detail/near_angle.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {

template <InstructionSet isa>
[[gnu::always_inline]] inline SinCos<Pack<isa>> sincos(const Pack<isa>& x) {
  using T = Pack<isa>;
  // pi/2 in three parts; the first two have 33 bits, so that their products with k are exact.
  const T part1(0x1.921fb544p+0), part2(0x1.0b4611a6p-34), part3(0x1.3198a2e037073p-69);
  const T integer_bits(0x1.8p52);  // adding it rounds to an integer, left in the low bits
  const T shifted = x * T(0.6366197723675814) + integer_bits;
  const T k = shifted - integer_bits;
  const TwoTerms<T> most = two_sum(T(x - k * part1), T(-(k * part2)));
  const TwoTerms<T> rest = quick_two_sum(most.hi, T(most.lo - k * part3));
  const T r = rest.hi, tail = rest.lo;
  const T z = r * r;
  const T half_z = T(0.5) * z, w = T(1.0) - half_z;
  const T sine = r + (r * detail::sine_sum(z) + w * tail);
  const T cosine = w + (((T(1.0) - w) - half_z) + (detail::cosine_sum(z) - r * tail));
  const SinCos<T> near = quarters_turned(sine, cosine, shifted, k);
  const auto far = abs(x) > T(1e6);
  if (!any(far)) return near;
  return {select(far, each_lane([](double a) { return std::sin(a); }, x), near.sin),
          select(far, each_lane([](double a) { return std::cos(a); }, x), near.cos)};
}
// The same to the last bit, for angles that are mostly within 45 degrees: half as long.
template <InstructionSet isa>
[[gnu::always_inline]] inline SinCos<Pack<isa>> sincos_of_small(const Pack<isa>& x) {
  using T = Pack<isa>;
  if (any(!(abs(x) < T(0.785)))) return sincos(x);
  const T r = x + T(0.0), z = r * r;  // of -0 as of 0
  const T half_z = T(0.5) * z, w = T(1.0) - half_z;
  return {r + r * detail::sine_sum(z), w + (((T(1.0) - w) - half_z) + detail::cosine_sum(z))};
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> sin(const Pack<isa>& x) {
  return sincos(x).sin;
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> cos(const Pack<isa>& x) {
  return sincos(x).cos;
}

template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> atan2(const Pack<isa>& y, const Pack<isa>& x) {
  using T = Pack<isa>;
  const T zero(0.0), ax = abs(x), ay = abs(y);
  const auto steep = ax < ay, left = signbit(x);
  const T d = select(steep, ay, ax), n = select(steep, ax, ay);
  const detail::NearAngle<T> a = detail::near_angle(n, d);
  const T sum = detail::atan_sum(T(a.u * a.u));
  // pi/2 -+ a where |y| is the larger, else a or pi - a
  const auto falls = steep != left;
  const T base_hi =
      select(steep, T(0x1.921fb54442d00p+0), select(left, T(0x1.921fb54442d00p+1), zero));
  const T base_lo =
      select(steep, T(0x1.8469898cc5170p-48), select(left, T(0x1.8469898cc5170p-47), zero));
  const T from = base_hi + negated(falls, a.from_hi);
  const T u = negated(falls, a.u);
  const TwoTerms<T> s = quick_two_sum(from, u);
  const T rest = negated(falls, T(a.more + a.u * sum + a.from_lo)) + base_lo;
  const T usual = negated(signbit(y), T(s.hi + (s.lo + rest)));
  const auto odd = !(d < T(0x1p500) && d > T(0x1p-500) && (n == zero || n > T(0x1p-200) * d));
  if (!any(odd)) return usual;
  return select(odd, each_lane([](double b, double c) { return std::atan2(b, c); }, y, x), usual);
}

// The angle of a tangent within +-1/4.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> small_atan(const Pack<isa>& t) {
  return t + t * detail::atan_sum(Pack<isa>(t * t));
}

// e^x for -700 <= x <= 0, to a unit in the last place or two; of less, that of -700.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> exp_of_negative(const Pack<isa>& given) {
  using T = Pack<isa>;
  const T x = select(given < T(-700.0), T(-700.0), given);
  const T integer_bits(0x1.8p52);
  const T shifted = x * T(1.4426950408889634) + integer_bits;
  const T k = shifted - integer_bits;
  // ln 2 in two parts, the first of 33 bits
  const T r = (x - k * T(0x1.62e42fefp-1)) - k * T(0x1.473de6af278edp-34);
  const T r2 = r * r, r4 = r2 * r2;
  const T sum =
      (T(0.5) + r * T(1.0 / 6)) + r2 * (T(1.0 / 24) + r * T(1.0 / 120)) +
      r4 * ((T(1.0 / 720) + r * T(1.0 / 5040)) + r2 * (T(1.0 / 40320) + r * T(1.0 / 362880)) +
            r4 * ((T(1.0 / 3628800) + r * T(1.0 / 39916800)) +
                  r2 * (T(1.0 / 479001600.0) + r * T(1.0 / 6227020800.0))));
  return (T(1.0) + (r + r2 * sum)) * power_of_two(shifted);
}

// ln x of a normal number, with an error of some eps max(1, |ln x|).
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> log_of(const Pack<isa>& x) {
  using T = Pack<isa>;
  const auto m = halves_off(x);  // in [1/sqrt 2, sqrt 2)
  const T s = (m.part - T(1.0)) / (m.part + T(1.0));
  const T z = s * s, z2 = z * z, z4 = z2 * z2;
  // 2 artanh s, |s| < 0.1716
  const T sum = ((T(1.0 / 3) + z * T(1.0 / 5)) + z2 * (T(1.0 / 7) + z * T(1.0 / 9))) +
                z4 * ((T(1.0 / 11) + z * T(1.0 / 13)) + z2 * (T(1.0 / 15) + z * T(1.0 / 17)));
  const T twice = s + s;
  return m.exponent * T(0.6931471805599453) + (twice + twice * (z * sum));
}

}  // namespace v0
}  // namespace polhode
