// SPDX-License-Identifier: MIT
// Jacobi's elliptic functions sn, cn, dn and the amplitude.
//
// Equations   u = F(am u), sn = sin am, cn = cos am, dn = sqrt(1 - m sn^2). Descending Landen (AGM)
//             transformation with m1 alone [Bulirsch 1965]. At m1 = 0: tanh, sech, sech.
//             Derivatives by closed rules: d am = dn (du - (dF/dm) dm), with
//             dF/dm = (s^3/6) RD(c^2, 1, dn^2) over the last part of u and (dK/dm) = B/(2 m1) over
//             each of its 2N quarter periods.
// Units       u as F; the amplitude in radians, continuous over all u.
//             m < 0: sn = sd(k1 u|mu)/k1, cn = cd, dn = nd with mu = -m/m1, k1^2 = m1
//             [DLMF 22.17.7]; m > 1: sn = sn(k u|1/m)/k, cn = dn(k u|1/m), dn = cn(k u|1/m)
//             [DLMF 22.17.2-4]; am then swings between +-asin(1/k).
// Domain      any finite u (infinite u: NaN), any modulus. dn and cn keep their relative accuracy
//             for every m1: they are quotients of positive terms, never 1 - m sn^2 or 1 - sn^2.
// Accuracy    budget elliptic_jacobi: relative to u's own rounding, eps (1 + |u|) times the slope.
// Cost        jacobi: one sincos, a root and two divisions per step, 0 to 8 steps in double. The
//             amplitude: that of jacobi and of K, and one atan2.
#pragma once

#include "polhode/elliptic/jacobi_values.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

// sn, cn, dn of u  [SA (A41)-(A43)].
template <Number T>
Jacobi<T> jacobi(const T& u, const BasicModulus<T>& mod);

// am u: the angle phi with u = F(phi), continuous, odd, am(u + 2K) = am u + pi  [SA (A40)].
template <Number T>
T amplitude(const T& u, const BasicModulus<T>& mod);

}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/jacobi.hpp"
