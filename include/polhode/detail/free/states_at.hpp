// SPDX-License-Identifier: MIT
// states_at: the states of one free arc at many times, in the lanes of the processor.
//
// Equations   those of evaluate(kernel, t), polhode/detail/free/free_kernel.hpp.
// Units       those of the kernel.
// Domain      any kernel, any times in any order; NaN and infinite times give NaN.
// Accuracy    the bits of evaluate(kernel, t), whichever set of instructions is used and however
//             many times are asked for.
// Errors      DomainError for `states` that are not as many as the times, and for a set that this
//             processor lacks.
// Cost        docs/accuracy/benchmarks.md; no allocation. Fewer than eight times cost what evaluate
//             does for each.
#pragma once

#include <span>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {

// states[i] is the state at times[i].
void states_at(const FreeKernel& kernel, std::span<const double> times,
               std::span<RotorState> states, InstructionSet set = widest_instruction_set());

}  // namespace v0
}  // namespace polhode
