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

#include "polhode/elliptic/modulus.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/agm.hpp"
