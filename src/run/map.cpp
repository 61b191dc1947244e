// SPDX-License-Identifier: MIT
// The cells of a map: each is the run of an experiment, of which a few numbers are kept.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/analysis/section.hpp"
#include "polhode/analysis/spectrum.hpp"
#include "polhode/detail/scenario/obliquity.hpp"
#include "polhode/detail/scenario/varied_scenario.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/error.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/run/map_run.hpp"
#include "polhode/scenario/changes.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct CellContext {
  const MapPlan& plan;
  const Units& units;
  const ColumnKinds& columns;
};

// The least, the largest and the last value.
class Extremes {
 public:
  void add(double value) {
    last_ = value;
    if (!(least_ <= last_)) least_ = last_;
    if (!(most_ >= last_)) most_ = last_;
  }
  std::vector<double> in(const Units& units, Dimension dimension) const {
    return {units.from_core(least_, dimension), units.from_core(most_, dimension),
            units.from_core(last_, dimension)};
  }

 private:
  double least_ = std::numeric_limits<double>::quiet_NaN();
  double most_ = least_;
  double last_ = least_;
};

// A cell that failed has one row of NaN.
MapCell failed_cell(std::size_t width, std::string why) {
  return {std::vector<double>(width, nan), std::move(why)};
}

// A failed cell with the advice of the outcome if the run did not end.
MapCell ended(std::vector<double> numbers, const Outcome& outcome, std::size_t width) {
  if (!outcome.ok()) return failed_cell(width, outcome.advice);
  return {std::move(numbers), ""};
}

// Of a system without a damper: chaos_indicator says so.
MapCell chaos_cell(const Problem& problem, const Progress& progress) {
  const analysis::ChaosIndicator found =
      analysis::chaos_indicator(problem, SaveAt::times({problem.stop}), {}, progress);
  return ended({found.mean_megno(), found.lyapunov()}, found.outcome, 2);
}

MapCell column_cell(const Problem& problem, const SaveAt& rows, const CellContext& of,
                    const Progress& progress) {
  const ScalarColumn column =
      scalar_column(of.plan.column, problem.system, initial_energy(problem), of.columns);
  Extremes extremes;
  const Trajectory trajectory = integrate(
      problem, rows,
      [&](std::span<const Sample> samples) {
        for (const Sample& sample : samples) extremes.add(column.value(sample));
      },
      progress);
  return ended(extremes.in(of.units, column.dimension), trajectory.outcome(), 3);
}

// Rows of numbers that have a dimension.
class Rows {
 public:
  explicit Rows(const Units& units) : units_(units) {}
  void push(std::initializer_list<std::pair<double, Dimension>> row) {
    for (const auto& [x, dimension] : row) numbers_.push_back(units_.from_core(x, dimension));
  }
  std::vector<double> take() { return std::move(numbers_); }

 private:
  const Units& units_;
  std::vector<double> numbers_;
};

MapCell andoyer_cell(const Problem& problem, const CellContext& of, const Progress& progress) {
  using enum Dimension;
  Rows rows(of.units);
  const analysis::AndoyerSection end = analysis::andoyer_section(
      problem, of.plan.surface,
      [&](const analysis::AndoyerPoint& at) {
        const AndoyerState& a = at.andoyer;
        rows.push({{at.t, time},
                   {a.l, angle},
                   {a.g, angle},
                   {a.h, angle},
                   {a.L, momentum},
                   {a.G, momentum},
                   {a.H, momentum}});
      },
      progress);
  return ended(rows.take(), end.outcome, 7);
}

PrecessingKeplerOrbit section_orbit(const std::vector<ScenarioOrbit>& orbits,
                                    const std::string& name) {
  const auto orbit = std::find_if(orbits.begin(), orbits.end(),
                                  [&](const ScenarioOrbit& one) { return one.name == name; });
  const auto* moving = std::get_if<PrecessingKeplerOrbit>(&orbit->motion);
  return moving != nullptr ? *moving : PrecessingKeplerOrbit(*kepler_elements(*orbit), {});
}

