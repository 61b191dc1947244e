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
//             data; as read_observations (polhode/scenario/observation_kind.hpp). Files:
//             OutputError.
//             It throws RunInterrupted if `stop` returns true.
// Cost        2 ms a start of 17 attitudes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/fit/spin_fit.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
class CellJournal;
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode

namespace polhode {
inline namespace v0 {
namespace io {

struct FoundSpin {
  fit::SpinSolution raw;  // with errors as they were given
  // With those that make chi-square per degree of freedom 1; none without degrees of freedom.
  std::optional<fit::SpinSolution> scaled;
  std::int64_t start = 0;   // the first that led to it, from 0
  std::int64_t starts = 1;  // how many did
};

struct FitReport {
  fit::SpinFit problem;  // from the start of the file, with errors as they were given
  std::optional<fit::SpinDrive> drive;  // torques and jumps; none of free rotation
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
  fit::SpinFit fit;
  std::optional<fit::SpinDrive> drive;
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
  ensemble::CellJournal* journal = nullptr;  // keeps the results of a fit that may be interrupted
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

// FitCheckpoint: what a fit has found so far, kept in FIRST_OUTPUT.checkpoint, so that a fit that
// was stopped or killed continues, as runs do (polhode/run/scenario_run.hpp).
//
// Domain      starts, scans and fits that are done are not computed again; those that were begun
//             are. Without an output that is a file there is no checkpoint. Two fits must not write
//             the same outputs at the same time.
// Accuracy    a fit that was interrupted and continued finds what a fit in one go finds, to the
//             last bit (same build of polhode).
// Errors      the constructor as there.
// Cost        the bytes of all results, chi-square of each pair of a scan included, held in memory
//             and written as a whole; at most a twentieth of the time of the fit.

class FitCheckpoint : public ResumableRun {
 public:
  // `outputs` are the files that the fit will write, the first of which gives the checkpoint its
  // name; of the options begin, words and checkpoint_seconds count. `scenario` must outlive it.
  FitCheckpoint(const Scenario& scenario, const std::vector<std::string>& outputs,
                RunOptions options);

  // For the options of the fit. Checkpoints are written while it gets results.
  ensemble::CellJournal& journal();
  // Writes a checkpoint; false if this fit has none.
  bool keep();
  // Removes the checkpoint: the fit is complete, or has no solution.
  void forget();

 private:
  class Parts;
  Parts& parts();
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
