// SPDX-License-Identifier: MIT
// What every run asks of a problem before its first step.
#pragma once

#include <string>

#include "polhode/dynamics/problem.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Whether a run carries the state of a damper.
enum class DamperState { carried, refused };

// The problem with a unit quaternion. DomainError, naming `function`, for a state, a time or a
// method that is invalid. A Problem or a DampedProblem.
template <MotionState S>
BasicProblem<System, S> checked_problem(const std::string& function,
                                        BasicProblem<System, S> problem, DamperState carried);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
