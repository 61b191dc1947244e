// SPDX-License-Identifier: MIT
// Jacobi's sn, cn, dn in lanes by theta functions, for every modulus:
// docs/design/0040-jacobi-in-lanes.md.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "math/pack_functions.hpp"
#include "polhode/detail/math/pack.hpp"
#include "polhode/detail/math/trigonometry.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

// The bits of so many numbers, to be shifted without their sign, which only AVX-512 does with it.
template <std::size_t width>
struct UnsignedBits;
template <>
struct UnsignedBits<2> {
  using Type = std::uint64_t __attribute__((vector_size(16)));
};
template <>
struct UnsignedBits<4> {
  using Type = std::uint64_t __attribute__((vector_size(32)));
};
template <>
struct UnsignedBits<8> {
  using Type = std::uint64_t __attribute__((vector_size(64)));
};

// x^(-1/4) of 0.14 <= x <= 1 to 6e-7: a guess by the bits of the exponent, then its minimax error.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> rough_inverse_fourth_root(const Pack<isa>& x) {
  using T = Pack<isa>;
  using Bits = typename UnsignedBits<T::width>::Type;
  const Bits bits = std::bit_cast<Bits>(x.lanes);
  const T guess(std::bit_cast<typename T::Doubles>(0x4fde26e978d4fdf4 - (bits >> 2)));
  const T square = guess * guess, p = square * (square * x);
  return guess * ((T(2.6319472294458949719) + p * T(-14.058585617912818147)) +
                  (p * p) * (T(69.455690089183824745) + p * T(-142.38078230420829666)));
}
// x^(1/4), one step of the third order from y, nearly x^(-1/4).
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> fourth_root(const Pack<isa>& x, const Pack<isa>& y) {
  using T = Pack<isa>;
  const T s = (y * y) * (y * x);
  const T r = T(1.0) - s * y;
  return s + (s * r) * (T(0.75) + r * T(0.65625));
}

// Of s = m1^(1/4): l, whose square is the k of the second step down; z = l^4 < 0.00337.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> second_root(const Pack<isa>& s) {
  using T = Pack<isa>;
  const T half = T(0.5) * s;
  return (T(0.5) - half) / (T(0.5) + half);
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> trigonometric_nome(const Pack<isa>& l) {
  using T = Pack<isa>;
  const T l2 = l * l, z = l2 * l2;
  return l *
         (T(0.5) + z * ((T(0.062499999999989902819) + z * T(0.029296875095880446983)) +
                        (z * z) * (T(0.018310404668856500093) + z * T(0.013090822337804193393))));
}
// 1 / K.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> trigonometric_rate(const Pack<isa>& s, const Pack<isa>& l) {
  using T = Pack<isa>;
  const T l2 = l * l, z = l2 * l2, p = T(0.5) + T(0.5) * s;
  const T sum = (T(0.15915494309188177) + z * T(0.049735919845014382)) +
                (z * z) * (T(0.027354564814673351) + z * T(0.018314156538487318));
  return (p * p) * (T(0.63661977236758134) - z * sum);
}

// Of x = u / K, quarter turns: with the nearest integer in the low bits.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> whole_quarters(const Pack<isa>& x) {
  return x + Pack<isa>(0x1.8p52);
}

// sin and cos of pi t / 2 for |t| <= 1/2, minimax to 2e-17 and 1e-19.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> quarter_sine(const Pack<isa>& t) {
  using T = Pack<isa>;
  const T z = t * t, z2 = z * z;
  const T sum = (T(-0.64596409750624617447) + z * T(0.079692626246144238546)) +
                z2 * ((T(-0.0046817541342542077094) + z * T(0.00016044116661409423795)) +
                      z2 * (T(-3.5987029509735104657e-6) + z * T(5.6422253691635282962e-8)));
  return t * (T(1.5707963267948966) + z * sum);
}
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> quarter_cosine(const Pack<isa>& t) {
  using T = Pack<isa>;
  const T z = t * t, z2 = z * z;
  const T sum = (T(0.25366950790104782321) + z * T(-0.020863480763340772521)) +
                z2 * ((T(0.00091926027454684461873) + z * T(-0.000025202039028029176105)) +
                      z2 * (T(4.7106784055052271063e-7) + z * T(-6.3293963449674235121e-9)));
  return (T(1.0) + z * T(-1.2337005501361698269)) + z2 * sum;
}