MapCell spin_orbit_cell(const Problem& problem, const PrecessingKeplerOrbit& orbit,
                        const CellContext& of, const Progress& progress) {
  using enum Dimension;
  Rows rows(of.units);
  const analysis::SpinOrbitSection end = analysis::spin_orbit_section(
      problem, orbit,
      [&](const analysis::SpinOrbitPoint& at) {
        rows.push(
            {{at.t, time}, {at.angle, angle}, {at.spin, Dimension::number}, {at.tilt, angle}});
      },
      progress);
  return ended(rows.take(), end.outcome, 4);
}

// The results of a cell, without its axes.
ColumnGroup result_columns(const MapPlan& plan, const Units& units) {
  const std::string time = units.label(Dimension::time), angle = units.label(Dimension::angle),
                    momentum = units.label(Dimension::momentum),
                    rate = units.label(Dimension::rate);
  switch (plan.kind) {
    case MapKind::chaos:
      return {"chaos", {{"mean_megno", "1"}, {"lyapunov", "1/" + units.time()}}};
    case MapKind::column:
      return {"column",
              {{plan.column + "_smallest", plan.unit},
               {plan.column + "_largest", plan.unit},
               {plan.column + "_last", plan.unit}}};
    case MapKind::andoyer_section:
      return {"section",
              {{"t", time},
               {"l", angle},
               {"g", angle},
               {"h", angle},
               {"L", momentum},
               {"G", momentum},
               {"H", momentum}}};
    case MapKind::spin_orbit_section:
      return {"section", {{"t", time}, {"angle", angle}, {"spin", "1"}, {"tilt", angle}}};
    case MapKind::frequency:
      return {"frequency", {{"frequency", rate}, {"frequency_later", rate}, {"change", "1"}}};
  }
  return {};
}

// Makes the cell of an experiment: one overload for each kind.
MapCell map_cell(const Rotation& rotation, const CellContext& of, const Progress& progress) {
  const Problem problem = rotor_problem(rotation);
  switch (of.plan.kind) {
    case MapKind::chaos:
      return chaos_cell(problem, progress);
    case MapKind::column:
      return column_cell(problem, *rotation.time, of, progress);
    case MapKind::andoyer_section:
      return andoyer_cell(problem, of, progress);
    case MapKind::spin_orbit_section:
      return spin_orbit_cell(problem, section_orbit(rotation.orbits, of.plan.orbit), of, progress);
    case MapKind::frequency:
      break;  // of a spin axis over ages
  }
  return {};
}

MapCell map_cell(const CustomExperiment&, const CellContext&, const Progress&) { return {}; }

// seen(t, state) for every row.
template <class Seen>
Outcome run_rows_of(const Obliquity& obliquity, const Progress& progress, const Seen& seen) {
  return with_problem(obliquity, [&]<class Model>(const BasicProblem<Model>& problem) {
    const auto each = [&](std::span<const BasicSample<typename Model::State>> samples) {
      for (const auto& one : samples) seen(one.t, secular::tidal_spin(one.s));
    };
    return integrate(problem, *obliquity.time, each, progress).outcome();
  });
}

MapCell column_cell(const Obliquity& obliquity, const CellContext& of, const Progress& progress) {
  const SpinColumn& column = *spin_column(of.plan.column);
  Extremes extremes;
  const Outcome outcome =
      run_rows_of(obliquity, progress, [&](double t, const secular::TidalSpin& at) {
        extremes.add(column.value(spin_row(at, obliquity.history.at(t), obliquity.insolation)));
      });
  return ended(extremes.in(of.units, column.dimension), outcome, 3);
}

// The largest line of sin(obliquity) exp(i psi), which has no singularity.
double precession_frequency(std::span<const std::complex<double>> equinox, double interval) {
  const analysis::Spectrum found = analysis::spectrum(0.0, interval, equinox, {.lines = 1});
  return found.lines.empty() ? std::nan("") : found.lines.front().frequency;
}

