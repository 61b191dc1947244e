// SPDX-License-Identifier: MIT
// From the values of a file to its [map].
#pragma once

#include <span>
#include <string>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where [map] is read.
struct MapContext : FileValues {
  std::span<const ChartKind> charts;
};
// ScenarioError at the place of what is wrong, and for an experiment that no map wraps.
MapPlan map_plan(const MapContext& at, const Experiment& experiment);
// What the plan asks of the experiment of a cell, whose numbers are others.
void require_map(const MapContext& at, const Experiment& experiment);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
