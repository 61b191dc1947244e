// SPDX-License-Identifier: MIT
// What a fit leaves on the disk: residuals, covariance, and scenarios that go on from a solution.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "polhode/run/fit.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/moved_files.hpp"
#include "run/fit/driven.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// One row of residuals.
struct Residual {
  double t;
  ObservedRow place;
  Vec3 turn{none, none, none}, rate{none, none, none}, sigmas{none, none, none};
};

// The smallest rotation, in body axes, that takes the direction that is predicted to the one seen.
Vec3 turn_to(const Vec3& predicted, const Vec3& seen) {
  const Vec3 across = cross(seen, predicted);
  const double sine = norm(across);
  return sine > 0.0 ? (std::atan2(sine, dot(seen, predicted)) / sine) * across : Vec3{};
}

std::vector<Residual> residuals_of(const FitReport& report, const SpinSolution& found) {
  const ReadObservations& observed = report.observed;
  const Snapshots& seen = observed.seen;
  const std::vector<double> times = times_of(seen);
  const std::vector<PredictedAttitude> at = detail::predicted_by(report, found, times);
  std::vector<Residual> all;
  std::size_t k = 0, number = 0;
  const auto add = [&](const ObservedRow& place, std::size_t size) -> Residual& {
    Residual& one = all.emplace_back(Residual{times[k++], place});
    for (std::size_t i = 0; i < size; ++i)
      one.sigmas[static_cast<int>(i)] = found.result.numbers.at(number++);
    return one;
  };
  for (std::size_t i = 0; i < seen.attitudes.size(); ++i) {
    const Quaternion& q = at[k].q;
    add(observed.attitudes[i], 3).turn = attitude_residual(seen.attitudes[i].q, q);
  }
  for (std::size_t i = 0; i < seen.directions.size(); ++i) {
    const ObservedDirection& one = seen.directions[i];
    const Vec3 in_body = rotate(conj(at[k].q), one.direction_I);
    const Vec3 turn = turn_to(one.axis_F, in_body);
    add(observed.directions[i], 2).turn = turn;
  }
  for (std::size_t i = 0; i < seen.rates.size(); ++i) {
    const Vec3 rate = at[k].w_F - seen.rates[i].w_F;
    add(observed.rates[i], 3).rate = rate;
  }
  std::stable_sort(all.begin(), all.end(), [](const Residual& a, const Residual& b) {
    return std::pair(a.place.table, a.place.line) < std::pair(b.place.table, b.place.line);
  });
  return all;
}

void add_body(const Scenario& scenario, const FitReport& report, const SpinState& state,
              std::vector<ScenarioChange>& changes) {
  const SpinUnknowns& unknowns = report.problem.unknowns;
  if (!unknowns.moment_ratios && !unknowns.products) return;
  const Mat3& T = state.inertia_F;
  const bool has_moments =
      scenario.rotation().shape == nullptr && scenario.rotation().q_file == Quaternion{};
  const bool is_diagonal = T(0, 1) == 0.0 && T(0, 2) == 0.0 && T(1, 2) == 0.0;
  for (const char* const key : {"moments", "tensor", "shape", "density", "scale", "column_axes"})
    changes.push_back({std::string("body.") + key, ""});
  if (has_moments && is_diagonal && !unknowns.products)
    changes.push_back({"body.moments", detail::row_text(T(0, 0), T(1, 1), T(2, 2))});
  else
    changes.push_back({"body.tensor", "[" + detail::row_text(T(0, 0), T(0, 1), T(0, 2)) + ", " +
                                          detail::row_text(T(0, 1), T(1, 1), T(1, 2)) + ", " +
                                          detail::row_text(T(0, 2), T(1, 2), T(2, 2)) + "]"});
}

}  // namespace

void write_residuals(const Scenario& scenario, const FitReport& report, std::size_t solution,
                     const std::string& path) {
  const Units& units = scenario.units();
  const std::string angle = units.label(Dimension::angle), rate = units.label(Dimension::rate);
  const std::vector<ColumnGroup> groups = {
      {"t", {{"t", units.time()}}},
      {"observation", {{"table", "1"}, {"line", "1"}}},
      {"turn", {{"turn_x", angle}, {"turn_y", angle}, {"turn_z", angle}}},
      {"rate", {{"dw_x", rate}, {"dw_y", rate}, {"dw_z", rate}}},
      {"sigmas", {{"r1", "1"}, {"r2", "1"}, {"r3", "1"}}}};
  std::vector<double> rows;
  for (const Residual& one : residuals_of(report, report.solutions.at(solution).raw)) {
    rows.insert(rows.end(),
                {units.from_core(one.t, Dimension::time), static_cast<double>(one.place.table + 1),
                 static_cast<double>(one.place.line)});
    for (int i = 0; i < 3; ++i) rows.push_back(units.from_core(one.turn[i], Dimension::angle));
    for (int i = 0; i < 3; ++i) rows.push_back(units.from_core(one.rate[i], Dimension::rate));
    for (int i = 0; i < 3; ++i) rows.push_back(one.sigmas[i]);
  }
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < require_fit(scenario).observations.size(); ++i) {
    const Observation& of = require_fit(scenario).observations[i];
    notes.push_back("table " + std::to_string(i + 1) + ": " + std::string(kind_word(of.kind)) +
                    ", " + detail::printable(of.shown(), 500));
  }
  notes.emplace_back(
      "residuals: from what was seen to the solution, in body axes; r1, r2, r3 in standard errors "
      "as given");
  detail::write_fit_rows(scenario, groups, rows, notes, path);
}

void write_covariance(const Scenario& scenario, const FitReport& report, std::size_t solution,
                      const std::string& path) {
  const FoundSpin& found = report.solutions.at(solution);
  detail::write_fit_covariance(scenario, found.raw.covariance,
                               fit_numbers(scenario, report, solution), path);
}

std::string detail::text_from_state(const Scenario& scenario, const FitReport& report,
                                    const SpinSolution& raw, const SpinState& state,
                                    const std::string& folder) {
  std::vector<ScenarioChange> changes = moved_files(scenario.document, folder);
  const std::vector<ScenarioChange> none_seen = without_observations(scenario);
  changes.insert(changes.end(), none_seen.begin(), none_seen.end());
  add_body(scenario, report, state, changes);
  changes.push_back({"state." + scenario.rotation().chart, ""});
  changes.push_back(detail::state_change(scenario, state.q, state.w_F));
  detail::add_rows_of(scenario, times_of(report.observed.seen), changes);
  detail::add_torques(scenario, report, raw, changes);
  return changed_text(scenario.document.text, changes);
}

std::string solution_text(const Scenario& scenario, const FitReport& report, std::size_t solution,
                          const std::optional<std::string>& folder) {
  const SpinSolution& raw = report.solutions.at(solution).raw;
  return "# Solution " + std::to_string(solution + 1) + " of " +
         std::to_string(report.solutions.size()) + " of a fit of " +
         detail::printable(scenario.document.name, 200) + "\n" +
         detail::jump_comment(scenario, report) +
         detail::text_from_state(scenario, report, raw, detail::last_state(report, raw),
                                 folder.value_or(scenario.document.folder));
}

void write_solution(const Scenario& scenario, const FitReport& report, std::size_t solution,
                    const std::string& path) {
  const std::string folder = detail::folder_of(scenario.document, path);
  detail::write_fit_text(scenario, solution_text(scenario, report, solution, folder), path);
}

}  // namespace v0
}  // namespace polhode
