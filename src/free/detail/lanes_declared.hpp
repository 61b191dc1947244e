// SPDX-License-Identifier: MIT
// What src/free/lanes instantiates for each set of instructions, and what it takes.
#pragma once

#include <span>

#include "polhode/free/propagate.hpp"
#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A free arc on an even grid of times needs these besides its kernel:
// left qz(0) right of a kernel and left qz(pi) right, each with the rounding of the result alone.
struct GridFrame {
  Quaternion now, quarter_turn_on;
};

// src/free/lanes, one source for each set: of the bodies of which left[i] is true those that lanes
// can take; left[i] becomes false where the result is written.
template <InstructionSet isa>
void bodies_in_lanes(const BodyRows& rows, std::span<RotorState> results, bool* left);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
