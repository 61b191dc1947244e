// SPDX-License-Identifier: MIT
#include "polhode/io/map.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "io/detail/map_plan.hpp"
#include "io/detail/number_text.hpp"
#include "io/detail/value_access.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// In the order of the file's own units.
double axis_value(const MapAxis& axis, std::int64_t k) {
  if (axis.count == 1 || axis.from == axis.to) return axis.from;
  return SaveAt::count(axis.from, axis.to, axis.count)[k];
}

// What the cells of one scenario need to be run.
struct CellRun {
  Problem problem;
  SaveAt rows;
};

CellRun cell_run(const Scenario& scenario) {
  const SaveAt rows = *scenario.time;
  return {{rotor_system(scenario),
           initial_state(scenario),
           0.0,
           rows[rows.size() - 1],
           propagation_method(scenario).value_or(Adaptive{}),
           {}},
          rows};
}

MapCell chaos_cell(const CellRun& run, const Progress& progress) {
  const ChaosIndicator found =
      chaos_indicator(run.problem, SaveAt::times({run.problem.stop}), {}, progress);
  if (!found.outcome.ok()) return {{nan, nan}, found.outcome.advice};
  return {{found.mean_megno(), found.lyapunov()}, ""};
}

// The extremes and the last value.
MapCell column_cell(const CellRun& run, const std::string& name, const Units& units,
                    const Progress& progress) {
  const System& system = run.problem.system;
  const double energy_0 = system.is_hamiltonian() ? energy(system, 0.0, run.problem.initial) : 0.0;
  const ScalarColumn column = scalar_column(name, system, energy_0);
  double least = nan, most = nan, last = nan;
  const Trajectory way = integrate(
      run.problem, run.rows,
      [&](std::span<const Sample> samples) {
        for (const Sample& sample : samples) {
          last = column.value(sample.t, sample.s);
          if (!(least <= last)) least = last;
          if (!(most >= last)) most = last;
        }
      },
      progress);
  if (!way.outcome().ok()) return {{nan, nan, nan}, way.outcome().advice};
  const auto shown = [&](double x) { return units.from_core(x, column.dimension); };
  return {{shown(least), shown(most), shown(last)}, ""};
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
  const Units& units = scenario().units;
  if (plan().kind == MapKind::chaos) {
    groups.push_back({"chaos", {{"mean_megno", "1"}, {"lyapunov", "1/" + units.time()}}});
  } else {
    const std::string unit = units.label(column_dimension(plan().column));
    groups.push_back({"column",
                      {{plan().column + "_smallest", unit},
                       {plan().column + "_largest", unit},
                       {plan().column + "_last", unit}}});
  }
  return groups;
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
  const std::size_t width = plan().kind == MapKind::chaos ? 2 : 3;
  const std::vector<double> place = this->place(index);
  try {
    std::optional<CellRun> run;
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
      run = cell_run(detail::scenario_of(values, parts_->file.units, parts_->text, parts_->name));
    }
    if (plan().kind == MapKind::chaos) return chaos_cell(*run, progress);
    return column_cell(*run, plan().column, parts_->file.units, progress);
  } catch (const DomainError& error) {
    return {std::vector<double>(width, nan), error.what()};
  }
}

}  // namespace v0
}  // namespace polhode
