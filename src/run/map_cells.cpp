// SPDX-License-Identifier: MIT
#include "run/detail/map_cells.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <utility>

#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/analysis/section.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Of a system without a damper: chaos_indicator says so.
MapCell chaos_cell(const DampedProblem& given, const Progress& progress) {
  const Problem problem{given.system, given.initial.rotor, given.start, given.stop, given.method};
  const ChaosIndicator found =
      chaos_indicator(problem, SaveAt::times({problem.stop}), {}, progress);
  return ended({found.mean_megno(), found.lyapunov()}, found.outcome, 2);
}

MapCell column_cell(const DampedProblem& problem, const SaveAt& rows, const CellContext& of,
                    const Progress& progress) {
  const ScalarColumn column =
      scalar_column(of.plan.column, problem.system, initial_energy(problem), of.charts);
  Extremes extremes;
  const DampedTrajectory trajectory = integrate(
      problem, rows,
      [&](std::span<const DampedSample> samples) {
        for (const DampedSample& sample : samples) extremes.add(column.value(sample));
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

MapCell andoyer_cell(const DampedProblem& problem, const CellContext& of,
                     const Progress& progress) {
  using enum Dimension;
  Rows rows(of.units);
  const AndoyerSection end = andoyer_section(
      problem, of.plan.surface,
      [&](const AndoyerPoint& at) {
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

MapCell spin_orbit_cell(const DampedProblem& problem, const PrecessingKeplerOrbit& orbit,
                        const CellContext& of, const Progress& progress) {
  using enum Dimension;
  Rows rows(of.units);
  const SpinOrbitSection end = spin_orbit_section(
      problem, orbit,
      [&](const SpinOrbitPoint& at) {
        rows.push(
            {{at.t, time}, {at.angle, angle}, {at.spin, Dimension::number}, {at.tilt, angle}});
      },
      progress);
  return ended(rows.take(), end.outcome, 4);
}

}  // namespace

MapCell ended(std::vector<double> numbers, const Outcome& outcome, std::size_t width) {
  if (!outcome.ok()) return failed_cell(width, outcome.advice);
  return {std::move(numbers), ""};
}

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

MapCell failed_cell(std::size_t width, std::string why) {
  return {std::vector<double>(width, nan), std::move(why)};
}

MapCell map_cell(const Rotation& rotation, const CellContext& of, const Progress& progress) {
  const DampedProblem problem = rotor_problem(rotation);
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

MapCell map_cell(const OwnExperiment&, const CellContext&, const Progress&) { return {}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
