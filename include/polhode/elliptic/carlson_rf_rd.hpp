// SPDX-License-Identifier: MIT
// Carlson's symmetric elliptic integrals RF and RD: the first and the second kind.
//
// Equations   RF = (1/2) int_0^inf dt / s,  RD = (3/2) int_0^inf dt / (s (t + z)),
//             s = sqrt((t + x)(t + y)(t + z)). Duplication, then Taylor to degree 7
//             [Carlson 1995; DLMF 19.36]. A Dual differentiates the duplication itself, where every
//             step is smooth: right at equal arguments too, where closed rules such as
//             dRD/dx = (RD(y,z,x) - RD(x,y,z))/(2(x-z)) are 0/0. dRF/dx = -RD(y,z,x)/6.
// Units       RF: argument^(-1/2); RD: argument^(-3/2).
// Domain      x, y, z >= 0, at most one of them 0 (two: inf); RD: z > 0 (0: inf). Otherwise NaN. An
//             infinite argument gives 0. All of double's range, in any mixture: arguments beyond
//             2^-900 .. 2^1000 (RF) or 2^+-320 (RD) are led through WideRange. At x = 0 the
//             derivative with respect to x is infinite; a Dual whose derivatives are 0 there is a
//             constant.
// Accuracy    budget elliptic_carlson: relative, also for extreme ratios of the arguments, wherever
//             the result is no subnormal number.
// Cost        4 to 7 trips in double (at most 14 for ratios up to 1e300), 7 to 10 in DoubleDouble;
//             a trip is three roots.
#pragma once

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

template <Number T>
T carlson_rf(T x, T y, T z);
template <Number T>
T carlson_rd(T x, T y, T z);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/carlson_rf_rd.hpp"
