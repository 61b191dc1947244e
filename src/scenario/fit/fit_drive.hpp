// SPDX-License-Identifier: MIT
// From the tables [[free.parameter]] and [[free.jump]] to the plan of a fit.
#pragma once

#include "scenario/fit/fit_plan.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Adds them, and their priors, to a plan. Throws a ScenarioError at the place of what is wrong.
void add_drive(const FitContext& at, const Rotation& rotation, FitPlan& plan);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
