// SPDX-License-Identifier: MIT
// [map] and [[map.axis]]: one run for every cell of a grid.
#pragma once

#include <span>

#include "polhode/scenario/scenario.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

SchemaPart map_keys();
// None without [map]. ScenarioError at the place of what is wrong, and for an experiment that no
// map wraps.
std::optional<MapPlan> map_plan(const FileValues& file, std::span<const ChartKind> charts,
                                const Experiment& experiment);
// What the plan asks of the experiment of a cell, whose numbers are others.
void require_map(const FileValues& file, std::span<const ChartKind> charts,
                 const Experiment& experiment);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