// x with its sign changed where the lowest bit of `turns` is set.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> turned_sign(const Pack<isa>& x, const Pack<isa>& turns) {
  using Bits = typename Pack<isa>::Bits;
  const Bits sign = std::bit_cast<Bits>(turns.lanes) << 63;
  return Pack<isa>(std::bit_cast<typename Pack<isa>::Doubles>(std::bit_cast<Bits>(x.lanes) ^ sign));
}

template <class T>
struct JacobiInLanes {
  T sn, cn, dn;
};

// sn, cn, dn in lanes for 1 - m >= 0.14, by theta functions of the nome's square and one ascending
// step of Landen's: docs/design/0040-jacobi-in-lanes.md.
//
// With s = m1^(1/4), x = pi u / (2 K) and theta of nome q^2:
//   D = theta4(x), T = theta3(x), A = sin x - q^4 sin 3x + q^12 sin 5x, B = cos x + q^4 cos 3x +
//   ... sn : cn : dn : 1 = D A / w : (D0^2 / (P Q)) B T : D^2 - 4 q A^2 : D^2 + 4 q A^2,
// D0 = theta4(0), P = theta3(0), Q = 1 + q^4 + q^12, w = P Q pi / (2 K) [DLMF 20.7, 22.7].
//
// Of the nome, sin x and cos x.
template <InstructionSet isa>
[[gnu::always_inline]] inline JacobiInLanes<Pack<isa>> trigonometric_jacobi(
    const Pack<isa>& q, const SinCos<Pack<isa>>& x) {
  using T = Pack<isa>;
  const T one(1.0), two(2.0);
  const T q2 = q * q, q4 = q2 * q2, q6 = q2 * q4, q8 = q4 * q4, q12 = q6 * q6;
  const T S = x.sin + x.sin;
  const T c = two - S * S, c2 = c * c;  // 2 cos 2x
  const T g = q2 * c, o = g * (q2 - q2 * q8);
  const T f = one + q8 * (c2 - two), e = (one - q4) + q12 * (c2 - one);
  const T A = S * (e - o), B = x.cos * (e + o);  // 2 A
  const T D = f - g, theta3 = f + g;
  const T D2 = D * D, A2 = q * (A * A);
  const T P = (one + q2) + (q6 + q12), D0 = one + two * (q8 - q2);
  const T K2 =
      one + two * ((q + q4) + (q * q8 + q8 * q8));  // theta3(0) of nome q: its square is 2 K / pi
  const T half_over = T(0.5) / (P * P);
  const T of_sn = (K2 * K2) * half_over, of_cn = (D0 * (D0 + D0)) * half_over;
  const T over = one / (D2 + A2);
  return {(D * A) * (of_sn * over), (B * theta3) * (of_cn * over), (D2 - A2) * over};
}

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

// sn, cn, dn in lanes for 0 < 1 - m < 0.14, by theta functions of the complementary nome:
// docs/design/0040-jacobi-in-lanes.md.
//
// With s = m^(1/4), v = pi u / (2 K') less periods of ln(1/q1), y = q1 cosh 2v, and theta of nome
// q1 and i v, over 2 q1^(1/4) where odd:
//   sn = theta1 / (s^2 theta2) ..., cn and dn = b theta4 / (s theta2), b theta3 / theta2,
// b = (1 + q1^2 + q1^6) / theta3(0)  [DLMF 22.6(iv), 20.2].
//
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
}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
