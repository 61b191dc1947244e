// SPDX-License-Identifier: MIT
// sn, cn, dn in lanes for 0 < 1 - m < 0.14, by theta functions of the complementary nome:
// docs/design/0040-jacobi-in-lanes.md.
//
// With s = m^(1/4), v = pi u / (2 K') less periods of ln(1/q1), y = q1 cosh 2v, and theta of nome
// q1 and i v, over 2 q1^(1/4) where odd:
//   sn = theta1 / (s^2 theta2) ..., cn and dn = b theta4 / (s theta2), b theta3 / theta2,
// b = (1 + q1^2 + q1^6) / theta3(0)  [DLMF 22.6(iv), 20.2].
#pragma once

#include "elliptic/detail/jacobi_trigonometric.hpp"
#include "polhode/math/pack.hpp"
#include "polhode/math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// m^(1/4) of 0.86 < m <= 1.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> fourth_root_near_one(const Pack<isa>& m,
                                                             const Pack<isa>& m1) {
  using T = Pack<isa>;
  // m^(-1/4), minimax to 4e-7
  const T y = (T(0.99999963280552654242) + m1 * T(0.25008361574519751162)) +
              (m1 * m1) * (T(0.15332408498376404555) + m1 * T(0.14894098470465358938));
  return fourth_root(m, y);
}

// Of s = m^(1/4): l, whose square is the k' of the second step up; l^4 < 1.3e-7.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> complementary_root(const Pack<isa>& m1,
                                                           const Pack<isa>& s) {
  using T = Pack<isa>;
  const T p = T(0.5) + T(0.5) * s;
  // not (1 - s) / (1 + s): cancels
  return (T(0.25) * m1) / ((p * p) * (T(1.0) + s * s));
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> small_nome(const Pack<isa>& l) {
  using T = Pack<isa>;
  const T l2 = l * l, z = l2 * l2;
  return l * (T(0.5) + z * (T(0.0625) + z * T(0.029296875)));
}
// pi / (2 K').
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> hyperbolic_rate(const Pack<isa>& s, const Pack<isa>& l) {
  using T = Pack<isa>;
  const T p = T(0.5) + T(0.5) * s, l2 = l * l, z = l2 * l2;
  return (p * p) * (T(1.0) - z * (T(0.25) + z * T(0.078125)));
}

// How many whole periods are next to v.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> whole_periods(const Pack<isa>& v, const Pack<isa>& period) {
  using T = Pack<isa>;
  const T size = abs(v), half = T(0.5) * period;
  const T n = select(size > half, negated(signbit(v), T(1.0)), T(0.0));
  const auto far = size > T(3.0) * half;
  if (!any(far)) return n;
  return select(far, rint(T(v / period)), n);
}

// cosh and sinh r of |r| <= ln(2) / 2.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> small_cosh(const Pack<isa>& r) {
  using T = Pack<isa>;
  const T z = r * r, z2 = z * z;
  return T(1.0) + z * ((T(0.5) + z * T(1.0 / 24)) +
                       z2 * ((T(1.0 / 720) + z * T(1.0 / 40320)) +
                             z2 * (T(1.0 / 3628800) + z * T(1.0 / 479001600.0))));
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> small_sinh(const Pack<isa>& r) {
  using T = Pack<isa>;
  const T z = r * r, z2 = z * z;
  return r + r * (z * ((T(1.0 / 6) + z * T(1.0 / 120)) +
                       z2 * ((T(1.0 / 5040) + z * T(1.0 / 362880)) +
                             z2 * (T(1.0 / 39916800) + z * T(1.0 / 6227020800.0)))));
}

// v = k ln 2 + r: k in the low bits, and r.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> whole_doublings(const Pack<isa>& v) {
  return v * Pack<isa>(1.4426950408889634) + Pack<isa>(0x1.8p52);
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> rest_of_doublings(const Pack<isa>& v,
                                                          const Pack<isa>& doublings) {
  using T = Pack<isa>;
  const T k = doublings - T(0x1.8p52);
  // ln 2 in two parts, the first of 33 bits
  return (v - k * T(0x1.62e42fefp-1)) - k * T(0x1.473de6af278edp-34);
}
// 2^(k - 1) and 2^(-k - 1).
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> half_power(const Pack<isa>& doublings) {
  return power_of_two(Pack<isa>(doublings - Pack<isa>(1.0)));
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> half_inverse_power(const Pack<isa>& doublings) {
  return power_of_two(Pack<isa>(0x1.8p52 - 1.0) - (doublings - Pack<isa>(0x1.8p52)));
}

// s = m^(1/4), the nome, sinh and cosh of v less its whole periods, and these in the low bits.
template <InstructionSet isa>
[[gnu::always_inline]] inline JacobiInLanes<Pack<isa>> hyperbolic_jacobi(const Pack<isa>& s,
                                                                         const Pack<isa>& q,
                                                                         const Pack<isa>& sinh,
                                                                         const Pack<isa>& cosh,
                                                                         const Pack<isa>& periods) {
  using T = Pack<isa>;
  const T one(1.0), two(2.0);
  const T q2 = q * q, q4 = q2 * q2, q6 = q4 * q2, twice_q4 = q4 + q4;
  const T y = q + (q + q) * (sinh * sinh), y2 = y * y;
  const T e = (one - (q2 + q6)) + (T(4.0) * q4) * y2;
  const T o = y * ((q + q) * (one - q4));
  const T f = (one - twice_q4) + (T(4.0) * q2) * y2;
  const T g = y * (two + q6 * (T(8.0) * y2 - T(6.0) * q2));
  const T even = one + twice_q4;
  const T b = (T(0.5) + T(0.5) * s) * (one + (q2 + q6));
  const T over = one / ((s * even) * (cosh * (e + o)));
  const T signed_over = turned_sign(over, periods);
  return {(sinh * (e - o)) * (even * signed_over), (b * (f - g)) * signed_over,
          ((b * s) * (f + g)) * over};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
