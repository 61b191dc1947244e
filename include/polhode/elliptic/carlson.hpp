// SPDX-License-Identifier: MIT
// Carlson's symmetric elliptic integrals: RC and RJ here, RF and RD in carlson_rf_rd.hpp.
//
// Equations   RJ = (3/2) int_0^inf dt / (s (t + p)), s = sqrt((t + x)(t + y)(t + z));
//             RC(x, y) = RF(x, y, y). RJ(x, y, z, z) = RD(x, y, z). Duplication, then Taylor to
//             degree 7 [Carlson 1995; DLMF 19.36]; p far above the others is first exchanged for
//             one next to the least of them [DLMF 19.21.12]. A Dual differentiates the duplication
//             of RJ, since the closed rule dRJ/dx = (RJ - RD(y,z,x))/(2(x-p)) is 0/0 at p = x; RC
//             has dRC/dx = -RD(y,y,x)/6, dRC/dy = -RD(x,y,y)/3.
// Units       RC: argument^(-1/2); RJ: argument^(-3/2).
// Domain      x, y, z >= 0, at most one of them 0 (two: inf); RC: x >= 0. Otherwise NaN. At y < 0
//             (RC) and p < 0 (RJ) Cauchy's principal value [DLMF 19.2.20, 19.20.14]; inf at y = 0
//             and p = 0. An infinite argument gives 0. All of double's range, in any mixture: RJ
//             with arguments beyond 2^+-320 goes through WideRange. At x = 0 the derivative with
//             respect to x is infinite; a Dual whose derivatives are 0 there is a constant.
// Accuracy    budget elliptic_carlson: relative, also for extreme ratios of the arguments, wherever
//             the result is no subnormal number. RJ with p < 0 has a zero: in double it is computed
//             in DoubleDouble and so keeps its digits there; elsewhere the error is relative to the
//             largest of its three terms.
// Cost        RC: a root and an arctangent or a logarithm. RJ: the trips of RF, each with four
//             roots, a division and, while p is far from the others, an arctangent or a logarithm.
#pragma once

#include "polhode/elliptic/carlson_rf_rd.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

template <Number T>
T carlson_rc(const T& x, const T& y);
template <Number T>
T carlson_rj(T x, T y, T z, T p);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/carlson.hpp"
