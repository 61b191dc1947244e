// SPDX-License-Identifier: MIT
// Legendre's incomplete elliptic integral of the third kind. The amplitude is an angle, or its sine
// and cosine.
//
// Equations   Pi(n) = int 1/((1 - n sin^2) D) from 0 to phi, D = sqrt(1 - m sin^2)
//             [DLMF 19.2.7, 19.25.14]. Standard sign 1 - n sin^2; the n_S of the paper is -n.
//             With nu = -n > 1/4 Pi is led to positive terms [DLMF 19.21.12], p = 1 + nu s^2:
//             m >= 0: q = 1 + m s^2/nu,
//             Pi = s (RC(c^2 D^2, p q) + (m s^2/(3 nu)) RJ(c^2, D^2, 1, q));
//             m < 0: q = c^2 + m1 s^2/(1 + nu),
//             Pi = s (RF + nu (c RC(D^2, p q) + m1 s^2/(3 (1 + nu)) RJ(c^2, D^2, 1, q)))/(1 + nu).
//             Behind the pole, n sin^2 phi > 1, Cauchy's principal value [DLMF 19.7.8]:
//             q = 1 - (m/n) s^2, w^2 = (n - 1)(n - m)/n,
//             Pi = (c D/w) RC(w^2 s^2, -p q) - (m/(3 n)) s^3 RJ(c^2, D^2, 1, q) at s > 0.
//             Beyond pi/2: Pi(phi + j pi) = Pi(phi) + 2 j Pi(pi/2), principal values at every pole.
// Units       none; phi in radians.
// Domain      any n; n > 1 passes poles at sin^2 phi = 1/n, where the value is inf. n = 1: inf at
//             pi/2 and beyond. phi and m as in legendre.hpp: m > 1 needs |sin phi| <= 1/k,
//             otherwise NaN. At m1 = 0: inf at pi/2 and beyond (-inf for n > 1).
// Accuracy    budgets elliptic_legendre and elliptic_beyond: relative. Behind a pole the two terms
//             have opposite signs, and their sum has a zero: an angle in double is taken in
//             DoubleDouble there and keeps its digits; otherwise the error is relative to the
//             larger term.
// Cost        one RF or RC and one RJ. Beyond pi/2 the complete integral as well.
#pragma once

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

// phi = atan2(s, c).
template <Number T>
T legendre_pi(const T& s, const T& c, const T& n, const BasicModulus<T>& mod);

// The same of any angle phi.
template <Number T>
T legendre_pi(const T& phi, const T& n, const BasicModulus<T>& mod);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/legendre_pi.hpp"
