// SPDX-License-Identifier: MIT
#include "run/fit/fit_torques.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "run/detail/fit_tables.hpp"
#include "scenario/number_location.hpp"
#include "scenario/values.hpp"
#include "text/number_text.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// A number in its own unit, in the unit that stands beside it.
std::string element(double x, const std::string& unit) {
  return unit.empty() ? number_text(x) : "\"" + number_text(x) + " " + unit + "\"";
}

std::string in_rows(const std::vector<std::string>& elements, std::size_t row) {
  std::string text = "[";
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (row > 0 && i % row == 0) text += i == 0 ? "[" : "], [";
    text += (i == 0 || (row > 0 && i % row == 0) ? "" : ", ") + elements[i];
  }
  return text + (row > 0 ? "]]" : "]");
}

// The whole value of a key with some of its numbers changed, those in the units that they have.
std::string value_text(const Value& value, const std::map<std::size_t, double>& own,
                       const Units& units) {
  std::vector<std::string> elements;
  for (std::size_t i = 0; i < value.numbers.size(); ++i) {
    const std::string& unit = value.units[i];
    const Dimension dimension = value.key->dimension;
    const auto changed = own.find(i);
    const double x = changed != own.end() ? changed->second
                     : unit.empty()       ? units.from_core(value.numbers[i], dimension)
                                          : value.numbers[i] / units.to_core(1.0, unit, dimension);
    elements.push_back(element(x, unit));
  }
  if (value.key->type == KeyType::number || elements.size() == 1) return elements.front();
  const bool is_square = value.key->type != KeyType::numbers && elements.size() == 9;
  return in_rows(elements, is_square ? 3 : 0);
}

}  // namespace

std::optional<SpinDrive> drive_of(const Scenario& scenario) {
  const Rotation& rotation = scenario.rotation();
  const FitDrive& plan = require_fit(scenario).drive;
  if (rotation.damper) {
    const auto place = std::ranges::find(rotation.kinds, "kane-damper") - rotation.kinds.begin();
    refuse(scenario.document.checked->values, "perturbation[" + std::to_string(place) + "].kind",
           scenario.document.path, "expected no damper: a fit knows no state of one");
  }
  if (rotation.kinds.empty() && plan.jumps.empty() && plan.parameters.empty()) return std::nullopt;
  return spin_drive(scenario);
}

SpinSolution solved(const FitReport& report, const SpinFit& fit, const SpinSolution* from) {
  if (!report.drive) return fit_spin(fit);
  return fit_driven_spin(
      fit, from != nullptr ? solved_drive(report.problem, *report.drive, *from) : *report.drive);
}

std::vector<PredictedAttitude> predicted_by(const FitReport& report, const SpinSolution& solution,
                                            std::span<const double> times) {
  return report.drive ? predicted(report.problem, *report.drive, solution, times)
                      : predicted(report.problem, solution, times);
}

std::vector<double> unknowns_of(const FitReport& report, const SpinState& about,
                                const SpinSolution& solution) {
  return report.drive ? unknowns_at(report.problem, *report.drive, about, solution)
                      : unknowns_at(report.problem, about, solution.state);
}

std::vector<double> starts_of(const FitReport& report) {
  const SpinState& start = report.problem.start;
  std::vector<double> x = unknowns_at(report.problem, start, start);
  if (report.problem.unknowns.attitude) std::fill_n(x.begin(), 3, 0.0);  // not what rounding leaves
  if (!report.drive) return x;
  for (const TorqueParameter& one : report.drive->parameters) x.push_back(one.start);
  for (const SpinJump& jump : report.drive->jumps)
    for (int k = 0; k < 3; ++k) x.push_back(jump.change[k]);
  return x;
}

ShownUnit unit_of(const Scenario& scenario, const std::string& unknown) {
  const FitDrive& plan = require_fit(scenario).drive;
  for (const FreeParameter& one : plan.parameters)
    if (one.number.name == unknown) return {one.unit, nullptr, Dimension::number};
  Dimension dimension = dimension_of_unknown(unknown);
  for (const SpinJump& jump : plan.jumps)
    if (unknown.starts_with(jump.name + "["))
      dimension = jump.of == SpinJump::Of::rate ? Dimension::rate : Dimension::momentum;
  return {scenario.units().label(dimension), &scenario.units(), dimension};
}

SpinState last_state(const FitReport& report, const SpinSolution& solution) {
  return report.drive ? after_jumps(report.problem, *report.drive, solution) : solution.state;
}

void add_torques(const Scenario& scenario, const FitReport& report, const SpinSolution& solution,
                 std::vector<ScenarioChange>& changes) {
  if (!report.drive) return;
  const Values& values = scenario.document.checked->values;
  const SpinDrive drive = solved_drive(report.problem, *report.drive, solution);
  std::map<std::string, std::map<std::size_t, double>> found;
  for (const TorqueParameter& one : drive.parameters) {
    const NumberLocation place = *number_location(values, one.name);
    found[place.path][place.index] = one.start;
  }
  for (const auto& [path, numbers] : found)
    changes.push_back({path, value_text(value_at(values, path), numbers, scenario.units())});
}

std::string jump_comment(const Scenario& scenario, const FitReport& report) {
  if (!report.drive || report.drive->jumps.empty()) return "";
  double last = report.drive->jumps.front().t;
  for (const SpinJump& jump : report.drive->jumps) last = std::max(last, jump.t);
  return "# Its state is that after the last jump, carried back to t = 0: right from t = " +
         number_text(scenario.units().from_core(last, Dimension::time)) + " " +
         scenario.units().time() + " on\n";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
