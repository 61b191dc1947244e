// SPDX-License-Identifier: MIT
// The nome q and the complementary nome q1.
//
// Equations   q = exp(-pi K'/K), q1 = exp(-pi K/K'), ln q ln q1 = pi^2. The smaller of the two by
//             q = l + 2 l^5 + 15 l^9 + 150 l^13 + ..., l = (1 - sqrt k')/(2 (1 + sqrt k')), with
//             1 - sqrt k' from m; not from K'/K, whose exponential loses the digits of ln q.
// Domain      any m <= 1; q = 0 at m = 0, q = 1 at m1 = 0. m < 0: -q(-m/m1), theta functions of
//             argument shifted by a half period. m > 1: NaN, as q is complex.
// Accuracy    budget elliptic_nome: relative, however small; 1 - q near m1 = 0 is as a double is.
// Cost        two roots, a division and a polynomial; for m > 1/2 also log and exp.
#pragma once

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
T nome(const BasicModulus<T>& mod);

template <Number T>
T complementary_nome(const BasicModulus<T>& mod);

}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/nome.hpp"
