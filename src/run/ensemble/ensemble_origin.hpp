// SPDX-License-Identifier: MIT
// What the files of an ensemble say of themselves: columns and origin.
#pragma once

#include <vector>

#include "polhode/output/sink.hpp"
#include "polhode/run/ensemble.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where rows are kept, all or the last.
std::vector<ColumnGroup> row_groups_of(const ScenarioEnsemble& ensemble);
// No frame where rows are kept.
Provenance provenance_of(const ScenarioEnsemble& ensemble, const StatisticsFrame* frame);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
