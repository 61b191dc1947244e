// SPDX-License-Identifier: MIT
// Andoyer's, Euler's and the Poincare-type variables of many states at a time, in the lanes of the
// processor.
//
// Equations   those of the functions of one state: andoyer.hpp, euler.hpp, poincare.hpp.
// Units       those of the states.
// Domain      that of one state, state by state: poles, rest and NaN stay in theirs. `results` may
//             not overlap the states.
// Accuracy    budget lane_charts_eps in tests/budgets.hpp. The bits of a result depend on its state
//             alone: not on its neighbours, on how many there are, or on the set of instructions.
//             They are not those of one state at a time, whose sines and angles are the C
//             library's, and differ from them by rounding.
// Errors      DomainError for `results` that are not as many as the states, and for a set that this
//             processor lacks.
// Cost        docs/accuracy/benchmarks.md; no allocation.
#pragma once

#include <span>

#include "polhode/math/instruction_set.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

void to_andoyer(std::span<const RotorState> states, std::span<AndoyerState> results,
                InstructionSet set = widest_instruction_set());
void to_euler(std::span<const RotorState> states, std::span<EulerState> results,
              InstructionSet set = widest_instruction_set());
void to_rotor(std::span<const AndoyerState> states, std::span<RotorState> results,
              InstructionSet set = widest_instruction_set());
void to_rotor(std::span<const EulerState> states, std::span<RotorState> results,
              InstructionSet set = widest_instruction_set());

// All states in one set, or each in the one whose poles are nearest to it.
void to_poincare(std::span<const RotorState> states, Pole pole_J, Pole pole_I,
                 std::span<PoincareState> results, InstructionSet set = widest_instruction_set());
void nearest_poincare(std::span<const RotorState> states, std::span<PoincareState> results,
                      InstructionSet set = widest_instruction_set());
void to_rotor(std::span<const PoincareState> states, std::span<RotorState> results,
              InstructionSet set = widest_instruction_set());

}  // namespace v0
}  // namespace polhode
