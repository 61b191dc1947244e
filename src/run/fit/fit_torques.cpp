// SPDX-License-Identifier: MIT
#include "run/fit/fit_torques.hpp"

#include <algorithm>

#include "polhode/detail/scenario/varied_scenario.hpp"
#include "run/detail/fit_tables.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

std::optional<fit::SpinDrive> drive_of(const Scenario& scenario) {
  const Rotation& rotation = scenario.rotation();
  const FitDrive& plan = require_fit(scenario).drive;
  if (rotation.damper) {
    const auto place = std::ranges::find(rotation.kinds, "kane-damper") - rotation.kinds.begin();
    require_fit(scenario)
        .places.perturbations.at(static_cast<std::size_t>(place))
        .refuse("expected no damper: a fit knows no state of one");
  }
  if (rotation.kinds.empty() && plan.jumps.empty() && plan.parameters.empty()) return std::nullopt;
  return spin_drive(scenario);
}

fit::SpinSolution solved(const FitReport& report, const fit::SpinFit& fit,
                         const fit::SpinSolution* from) {
  if (!report.drive) return fit::fit_spin(fit);
  return fit::fit_driven_spin(fit, from != nullptr
                                       ? fit::solved_drive(report.problem, *report.drive, *from)
                                       : *report.drive);
}

std::vector<fit::PredictedAttitude> predicted_by(const FitReport& report,
                                                 const fit::SpinSolution& solution,
                                                 std::span<const double> times) {
  return report.drive ? fit::predicted(report.problem, *report.drive, solution, times)
                      : fit::predicted(report.problem, solution, times);
}

std::vector<double> unknowns_of(const FitReport& report, const fit::SpinState& about,
                                const fit::SpinSolution& solution) {
  return report.drive ? fit::unknowns_at(report.problem, *report.drive, about, solution)
                      : fit::unknowns_at(report.problem, about, solution.state);
}

std::vector<double> starts_of(const FitReport& report) {
  const fit::SpinState& start = report.problem.start;
  std::vector<double> x = fit::unknowns_at(report.problem, start, start);
  if (report.problem.unknowns.attitude) std::fill_n(x.begin(), 3, 0.0);  // not what rounding leaves
  if (!report.drive) return x;
  for (const fit::TorqueParameter& one : report.drive->parameters) x.push_back(one.start);
  for (const fit::SpinJump& jump : report.drive->jumps)
    for (int k = 0; k < 3; ++k) x.push_back(jump.change[k]);
  return x;
}

ShownUnit unit_of(const Scenario& scenario, const std::string& unknown) {
  const FitDrive& plan = require_fit(scenario).drive;
  for (const FreeParameter& one : plan.parameters)
    if (one.number.name == unknown) return {one.unit, nullptr, Dimension::number};
  Dimension dimension = dimension_of_unknown(unknown);
  for (const fit::SpinJump& jump : plan.jumps)
    if (unknown.starts_with(jump.name + "["))
      dimension = jump.of == fit::SpinJump::Of::rate ? Dimension::rate : Dimension::momentum;
  return {scenario.units().label(dimension), &scenario.units(), dimension};
}

fit::SpinState last_state(const FitReport& report, const fit::SpinSolution& solution) {
  return report.drive ? fit::after_jumps(report.problem, *report.drive, solution) : solution.state;
}

std::string text_with_torques(const Scenario& scenario, const FitReport& report,
                              const fit::SpinSolution& solution) {
  if (!report.drive) return scenario.document.text;
  std::vector<std::string> keys;
  std::vector<double> numbers;
  const fit::SpinDrive drive = fit::solved_drive(report.problem, *report.drive, solution);
  for (const fit::TorqueParameter& one : drive.parameters) {
    keys.push_back(one.name);
    numbers.push_back(one.start);
  }
  return VariedScenario(scenario, keys).text(numbers);
}

std::string jump_comment(const Scenario& scenario, const FitReport& report) {
  if (!report.drive || report.drive->jumps.empty()) return "";
  double last = report.drive->jumps.front().t;
  for (const fit::SpinJump& jump : report.drive->jumps) last = std::max(last, jump.t);
  return "# Its state is that after the last jump, carried back to t = 0: right from t = " +
         polhode::detail::number_text(scenario.units().from_core(last, Dimension::time)) + " " +
         scenario.units().time() + " on\n";
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
