// SPDX-License-Identifier: MIT
// fit_scenario: a scenario of kind "fit" from what was observed to its solutions, and what is made
// of them: a table, JSON, residuals and covariance as files, scenarios that go on from a solution.
//
// Equations   those of fit_spin (polhode/fit/spin_fit.hpp), and with torques or jumps of
//             fit_driven_spin (polhode/fit/driven_spin_fit.hpp).
// Units       core units; texts and files in the units of the scenario.
// Domain      rotation relative to inertial axes, free or under the torques of the file, whose
//             damper it may not have. Two solutions are the same within a
//             Mahalanobis distance of 1. What did not converge is counted, and is no solution.
// Accuracy    that of fit_spin. Starts other than the file's depend on the seed and their place
//             alone.
// Errors      ScenarioError at the place of what a fit does not take, and for more unknowns than
//             data; as read_observations (polhode/scenario/observation.hpp). Files: OutputError.
//             It throws RunInterrupted if `stop` returns true.
// Cost        2 ms a start of 17 attitudes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/spin_fit.hpp"
#include "polhode/output/columns.hpp"
#include "polhode/run/resumable_run.hpp"
#include "polhode/scenario/fit_plan.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {

class CellJournal;

struct FoundSpin {
  SpinSolution raw;  // with errors as they were given
  // With those that make chi-square per degree of freedom 1; none without degrees of freedom.
  std::optional<SpinSolution> scaled;
  std::int64_t start = 0;   // the first that led to it, from 0
  std::int64_t starts = 1;  // how many did
};

struct FitReport {
  SpinFit problem;                 // from the start of the file, with errors as they were given
  std::optional<SpinDrive> drive;  // torques and jumps; none of free rotation
  ReadObservations observed;
  std::vector<FoundSpin> solutions;  // by what they cost
  std::int64_t starts = 1;
  std::int64_t failed = 0;  // starts from which nothing converged
  std::string failure;      // what was said of the first of them

  bool is_found() const { return !solutions.empty(); }
};

// What a fit solves: from the start of the file, with errors as they were given. ScenarioError as
// fit_scenario.
struct FitProblem {
  SpinFit fit;
  std::optional<SpinDrive> drive;
  ReadObservations observed;
};
FitProblem fit_problem(const Scenario& scenario);

// Options of every kind of fit.
struct FitOptions {
  int threads = 1;          // the result does not depend on it
  bool scans_only = false;  // light curves: ends after the scan, without a solution
  // Light curves: called when a stage begins, "scan", "search", "surfaces" or "sessions", with how
  // much work it is: "44521 pairs of frequencies".
  std::function<void(const std::string& stage, const std::string& work)> begins = {};
  // Called with the starts done or the part of a stage, one call after the other.
  std::function<void(const RunProgress&)> progress = {};
  std::function<bool()> stop = {};  // asked before each start or fit, in any of the threads
  CellJournal* journal = nullptr;   // keeps the results of a fit that may be interrupted
};

FitReport fit_scenario(const Scenario& scenario, const FitOptions& options = {});

// One of the unknowns of a solution, in the units of the scenario: turns from the attitude of the
// start of the file, about the body axes.
struct FitNumber {
  std::string name;  // "w_x"
  std::string unit;  // "deg/d"; "1"
  double value, error;
  std::optional<double> start = std::nullopt;  // none in a search
  std::optional<double> scaled_value = std::nullopt, scaled_error = std::nullopt;
};
std::vector<FitNumber> fit_numbers(const Scenario& scenario, const FitReport& report,
                                   std::size_t solution);

// For people, and for programs with every digit; with what each solution predicts at times
// (predictions.hpp).
std::string fit_text(const Scenario& scenario, const FitReport& report,
                     std::span<const double> times = {});
std::string fit_json(const Scenario& scenario, const FitReport& report,
                     std::span<const double> times = {});

// DomainError where one of these paths is the scenario, a file that it reads, or another of them:
// what the writers below refuse, before the work.
void require_own_files(const Scenario& scenario, std::span<const std::string> paths);

// A row for each observation, in the order of tables and lines: table and line from 1, the rotation
// or the difference of rates from what was seen to the solution, and both in standard errors.
void write_residuals(const Scenario& scenario, const FitReport& report, std::size_t solution,
                     const std::string& path);
// A row and a column for each unknown, errors as they were given; a last column has scaled errors.
void write_covariance(const Scenario& scenario, const FitReport& report, std::size_t solution,
                      const std::string& path);

// A scenario of kind "rotation" that begins at the solution: the file without what was observed,
// with the torques of the solution. After jumps its state is that of the motion after the last one.
// Where it has no [time], rows go from the first observation to the last. Paths in it start in
// `folder`; left out, where those of this scenario do.
std::string solution_text(const Scenario& scenario, const FitReport& report, std::size_t solution,
                          const std::optional<std::string>& folder = std::nullopt);
// Writes it as PATH.part and gives it its name; its paths start in the folder of PATH.
void write_solution(const Scenario& scenario, const FitReport& report, std::size_t solution,
                    const std::string& path);

}  // namespace v0
}  // namespace polhode
