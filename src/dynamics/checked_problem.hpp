// SPDX-License-Identifier: MIT
// What every run asks of a problem before its first step.
#pragma once

#include <string>
#include <vector>

#include "polhode/dynamics/problem.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Whether a run carries the state of a damper.
enum class DamperState { carried, refused };

// The problem with a unit quaternion. DomainError, naming `function`, for a state, a time or a
// method that is invalid.
Problem checked_problem(const std::string& function, Problem problem, DamperState carried);

// The sample times that are within the span of a problem. DomainError, naming `function`, unless
// they run from start to stop.
std::vector<double> sample_times(const std::string& function, const Problem& problem,
                                 const SaveAt& samples);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
