// SPDX-License-Identifier: MIT
// How AdaptiveRungeKutta distinguishes a jump of f from a solution that grows beyond all bounds.
#pragma once

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace detail {

// A jump of f takes one step at the rounding of t, or two; more of them in a row are no jump.
inline constexpr int most_least_steps = 4;
// And by a jump the state hardly moves in such a step: a solution that grows beyond all bounds
// does.
inline constexpr double largest_least_step = 0x1p-10;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
