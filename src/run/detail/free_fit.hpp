// SPDX-License-Identifier: MIT
#pragma once

#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// For light curves. ScenarioError unless nothing acts on the body, no torque or jump is unknown,
// and the state is relative to inertial axes.
void require_free_fit(const Scenario& scenario);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
