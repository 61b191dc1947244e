// SPDX-License-Identifier: MIT
// Conversions of many states, one instantiation in src/rotor/lanes for each set of instructions.
#pragma once

#include <cstddef>

#include "polhode/math/instruction_set.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Of which poles a set is to be regular at: those nearest to each state, or these.
struct PolesOfSets {
  bool nearest;
  Pole J, I;
};

// `how`: PolesOfSets to Poincare's, nothing elsewhere.
template <InstructionSet isa, class To, class From, class... How>
void converted_in_lanes(const From* states, std::size_t count, To* results, How... how);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
