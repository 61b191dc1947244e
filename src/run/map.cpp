// SPDX-License-Identifier: MIT
#include "polhode/run/map.hpp"

#include <mutex>
#include <optional>
#include <utility>

#include "polhode/error.hpp"
#include "run/detail/map_cells.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/map_plan.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"
#include "scenario/values.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// In the order of the file's own units.
double axis_value(const MapAxis& axis, std::int64_t k) {
  if (axis.count == 1 || axis.from == axis.to) return axis.from;
  return SaveAt::count(axis.from, axis.to, axis.count)[k];
}

}  // namespace

struct ScenarioMap::Parts {
  std::string text;
  std::string name;
  detail::ReadFile file;
  Scenario scenario;
  // Units are not for several threads, and files of orbits are read once at a time.
  mutable std::mutex reading;
};

namespace {

detail::ReadFile file_of(std::string_view text, const std::string& name) {
  detail::Diagnostics diagnostics(name);
  detail::ReadFile file = detail::read_values(text, scenario_schema(), diagnostics);
  diagnostics.raise();
  return file;
}

}  // namespace

ScenarioMap::ScenarioMap(std::string_view text, const std::string& name)
    : parts_(new Parts{
          std::string(text), name, file_of(text, name), scenario_from_text(text, name), {}}) {
  if (!parts_->scenario.map)
    throw ScenarioError(name +
                        ": map: got nothing; expected a table [map] with tables [[map.axis]]");
}

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
  groups.push_back(detail::result_columns(plan(), scenario().units));
  return groups;
}

std::size_t ScenarioMap::width() const {
  return detail::result_columns(plan(), scenario().units).columns.size();
}

std::vector<double> ScenarioMap::place(std::int64_t index) const {
  const std::vector<MapAxis>& axes = plan().axes;
  std::vector<double> values(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    values[i] = axis_value(axes[i], index % axes[i].count);
    index /= axes[i].count;
  }
  return values;
}

MapCell ScenarioMap::cell(std::int64_t index, const Progress& progress) const {
  const std::vector<double> place = this->place(index);
  try {
    std::optional<Scenario> scenario;
    {
      const std::lock_guard<std::mutex> one(parts_->reading);
      detail::Values values = parts_->file.values;
      for (std::size_t i = 0; i < place.size(); ++i) {
        const auto at = *detail::number_place(values, plan().axes[i].key);
        detail::Value& value = values.find(at.path)->second;
        value.numbers[at.index] = parts_->file.units.to_core(place[i], value.key->dimension);
        value.shown = detail::number_text(place[i]);
        value.given = true;
      }
      scenario = detail::scenario_of(values, parts_->file.units, parts_->text, parts_->name);
    }
    return detail::map_cell(*scenario, progress);
  } catch (const DomainError& error) {
    return detail::failed_cell(width(), error.what());
  }
}

}  // namespace v0
}  // namespace polhode
