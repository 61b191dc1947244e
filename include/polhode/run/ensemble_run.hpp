// SPDX-License-Identifier: MIT
// EnsembleRun: every member of an ensemble, on the processors of one machine or of several, into
// files that may be stopped, killed and resumed.
//
// Equations   those of the members; statistics: moments, quantiles, spread of attitudes,
//             fractions of the members in each regime.
// Units       those of the ensemble.
// Domain      by [ensemble] keep. Statistics: a row for each time of [time], of the members that
//             have one there. Final: a row for each member, its index, what was drawn, and its
//             last row. Rows: all of them, with the index in front. A member that failed has a row
//             of NaN, its rows so far, or no part in statistics; the first 20 of them and why are
//             said behind the rows, in comments or the attribute `failed`. Histograms go next to
//             the first output, FIRST.NAME.csv; an ensemble is complete when all of these files
//             are there. Files and checkpoints as in polhode/run/resumable_run.hpp.
// Accuracy    the files do not depend on the number of threads or processes (same build of polhode,
//             machines with the same elementary functions). Last digits of statistics depend on the
//             chunk of the file.
// Errors      the constructor as there, and DomainError for statistics that do not fit into memory,
//             for an executor with more processes than chunks, and for histograms or files of
//             chunks that are gone from what goes on or is complete. run() throws OutputError,
//             ExecutorError, RunInterrupted when `stop` said so, and EnsembleFailed where no member
//             is left: its files stay PATH.part. If `progress` throws, what is done is kept.
// Cost        that of the members, and some 80 ns a number in statistics, most of which waits for
//             memory (benchmarks/ensemble_members.cpp). Memory does not grow with the number of
//             members; for each thread the rows of sixteen members at most, and the statistics of
//             some chunks.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/run/ensemble.hpp"
#include "polhode/run/resumable_run.hpp"

namespace polhode {
inline namespace v0 {

// All members failed. The message has the first reasons.
class EnsembleFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What an ensemble found, earlier parts of it included.
struct EnsembleReport {
  struct Failure {
    std::int64_t member;
    std::string why;
  };
  struct Drawn {  // of a key, over all members
    double mean, deviation, least, greatest;
  };
  struct FirstTimes {  // of an event
    std::string event;
    double part;  // of the members that did not fail to which it happened
    // By when it had happened to so many of them, for each of the quantiles of the plan; NaN where
    // fewer ever had it. In the unit of time of the file.
    std::vector<double> times;
  };
  struct Histogram {
    std::string name;
    // t; the edges of a bin of each column; how many members are in it, and which part of those
    // that have the numbers. The first and the last bin of a column are open.
    std::vector<ColumnGroup> groups;
    std::vector<double> rows;  // bins of the last column side by side
    std::string path;          // of its file; empty: it has none
  };

  std::int64_t members = 0;
  std::int64_t failed = 0;
  std::vector<Failure> failures;      // the first 20
  std::vector<Drawn> drawn;           // in the order of the keys of the plan
  std::vector<double> statistics;     // the last row of these; empty where other things are kept
  std::vector<FirstTimes> events;     // beside statistics
  std::vector<Histogram> histograms;  // beside statistics, in the order of the plan
};

class EnsembleRun : public ResumableRun {
 public:
  // Opens every output. `ensemble` must outlive it.
  EnsembleRun(const ScenarioEnsemble& ensemble, const std::vector<std::string>& outputs,
              RunOptions options);

  // The columns of what is written.
  const std::vector<ColumnGroup>& groups() const;
  // Once.
  EnsembleReport run();

 private:
  class Parts;
};

// The work of a process that computes chunks of the ensemble of a scenario for another process
// (RunOptions::executor). begin() throws DomainError for bytes of another ensemble, with the
// difference; `any_machine` as in RunOptions.
std::unique_ptr<ExecutorWork> ensemble_work(Scenario scenario, bool any_machine = false);

// The columns that the outputs of an ensemble have.
std::vector<ColumnGroup> ensemble_groups(const ScenarioEnsemble& ensemble);

// Of a member that was written alone.
struct MemberReport {
  bool was_complete = false;  // its files were there: nothing was done
  std::string failure = {};   // why it could not go on; its files are left as PATH.part
};
// The rows of a member with all columns that the ensemble knows of it, those of row_groups(), into
// files that say its scenario, that of member_scenario(index). They are kept in memory, without
// checkpoints; of the options begin and words count. Throws as the constructor of EnsembleRun.
MemberReport write_member(const ScenarioEnsemble& ensemble, std::int64_t index,
                          const Scenario& scenario, const std::vector<std::string>& outputs,
                          const RunOptions& options = {});

}  // namespace v0
}  // namespace polhode
