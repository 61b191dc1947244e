// SPDX-License-Identifier: MIT
// From the values of a file of kind "fit" to its plan.
#pragma once

#include <string>

#include "polhode/scenario/fit_plan.hpp"
#include "polhode/scenario/key_values.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Throws a ScenarioError at the place of what is wrong.
FitPlan fit_plan(const FileValues& at, const Rotation& rotation);

LightPlan light_plan(const FileValues& at, const Rotation& rotation);
// Whether the groups of [free] and the like go with what is observed.
void require_words(const FileValues& at, bool of_light);

// What one table says; the keys are those of its kind.
Observation observation_of(const KeyValues& table);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
