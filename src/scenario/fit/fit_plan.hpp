// SPDX-License-Identifier: MIT
// From the values of a file of kind "fit" to its plan.
#pragma once

#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/scenario/kinds.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/tables/fit.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Throws a ScenarioError at the place of what is wrong. So do all below.
FitPlan fit_plan(const FileValues& at, const Kinds& kinds, const Rotation& rotation);

// [light], and what [fit] and [simulate] have for light curves.
LightPlan light_plan(const FileValues& at, const Rotation& rotation, const Placed<FreeTable>& free,
                     const Placed<FitTable>& fit);
// Whether the groups of [free] and the like go with what is observed.
void require_words(const Placed<FreeTable>& free, const Placed<FitTable>& fit, bool of_light);

// The tables [[free.prior]] into the plan, which has its unknowns.
SchemaPart prior_keys();
void add_priors(const FileValues& at, const fit::SpinState& start, FitPlan& plan);

// The tables [[free.parameter]] and [[free.jump]], and their priors.
SchemaPart drive_keys();
void add_drive(const FileValues& at, const Rotation& rotation, FitPlan& plan);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
