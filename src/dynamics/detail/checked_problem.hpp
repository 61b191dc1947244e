// SPDX-License-Identifier: MIT
// What every run asks of a problem before its first step.
#pragma once

#include <string>

#include "polhode/dynamics/integrate.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The problem with a unit quaternion. DomainError, naming `function`, for a state, a time or a
// method that is none.
Problem checked_problem(const std::string& function, Problem problem);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
