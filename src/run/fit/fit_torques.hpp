// SPDX-License-Identifier: MIT
// Fits of files with torques or jumps, and those of free rotation, by one name.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/fit.hpp"
#include "polhode/scenario/changes.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// None of free rotation. ScenarioError for what a fit does not take.
std::optional<fit::SpinDrive> drive_of(const Scenario& scenario);

// From a start; with `from`, torques and jumps begin where that solution has them.
fit::SpinSolution solved(const FitReport& report, const fit::SpinFit& fit,
                         const fit::SpinSolution* from = nullptr);
std::vector<fit::PredictedAttitude> predicted_by(const FitReport& report,
                                                 const fit::SpinSolution& solution,
                                                 std::span<const double> times);
// Turns from `about`.
std::vector<double> unknowns_of(const FitReport& report, const fit::SpinState& about,
                                const fit::SpinSolution& solution);
// Those of the start of the file.
std::vector<double> starts_of(const FitReport& report);

// How an unknown is shown: its unit, and a number of it in that unit.
struct ShownUnit {
  std::string label;
  const Units* units;  // null: numbers are in it
  Dimension dimension;

  double of(double x) const { return units == nullptr ? x : units->from_core(x, dimension); }
};
ShownUnit unit_of(const Scenario& scenario, const std::string& unknown);

// The state that a scenario of the solution begins with, that after the last jump, and the text of
// the file with the torques of the solution.
fit::SpinState last_state(const FitReport& report, const fit::SpinSolution& solution);
std::string text_with_torques(const Scenario& scenario, const FitReport& report,
                              const fit::SpinSolution& solution);
// The scenario of a solution, from a state at its beginning, for a file in `folder`.
std::string text_from_state(const Scenario& scenario, const FitReport& report,
                            const fit::SpinSolution& solution, const fit::SpinState& state,
                            const std::string& folder);
// What of the file says that: a comment, or nothing.
std::string jump_comment(const Scenario& scenario, const FitReport& report);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
