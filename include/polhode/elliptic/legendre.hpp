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

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/legendre.hpp"
