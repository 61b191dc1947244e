// SPDX-License-Identifier: MIT
// In this header: ensemble, ensemble_run.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/column_kind.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// ScenarioEnsemble: a scenario with a table [ensemble]: the runs of its members, of which each can
// be asked for alone, in any order.
//
// Equations   those of the scenario; of what is drawn those of Draws (polhode/ensemble/draws.hpp).
// Units       those of the scenario; drawn numbers in the units that their keys have in it.
// Domain      any kind of experiment with [time]. A member is the scenario with its numbers; which
//             numbers these are depends on the seed and its index alone. Rows of a member that an
//             event stops end there. Behind the columns of its run they have one for each event:
//             EVENT_first, when it first happened, NaN before and where it has not; and the
//             indicators of chaos that the plan asks for.
// Accuracy    that of the method. What rows have of the run is that of a run of member_text(k), to
//             the last bit.
// Errors      ScenarioError for what is no ensemble. A member that cannot be (a chart refuses its
//             numbers) or cannot go on says why. DomainError for an index outside.
// Cost        its run, and some 20 us to make the experiment again: text is not read twice, and
//             tables, meshes and files are those of the scenario unless a number below them varies.
//             The rows of exact free rotation are evaluated together.

struct EnsembleMember {
  std::vector<double> drawn;  // at the keys of the plan
  std::vector<double> rows;   // one after the other, up to where it ended
  std::string failure;        // empty: it did not
};

class ScenarioEnsemble {
 public:
  // `name` stands for the file in messages and outputs.
  ScenarioEnsemble(std::string_view text, const std::string& name,
                   const Kinds& kinds = default_kinds());
  explicit ScenarioEnsemble(Scenario scenario);
  ~ScenarioEnsemble();
  ScenarioEnsemble(const ScenarioEnsemble&) = delete;
  ScenarioEnsemble& operator=(const ScenarioEnsemble&) = delete;

  const Scenario& scenario() const;
  const EnsemblePlan& plan() const { return *scenario().ensemble; }
  std::int64_t size() const { return plan().size; }
  // The columns of the rows of a member, t first.
  const std::vector<ColumnGroup>& row_groups() const;
  // The names of the events that have a column, in its order.
  const std::vector<std::string>& events() const;

  // From any thread. What `progress` throws passes through.
  EnsembleMember member(std::int64_t index, const Progress& progress = {}) const;
  // Members begin to end - 1.
  std::vector<EnsembleMember> members(std::int64_t begin, std::int64_t end,
                                      const Progress& progress = {}) const;
  // Of the scenario as it stands; nothing is drawn.
  EnsembleMember base(const Progress& progress = {}) const;
  // The text of the scenario with the numbers of a member, without its [ensemble].
  std::string member_text(std::int64_t index) const;
  // The scenario of this text, complete: it can be run, mapped and changed.
  Scenario member_scenario(std::int64_t index) const;
  // The same for a caller that has the text.
  Scenario member_scenario(std::int64_t index, std::string member_text) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

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
//             are there. Files and checkpoints as in polhode/run/scenario_run.hpp.
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
std::unique_ptr<ensemble::ExecutorWork> ensemble_work(Scenario scenario, bool any_machine = false);

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

}  // namespace io
}  // namespace v0
}  // namespace polhode
