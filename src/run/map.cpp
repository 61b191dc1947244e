// SPDX-License-Identifier: MIT
#include "polhode/run/map.hpp"

#include <memory>
#include <utility>

#include "polhode/error.hpp"
#include "run/detail/map_cells.hpp"
#include "scenario/map_plan.hpp"
#include "scenario/prepared_base.hpp"
#include "scenario/value_reader.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// In the order of the file's own units.
double axis_value(const MapAxis& axis, std::int64_t k) {
  if (axis.count == 1 || axis.from == axis.to) return axis.from;
  return SaveAt::count(axis.from, axis.to, axis.count)[k];
}

std::vector<std::string> keys_of(const MapPlan& plan) {
  std::vector<std::string> keys;
  for (const MapAxis& axis : plan.axes) keys.push_back(axis.key);
  return keys;
}

}  // namespace

struct ScenarioMap::Parts {
  explicit Parts(Scenario read)
      : scenario(std::move(read)), base(scenario, keys_of(*scenario.map)) {}

  Scenario scenario;
  detail::PreparedBase base;
};

namespace {

Scenario with_map(Scenario scenario) {
  if (!scenario.map)
    throw ScenarioError(scenario.document.path +
                        ": map: got nothing; expected a table [map] with tables [[map.axis]]");
  return scenario;
}

ColumnGroup results_of(const Scenario& scenario) {
  return detail::result_columns(*scenario.map, scenario.units());
}

}  // namespace

ScenarioMap::ScenarioMap(Scenario scenario)
    : parts_(std::make_unique<Parts>(with_map(std::move(scenario)))) {}

ScenarioMap::ScenarioMap(std::string_view text, const std::string& name, const Kinds& kinds)
    : ScenarioMap(scenario_from_text(text, name, kinds)) {}

ScenarioMap::~ScenarioMap() = default;

const Scenario& ScenarioMap::scenario() const { return parts_->scenario; }

std::int64_t ScenarioMap::size() const {
  std::int64_t cells = 1;
  for (const MapAxis& axis : plan().axes) cells *= axis.count;
  return cells;
}

std::vector<ColumnGroup> ScenarioMap::groups() const {
  std::vector<ColumnGroup> groups;
  for (const MapAxis& axis : plan().axes) groups.push_back({axis.key, {{axis.key, axis.unit}}});
  groups.push_back(results_of(scenario()));
  return groups;
}

std::size_t ScenarioMap::width() const { return results_of(scenario()).columns.size(); }

std::vector<double> ScenarioMap::axis_values(std::int64_t index) const {
  const std::vector<MapAxis>& axes = plan().axes;
  std::vector<double> values(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    values[i] = axis_value(axes[i], index % axes[i].count);
    index /= axes[i].count;
  }
  return values;
}

MapCell ScenarioMap::cell(std::int64_t index, const Progress& progress) const {
  const Document& of = scenario().document;
  try {
    const Experiment experiment = parts_->base.experiment(axis_values(index));
    const std::span<const ChartKind> charts = of.kinds->charts();
    detail::require_map({of.checked->values, of.units, charts, of.path}, experiment);
    return std::visit(
        [&](const auto& made) {
          return detail::map_cell(made, {plan(), of.units, charts}, progress);
        },
        experiment);
  } catch (const DomainError& error) {
    return detail::failed_cell(width(), error.what());
  }
}

}  // namespace v0
}  // namespace polhode
