// SPDX-License-Identifier: MIT
// The arithmetic-geometric mean, and the complete elliptic integrals that it gives.
//
// Equations   K = integral of 1/D, E = of D, B = of cos^2/D, D = of sin^2/D, and
//             Pi(n) = of 1/((1 - n sin^2) D), each over [0, pi/2], with
//             D = sqrt(1 - m sin^2) = sqrt(cos^2 + m1 sin^2). K = B + D, E = B + m1 D.
//             cel(kc, p, a, b) = integral of (a cos^2 + b sin^2)/((cos^2 + p sin^2) D), kc^2 = m1
//             (Bulirsch 1969): one loop for all of them, with positive terms when a, b, p are.
//             Pi(n) at n > 1 is Cauchy's principal value -(m/n) int sin^2/((1 - (m/n) sin^2) D)
//             [DLMF 19.7.8 at pi/2]: one term, not K - Pi(m/n).
// Domain      agm: a, b >= 0. cel: kc >= 0, p > 0, otherwise NaN; at kc = 0 it returns its limit,
//             a RC(1, p) if b = 0 and +-inf otherwise. Arguments of any size: beyond 2^+-270 they
//             are led through WideRange. K, E, B, D: any m <= 1, m < 0 too; NaN at m > 1, where
//             they are complex. Pi: any n; inf at n = 1. At m1 = 0: K = D = Pi = inf (-inf for n >
//             1), E = B = 1 (and derivatives with respect to m are infinite: not given).
// Accuracy    budget elliptic_complete: relative, for all m1 down to the smallest double.
// Cost        each step one root and two divisions; quadratic: 2 to 5 steps for m < 0.99, at most
//             12 in double and 13 in DoubleDouble.
#pragma once

#include <cmath>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

template <Number T>
T agm(T a, T b);
template <Number T>
T cel(T kc, T p, T a, T b);

template <Number T>
T complete_k(const BasicModulus<T>& mod);
template <Number T>
T complete_e(const BasicModulus<T>& mod);
template <Number T>
T complete_b(const BasicModulus<T>& mod);
template <Number T>
T complete_d(const BasicModulus<T>& mod);
template <Number T>
T complete_pi(const T& n, const BasicModulus<T>& mod);

// The nome q and the complementary nome q1.
//
// Equations   q = exp(-pi K'/K), q1 = exp(-pi K/K'), ln q ln q1 = pi^2. The smaller of the two by
//             q = l + 2 l^5 + 15 l^9 + 150 l^13 + ..., l = (1 - sqrt k')/(2 (1 + sqrt k')), with
//             1 - sqrt k' from m; not from K'/K, whose exponential loses the digits of ln q.
// Domain      any m <= 1; q = 0 at m = 0, q = 1 at m1 = 0. m < 0: -q(-m/m1), theta functions of
//             argument shifted by a half period. m > 1: NaN, as q is complex.
// Accuracy    budget elliptic_nome: relative, however small; 1 - q near m1 = 0 is as a double is.
// Cost        two roots, a division and a polynomial; for m > 1/2 also log and exp.

template <Number T>
T nome(const BasicModulus<T>& mod);

template <Number T>
T complementary_nome(const BasicModulus<T>& mod);

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

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/agm.hpp"
#include "polhode/elliptic/detail/nome.hpp"
