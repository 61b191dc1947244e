// SPDX-License-Identifier: MIT
// From the values of a file to its [map].
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where [map] is read.
struct MapContext {
  const Values& values;
  const Units& units;
  std::span<const ChartKind> charts;
  const std::string& name;  // of the file, for messages
};
// What sections, columns and the indicator of chaos ask of an experiment, which must outlive it.
struct MapSubject {
  System system;
  const std::vector<ScenarioOrbit>& orbits;
  const std::optional<SaveAt>& rows;
};
// DomainError for what a map cannot wrap.
MapSubject subject_of(const Experiment& experiment);

// ScenarioError at the place of what is wrong.
MapPlan map_plan(const MapContext& at, const MapSubject& subject);
// What the plan asks of the experiment of a cell, whose numbers are others.
void require_map(const MapContext& at, const MapSubject& subject);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
