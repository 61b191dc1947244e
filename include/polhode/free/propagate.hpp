// SPDX-License-Identifier: MIT
// propagate: the free rotation of many bodies, each to a time of its own, a body in each lane of
// the processor.
//
// Equations   docs/design/0032-many-bodies.md: those of FreeRotation, prepared without an elliptic
//             function and without an angle at the epoch.
// Units       any consistent set, as in free_rotation.hpp.
// Domain      that of FreeRotation: every body, every state, any finite times; a time that is not
//             finite gives NaN. Bodies with a moment below 2^-20 of the greatest, at rest, steady
//             or within k'^2 = 2^-40 of the separatrix go one by one, as FreeRotation.
// Accuracy    budget free_state in tests/budgets.hpp, that of FreeRotation, of which a result may
//             differ in its last digits. A result depends on its body, state and times alone: not
//             on its neighbours, their number, or the set of instructions.
// Errors      a body that fails, as FreeRotation would throw, fails alone: its result is NaN and
//             it is in the list that is returned. DomainError for spans that do not fit together
//             and for a set that this processor lacks.
// Cost        docs/design/0032-many-bodies.md: some 1/100 of FreeRotation and at. No allocation,
//             but for those that fail.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "polhode/math/instruction_set.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// Row i begins at first + i step; a step of 0 is one row for all.
struct NumberRows {
  const double* first;
  std::size_t step;
};

// Where the numbers of many bodies lie: three moments a row, seven of a state (q, then g), a time
// and the time of that state.
struct BodyRows {
  NumberRows moments, states, times, epochs;
};

// One that failed, and why.
struct FailedBody {
  std::size_t index;
  std::string reason;
};

// results[i] is the state at times[i] of bodies[i], which has states[i] at t0. Each of the first
// three is as long as the results, or has one for all.
std::vector<FailedBody> propagate(std::span<const Body> bodies, std::span<const RotorState> states,
                                  std::span<const double> times, double t0,
                                  std::span<RotorState> results,
                                  InstructionSet set = widest_instruction_set());

// The same of rows, as many as there are results. Moments need not be those of a body.
std::vector<FailedBody> propagate(const BodyRows& rows, std::span<RotorState> results,
                                  InstructionSet set = widest_instruction_set());

}  // namespace v0
}  // namespace polhode
