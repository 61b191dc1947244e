// SPDX-License-Identifier: MIT
// From the values of a file to its [ensemble].
#pragma once

#include <string>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// ScenarioError at the place of what is wrong.
EnsemblePlan ensemble_plan(const FileValues& at, const Experiment& experiment);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