// Why rows like these tell no frequency of a precession of up to this constant; empty: they do.
std::string frequency_obstacle(double constant, const SaveAt& rows, const Units& units) {
  constexpr double least_turns = 5.0;  // of a half
  const double turn = 2.0 * std::numbers::pi, period = turn / constant;
  const double interval = std::fabs(rows[1] - rows[0]);
  const double half = 0.5 * interval * static_cast<double>(rows.size());
  const auto text = [&](double t) {
    return fmt::format("{:.4g}", units.from_core(t, Dimension::time));
  };
  const std::string of = "the precession, with a period of " + text(period) + " " + units.time() +
                         " on a circle at obliquity 0, ";
  if (interval > 0.5 * period)
    return of + "needs rows at most " + text(0.5 * period) + " apart; got " + text(interval);
  if (half < least_turns * period)
    return of + "needs rows over " + text(2.0 * least_turns * period) + " or more; got " +
           text(2.0 * half);
  return "";
}

// The frequencies of the first and of the second half of the rows: where they differ, the motion is
// chaotic (Laskar & Robutel 1993).
MapCell frequency_cell(const Obliquity& obliquity, const CellContext& of,
                       const Progress& progress) {
  const std::string obstacle =
      frequency_obstacle(std::fabs(obliquity.rates.torque(0.0, 0.0)), *obliquity.time, of.units);
  if (!obstacle.empty()) return failed_cell(3, obstacle);
  std::vector<std::complex<double>> equinox;
  const Outcome outcome =
      run_rows_of(obliquity, progress, [&](double t, const secular::TidalSpin& at) {
        const secular::SpinAngles angles = secular::spin_angles({at.s}, obliquity.history.at(t));
        const double size = std::sin(angles.obliquity);
        equinox.push_back(size > 0.0 ? std::polar(size, angles.precession) : 0.0);
      });
  if (!outcome.ok()) return failed_cell(3, outcome.advice);
  const SaveAt& rows = *obliquity.time;
  const double interval = rows[1] - rows[0];
  const std::size_t half = equinox.size() / 2;
  const std::span all(equinox);
  const double first = precession_frequency(all.first(half), std::fabs(interval)),
               later = precession_frequency(all.last(half), std::fabs(interval));
  const double sign = interval < 0.0 ? -1.0 : 1.0;
  const auto shown = [&](double rate) { return of.units.from_core(rate, Dimension::rate); };
  return {{shown(sign * first), shown(sign * later), std::fabs(1.0 - later / first)}, ""};
}

MapCell map_cell(const Obliquity& obliquity, const CellContext& of, const Progress& progress) {
  return of.plan.kind == MapKind::frequency ? frequency_cell(obliquity, of, progress)
                                            : column_cell(obliquity, of, progress);
}

}  // namespace
}  // namespace detail

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
      : scenario(std::move(read)), varied(scenario, keys_of(*scenario.map)) {}

  Scenario scenario;
  VariedScenario varied;
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

std::string ScenarioMap::cell_text(std::int64_t index) const {
  if (index < 0 || index >= size())
    throw DomainError(scenario().document.name + ": got cell " + std::to_string(index) +
                      "; expected 0 to " + std::to_string(size() - 1));
  const ScenarioChange without_map{"map", ""};
  return "# Cell " + std::to_string(index) + " of " +
         detail::printable(scenario().document.name, 200) + ", " + std::to_string(size()) +
         " cells\n" + changed_text(parts_->varied.text(axis_values(index)), {&without_map, 1});
}

Scenario ScenarioMap::cell_scenario(std::int64_t index, std::string cell_text) const {
  return parts_->varied.scenario(axis_values(index), std::move(cell_text));
}

MapCell ScenarioMap::cell(std::int64_t index, const Progress& progress) const {
  const Document& of = scenario().document;
  try {
    const Experiment experiment = parts_->varied.experiment(axis_values(index));
    const ColumnKinds& columns = of.kinds->columns();
    require_map(scenario(), experiment);
    return std::visit(
        [&](const auto& made) {
          return detail::map_cell(made, {plan(), of.units, columns}, progress);
        },
        experiment);
  } catch (const DomainError& error) {
    return detail::failed_cell(width(), error.what());
  }
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
