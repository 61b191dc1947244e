// SPDX-License-Identifier: MIT
// From the values of a file to its [ensemble].
#pragma once

#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

SchemaPart ensemble_keys();
// Returns nullopt without [ensemble]. ScenarioError at the place of a mistake.
std::optional<EnsemblePlan> ensemble_plan(const FileValues& file, const Experiment& experiment);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
