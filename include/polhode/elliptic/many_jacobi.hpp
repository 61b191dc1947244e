// SPDX-License-Identifier: MIT
// Jacobi's sn, cn and dn of many arguments, each with a modulus of its own or all with one, in the
// lanes of the processor.
//
// Equations   1 - m >= 0.14: theta functions of the nome's square and one ascending step of
//             Landen's [DLMF 20.2, 20.7, 22.7(i)]; below, theta functions of the complementary nome
//             and an imaginary argument [DLMF 22.6(iv)].
// Units       as of jacobi.hpp.
// Domain      any u and any pair m + m1 = 1. Lanes are for 0 <= m <= 1 - 2^-500 and |u| <= 1e6;
//             the rest goes one by one through jacobi(u, modulus). NaN in, NaN out, and NaN for an
//             infinite number, in its own place. Results may be written over the arguments.
// Accuracy    budget elliptic_jacobi_lanes: some three times that of jacobi(u, modulus), whose last
//             digit may differ; the zero of sn(-0) may be positive. The bits of a result depend on
//             its own u, m and m1 alone: not on its neighbours, on how many there are, on whether
//             the modulus is given once, or on the set of instructions.
// Errors      DomainError for spans that are not as long as u, for a set that this processor lacks,
//             and for a pair that does not add up to 1, with results in part.
// Cost        docs/design/0040-jacobi-in-lanes.md; no allocation. Half as much for one modulus.
#pragma once

#include <span>

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {

struct JacobiSpans {
  std::span<double> sn, cn, dn;
};

// m and m1 as long as u, or both of one number.
void jacobi(std::span<const double> u, std::span<const double> m, std::span<const double> m1,
            const JacobiSpans& results, InstructionSet set = widest_instruction_set());

void jacobi(std::span<const double> u, const Modulus& modulus, const JacobiSpans& results,
            InstructionSet set = widest_instruction_set());

}  // namespace v0
}  // namespace polhode
