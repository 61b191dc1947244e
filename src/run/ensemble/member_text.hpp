// SPDX-License-Identifier: MIT
// The scenario of one member of an ensemble.
#pragma once

#include <cstdint>
#include <string>

#include "polhode/run/ensemble.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// DomainError for an index that no member has.
void require_member(const ScenarioEnsemble& ensemble, std::int64_t index);
// The text of a scenario with [ensemble], with the numbers of a member in place of its own and
// without the table. DomainError where the text cannot be changed so that it holds them.
std::string member_text(const Scenario& scenario, std::int64_t index);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
