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

MapCell ended(std::vector<double> numbers, const Outcome& outcome, std::size_t width) {
  if (!outcome.ok()) return failed_cell(width, outcome.advice);
  return {std::move(numbers), ""};
}

// Of a system without a damper: chaos_indicator says so.
MapCell chaos_cell(const DampedProblem& given, const Progress& progress) {
  const Problem problem{given.system, given.initial.rotor, given.start, given.stop, given.method};
  const ChaosIndicator found =
      chaos_indicator(problem, SaveAt::times({problem.stop}), {}, progress);
  return ended({found.mean_megno(), found.lyapunov()}, found.outcome, 2);
}

// The extremes and the last value.
MapCell column_cell(const DampedProblem& problem, const CellContext& of, const Progress& progress) {
  const System& system = problem.system;
  const ScalarColumn column =
      scalar_column(of.plan.column, system, initial_energy(problem), of.charts);
  double least = nan, most = nan, last = nan;
  const DampedTrajectory trajectory = integrate(
      problem, of.rows,
      [&](std::span<const DampedSample> samples) {
        for (const DampedSample& sample : samples) {
          last = column.value(sample);
          if (!(least <= last)) least = last;
          if (!(most >= last)) most = last;
        }
      },
      progress);
  const auto shown = [&](double x) { return of.units.from_core(x, column.dimension); };
  return ended({shown(least), shown(most), shown(last)}, trajectory.outcome(), 3);
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

PrecessingKeplerOrbit section_orbit(const CellContext& of) {
  const auto orbit =
      std::find_if(of.orbits.begin(), of.orbits.end(),
                   [&](const ScenarioOrbit& one) { return one.name == of.plan.orbit; });
  const auto* moving = std::get_if<PrecessingKeplerOrbit>(&orbit->motion);
  return moving != nullptr ? *moving : PrecessingKeplerOrbit(*kepler_elements(*orbit), {});
}

MapCell spin_orbit_cell(const DampedProblem& problem, const CellContext& of,
                        const Progress& progress) {
  using enum Dimension;
  Rows rows(of.units);
  const SpinOrbitSection end = spin_orbit_section(
      problem, section_orbit(of),
      [&](const SpinOrbitPoint& at) {
        rows.push(
            {{at.t, time}, {at.angle, angle}, {at.spin, Dimension::number}, {at.tilt, angle}});
      },
      progress);
  return ended(rows.take(), end.outcome, 4);
}

}  // namespace

ColumnGroup result_columns(const MapPlan& plan, const Units& units,
                           std::span<const ChartKind> charts) {
  const std::string time = units.label(Dimension::time), angle = units.label(Dimension::angle),
                    momentum = units.label(Dimension::momentum);
  switch (plan.kind) {
    case MapKind::chaos:
      return {"chaos", {{"mean_megno", "1"}, {"lyapunov", "1/" + units.time()}}};
    case MapKind::column: {
      const std::string unit = units.label(column_dimension(plan.column, charts));
      return {"column",
              {{plan.column + "_smallest", unit},
               {plan.column + "_largest", unit},
               {plan.column + "_last", unit}}};
    }
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
  }
  return {};
}

MapCell failed_cell(std::size_t width, std::string why) {
  return {std::vector<double>(width, nan), std::move(why)};
}

MapCell map_cell(const CellContext& of, const Progress& progress) {
  const DampedProblem& problem = of.problem;
  switch (of.plan.kind) {
    case MapKind::chaos:
      return chaos_cell(problem, progress);
    case MapKind::column:
      return column_cell(problem, of, progress);
    case MapKind::andoyer_section:
      return andoyer_cell(problem, of, progress);
    case MapKind::spin_orbit_section:
      return spin_orbit_cell(problem, of, progress);
  }
  return {};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
