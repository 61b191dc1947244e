// SPDX-License-Identifier: MIT
// Kepler's equation of ellipses on packs; one number is a lane of a pack of the least registers.
#pragma once

#include <numbers>

#include "math/pack_functions.hpp"
#include "polhode/detail/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class T>
struct EllipticAnomaly {
  T anomaly, sine, versine;  // versine = 1 - cos E
};

// The cube root of x >= 0, to 1.4e-6; below 1e-300 that of 1e-300.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> rough_cube_root(const Pack<isa>& x) {
  using T = Pack<isa>;
  const T least(1e-300);
  const auto scaled = halves_off(select(x < least, least, x));
  const T integer_bits(0x1.8p52);
  const T shifted = scaled.exponent * T(1.0 / 3.0) + integer_bits;
  const T left = scaled.exponent - T(3.0) * (shifted - integer_bits);  // -1, 0 or 1
  const T s = scaled.part - T(1.0), s2 = s * s;
  const T root = (T(0.999999130095339141) + s * T(0.33331855484225717)) +
                 s2 * ((T(-0.110976225568213929) + s * T(0.0623499036948206663)) +
                       s2 * (T(-0.0446401165153598897) + s * T(0.0264541540137150051)));
  const T rest = select(left < T(0.0), T(0.79370052598409974),
                        select(left > T(0.0), T(1.2599210498948732), T(1.0)));
  return root * rest * power_of_two(shifted);
}

// x - sin x without cancellation, given s = sin x, for 0 <= x <= 4.
template <class T>
[[gnu::always_inline]] inline T sine_excess_of_packs(const T& x, const T& s) {
  // to 1e-18 for x < 1.6; in pairs, for a short chain of operations
  const T z = x * x, z2 = z * z, z4 = z2 * z2;
  const T low = (T(1.0 / 6) - z * T(1.0 / 120)) + z2 * (T(1.0 / 5040) - z * T(1.0 / 362880));
  const T high = (T(1.0 / 39916800) - z * T(1.0 / 6227020800.0)) +
                 z2 * (T(1.0 / 1307674368000.0) - z * T(1.0 / 355687428096000.0));
  const T sum =
      low +
      z4 * (high + z4 * (T(1.0 / 121645100408832000.0) - z * T(1.0 / 51090942171709440000.0)));
  return select(x < T(1.6), x * z * sum, x - s);
}

// For 0 <= m <= pi, 0 <= e < 1, complement = 1 - e. Markley (1995), section 2: the root of a cubic
// from a Pade approximant of sin E; and section 4: a step of fifth order from there.
template <InstructionSet isa>
[[gnu::always_inline]] inline EllipticAnomaly<Pack<isa>> elliptic_solution(
    const Pack<isa>& m, const Pack<isa>& e, const Pack<isa>& complement) {
  using T = Pack<isa>;
  constexpr double pi = std::numbers::pi, part = 1.0 / (pi * pi - 6.0);
  const T zero(0.0), one(1.0), half(0.5);
  const T alpha = T(3.0 * pi * pi * part) + (T(1.6 * pi * part) / (one + e)) * (T(pi) - m);
  const T d = T(3.0) * complement + alpha * e, m2 = m * m;
  const T q = T(2.0) * alpha * d * complement - m2;
  const T r = (T(3.0) * alpha * d * (d - complement) + m2) * m;
  const T root = rough_cube_root(T(r + sqrt(T(q * q * q + r * r))));
  const T w = root * root;
  const T denominator = w * w + w * q + q * q;
  // 0 only where its terms are smaller than the smallest number
  const T x = select(denominator > zero, T(T(2.0) * r * w + m * denominator), m) /
              (d * select(denominator > zero, denominator, one));

  const SinCos<T> at = sincos(x);
  const T &s = at.sin, &c = at.cos;
  const auto ahead = c > zero;
  const T v = select(ahead, T(s * s), T(one - c)) / select(ahead, T(one + c), one);
  const T f0 = (complement * x - m) + e * sine_excess_of_packs(x, s);
  const T f1 = complement + e * v, f2 = half * e * s, f3 = e * c * T(1.0 / 6.0);
  // of third order to its own order, for what d4 needs: 1 / f1 does not wait for f0
  const T inverse = one / f1, d1 = -f0 * inverse, d3 = d1 - d1 * (d1 * (f2 * inverse));
  const T d4 = -f0 / (f1 + d3 * (f2 + d3 * f3));
  const T step = -f0 / (f1 + d4 * (f2 + d4 * (f3 - d4 * f2 * T(1.0 / 12.0))));
  // |step| < 1e-3: sin and cos of x + step by the addition theorem
  const T dd = step * step;
  const T sd = step - step * dd * T(1.0 / 6.0) * (one - dd * T(1.0 / 20.0));
  const T vd = half * dd * (one - dd * T(1.0 / 12.0) * (one - dd * T(1.0 / 30.0)));
  return {x + step, s + (c * sd - s * vd), v + (s * sd + c * vd)};
}

// For |M| <= pi; NaN where e is not in [0, 1) or M is none.
template <InstructionSet isa>
[[gnu::always_inline]] inline EllipticAnomaly<Pack<isa>> elliptic_anomaly(
    const Pack<isa>& M, const Pack<isa>& e, const Pack<isa>& complement) {
  using T = Pack<isa>;
  const EllipticAnomaly<T> x = elliptic_solution(abs(M), e, complement);
  const auto negative = signbit(M);
  const auto sound = abs(M) < T(4.0) && e >= T(0.0) && complement > T(0.0);
  const T nan(__builtin_nan(""));
  return {select(sound, negated(negative, x.anomaly), nan),
          select(sound, negated(negative, x.sine), nan), select(sound, x.versine, nan)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
