// SPDX-License-Identifier: MIT
// ensemble_work: what a process does that computes chunks of an ensemble for another one.
//
// Equations   those of the members.
// Units       none: bytes.
// Domain      for EnsembleOptions::team. Every process makes its own from the same scenario; which
//             chunks it computes does not matter.
// Accuracy    the bytes hold every number to the last bit.
// Errors      begin() throws DomainError for bytes of another ensemble, and says what differs.
// Cost        that of the members, and eight bytes for each number of rows or statistics.
#pragma once

#include <memory>

#include "polhode/ensemble/team.hpp"
#include "polhode/run/ensemble.hpp"

namespace polhode {
inline namespace v0 {

// `ensemble` must outlive it. `any_machine` as in EnsembleOptions.
std::unique_ptr<TeamWork> ensemble_work(const ScenarioEnsemble& ensemble, bool any_machine = false);

}  // namespace v0
}  // namespace polhode
