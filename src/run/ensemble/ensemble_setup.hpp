// SPDX-License-Identifier: MIT
// The outputs of an ensemble, which are tables, and what a checkpoint of it must agree in.
#pragma once

#include <string>
#include <vector>

#include "polhode/run/ensemble_run.hpp"
#include "run/detail/kept_outputs.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// DomainError for a path that is no table.
KeptSetup setup_of_ensemble(const ScenarioEnsemble& ensemble,
                            const std::vector<ColumnGroup>& groups,
                            const std::vector<std::string>& paths, const EnsembleOptions& options);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
