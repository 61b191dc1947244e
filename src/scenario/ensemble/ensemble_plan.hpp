// SPDX-License-Identifier: MIT
// From the values of a file to its [ensemble].
#pragma once

#include <cstdint>
#include <string>

#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

SchemaPart ensemble_keys();
// Returns nullopt without [ensemble]. ScenarioError at the place of a mistake.
std::optional<EnsemblePlan> ensemble_plan(const FileValues& file, const Experiment& experiment);
// The text of a scenario with the numbers of a member in place of its own and without [ensemble].
// DomainError if the text cannot be changed so that it holds them.
std::string member_text(const Scenario& scenario, std::int64_t index);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
