// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "polhode/free/propagate.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// src/free/lanes, one source for each set: of the bodies of which left[i] is true those that lanes
// can take; left[i] becomes false where the result is written.
template <InstructionSet isa>
void bodies_in_lanes(const BodyRows& rows, std::span<RotorState> results, bool* left);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
