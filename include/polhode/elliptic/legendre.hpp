// SPDX-License-Identifier: MIT
// Legendre's incomplete elliptic integrals of the first and second kind. The amplitude is an angle,
// or its sine and cosine.
//
// Equations   F = int 1/D, E = int D, D = int sin^2/D, B = int cos^2/D, each from 0 to phi, with
//             D(phi) = sqrt(1 - m sin^2) = sqrt(cos^2 + m1 sin^2). F = B + D, E = B + m1 D.
//             F and D by [DLMF 19.25.5, .13]; E by that of [DLMF 19.25.9, .10, .11] whose terms are
//             positive: m < 0, 0 <= m <= 1, m > 1. Beyond pi/2 by quasi-periodicity: F(phi + n pi)
//             = F(phi) + 2 n K.
// Units       none; phi in radians.
// Domain      phi: any, odd in phi; (sin phi, cos phi): phi in [-pi, pi]. m < 0 (imaginary
//             modulus): any phi. m > 1 (k > 1): |sin phi| <= 1/k before pi/2, otherwise NaN, as the
//             integrals are complex [DLMF 19.7(ii)]. At m1 = 0: F and D are inf at pi/2 and beyond.
//             Members, sines and cosines of any size: beyond 2^-900 .. 2^300 through WideRange.
//             Derivatives of Dual sines and cosines are those along the circle: dphi = c ds - s dc.
// Accuracy    budgets elliptic_legendre and elliptic_beyond: relative, for any phi in double (in
//             DoubleDouble for |phi| <= 1e10). Of an angle in double with m > 1, where 1 - m sin^2
//             cancels, the work is done in DoubleDouble.
// Cost        F, D, B: one RF or RD. E: one RF and one RD. Beyond pi/2 the complete integral as
//             well.
#pragma once

#include <cmath>
#include <limits>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

// phi = atan2(s, c).
template <Number T>
T legendre_f(const T& s, const T& c, const BasicModulus<T>& mod);
template <Number T>
T legendre_e(const T& s, const T& c, const BasicModulus<T>& mod);
// D = (F - E)/m, without its cancellation as m -> 0.
template <Number T>
T legendre_d(const T& s, const T& c, const BasicModulus<T>& mod);
// B = F - D = (E - m1 F)/m.
template <Number T>
T legendre_b(const T& s, const T& c, const BasicModulus<T>& mod);

// F of any angle phi [SA (A38)].
template <Number T>
T legendre_f(const T& phi, const BasicModulus<T>& mod);
// The others of any angle phi.
template <Number T>
T legendre_e(const T& phi, const BasicModulus<T>& mod);
template <Number T>
T legendre_d(const T& phi, const BasicModulus<T>& mod);
template <Number T>
T legendre_b(const T& phi, const BasicModulus<T>& mod);

// Heuman's Lambda0: the complete integral of the third kind of the circular case, made regular.
//
// Equations   Lambda0(psi) = (2/pi) [E F(psi|m1) + K (E(psi|m1) - F(psi|m1))]
//             = (2/pi) k' s P cel(k', P^2, 1, 1), P = k' c / sqrt(c^2 + m s^2), where (s, c) =
//             (sin psi, cos psi): one positive term. P^2 is not 1 - m/(1 - m1 s^2): that cancels.
// Units       none; psi in radians.
// Domain      any psi: Lambda0(psi + pi) = Lambda0(psi) + 2; m in [0, 1], otherwise NaN. At m = 0:
//             sin psi; at m1 = 0: 2 psi/pi; at psi = pi/2: 1. P is given to cel as it is, since P^2
//             underflows next to pi/2.
// Accuracy    budget elliptic_heuman: relative, for every m1.
// Cost        one sincos, two roots and one cel.

// psi in [-pi/2, pi/2], given by its sine and cosine.
template <Number T>
T heuman_lambda0(const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::atan2;
  using std::sqrt;
  const T zero(0.0), one(1.0);
  T square = c * c + mod.m() * (s * s);
  T scale = one;
  const T k1 = sqrt(mod.m1());
  if constexpr (Real<T>) {
    if (mod.m() < zero || mod.m1() < zero) return T(std::numeric_limits<double>::quiet_NaN());
    if (mod.m1() == zero) return T(2.0) * atan2(s, c) / pi<T>();
    if (to_double(square) < 0x1p-900) {  // both are next to underflow: sin psi is 1
      const T up(0x1p500);
      square = (up * c) * (up * c) + (up * mod.m()) * up;
      scale = up;
    }
    if (square == zero) return s;
  }
  const T root = k1 * (scale * c) / sqrt(square);
  if constexpr (Real<T>) {
    if (!(to_double(root) > 0x1p-900)) return s + root * zero;  // at pi/2, where s = +-1; or NaN
  } else {
    const T least(0x1p-899);
    if (!detail::all_before_separatrix(mod) || !all(square > least && root > least))
      return detail::each_lane_of([](const auto&... x) { return heuman_lambda0(x...); }, mod, s, c);
  }
  return T(2.0) / pi<T>() * (k1 * detail::cel_loop(k1, root, root, root)) * s;
}

template <Number T>
T heuman_lambda0(const T& psi, const BasicModulus<T>& mod) {
  const HalfTurns<T> h = half_turns(psi);
  return 2.0 * h.turns + heuman_lambda0(h.s, h.c, mod);
}

// Compiled once, in the library.
extern template double heuman_lambda0<double>(const double&, const double&,
                                              const BasicModulus<double>&);
extern template double heuman_lambda0<double>(const double&, const BasicModulus<double>&);
extern template DoubleDouble heuman_lambda0<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                          const BasicModulus<DoubleDouble>&);
extern template DoubleDouble heuman_lambda0<DoubleDouble>(const DoubleDouble&,
                                                          const BasicModulus<DoubleDouble>&);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/legendre.hpp"
