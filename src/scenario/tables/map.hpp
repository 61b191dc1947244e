// SPDX-License-Identifier: MIT
// [map] and [[map.axis]]: one run for every cell of a grid.
#pragma once

#include <span>

#include "polhode/output/column_kind.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

SchemaPart map_keys();
// Returns nullopt without [map]. ScenarioError at the place of a mistake, and for an experiment
// without maps.
std::optional<MapPlan> map_plan(const FileValues& file, const ColumnKinds& columns,
                                const Experiment& experiment);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
