// SPDX-License-Identifier: MIT
// Conversions of many states, one instantiation in src/rotor/lanes for each set of instructions.
#pragma once

#include <cstddef>

#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <InstructionSet isa, class To, class From>
void converted_in_lanes(const From* states, std::size_t count, To* results);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
