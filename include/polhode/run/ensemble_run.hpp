// SPDX-License-Identifier: MIT
// EnsembleRun: every member of an ensemble, on the processors of one machine, into files that may
// be stopped, killed and continued.
//
// Equations   those of the members; statistics those of NumberMoments, Quantiles, AttitudeSpread
//             and Fractions (polhode/ensemble).
// Units       those of the ensemble.
// Domain      by [ensemble] keep. Statistics: a row for each time of [time], of the members that
//             have one there. Final: a row for each member, its index, what was drawn, and its
//             last row. Rows: all of them, with the index in front. A member that failed has a row
//             of NaN, its rows so far, or no part in statistics; the first 20 of them and why are
//             said behind the rows, in comments or the attribute `failed`. Histograms go next to
//             the first output, FIRST.NAME.csv. While it goes on, FIRST_OUTPUT.checkpoint says how
//             to go on, as that of a run does (polhode/run/scenario_run.hpp). An ensemble is
//             complete when all of these files are there.
// Accuracy    the files do not depend on the number of threads or processes, nor on where an
//             ensemble was stopped, killed and continued: text files byte for byte, HDF5 with the
//             same contents (same build of polhode, machines with the same elementary functions).
//             Last digits of statistics depend on the chunk of the file.
// Errors      the constructor throws DomainError as that of ScenarioRun, for statistics that do not
//             fit into memory, for a team with more processes than chunks, and for histograms or
//             files of chunks that are gone from what goes on or is complete. run() throws
//             OutputError, TeamError, EnsembleInterrupted when `stop` said so, and EnsembleFailed
//             where no member is left: its files stay PATH.part. What `progress` throws ends it and
//             passes through; what is done is kept.
// Cost        that of the members, and some 80 ns a number in statistics, most of which waits for
//             memory (benchmarks/ensemble_members.cpp). Memory does not grow with the number of
//             members; for each thread the rows of sixteen members at most, and the statistics of
//             some chunks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/ensemble/team.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/run/ensemble.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode {
inline namespace v0 {

// The ensemble was stopped from outside. Its files are there, up to a member.
class EnsembleInterrupted : public std::runtime_error {
 public:
  EnsembleInterrupted(const std::string& what, std::int64_t done, bool resumes)
      : std::runtime_error(what), members(done), can_resume(resumes) {}
  std::int64_t members;
  bool can_resume;  // whether there is a checkpoint of that moment
};

// All members failed. The message has the first reasons.
class EnsembleFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct EnsembleOptions {
  RunBegin begin = RunBegin::anew;
  double checkpoint_seconds = 5.0;  // between two checkpoints, at least
  // Whether machines may work together, or one after the other, whose sines and logarithms differ
  // in last digits: so do the results then.
  bool any_machine = false;
  int threads = 0;  // chunks at a time; 0: one on each processor
  // Computes the chunks in place of these threads: several processes, each with an ensemble_work
  // (polhode/run/ensemble_work.hpp) of the same ensemble.
  Team* team = nullptr;
  // Called with the number of members so far, one call after the other, from any thread.
  std::function<void(std::int64_t members)> progress = {};
  std::function<bool()> stop = {};        // asked after every step, from any thread
  std::unique_ptr<Sink> extra_sink = {};  // gets the rows of this part of the ensemble too
  BeginWords words = {};
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

class EnsembleRun {
 public:
  // Opens every output. `ensemble` must outlive it.
  EnsembleRun(const ScenarioEnsemble& ensemble, const std::vector<std::string>& outputs,
              EnsembleOptions options);
  ~EnsembleRun();
  EnsembleRun(const EnsembleRun&) = delete;
  EnsembleRun& operator=(const EnsembleRun&) = delete;

  // The columns of what is written.
  const std::vector<ColumnGroup>& groups() const;
  // What it found: an ensemble to continue, after members(); or all files complete, nothing to do.
  bool continues() const;
  bool is_complete() const;
  std::int64_t members() const;

  // Once.
  EnsembleReport run();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

// The columns that the outputs of an ensemble have.
std::vector<ColumnGroup> ensemble_groups(const ScenarioEnsemble& ensemble);

// Of a member that was written alone.
struct MemberReport {
  bool was_complete = false;  // its files were there: nothing was done
  std::string failure = {};   // why it could not go on; its files are left as PATH.part
};
// The rows of a member with all columns that the ensemble knows of it, those of row_groups(), into
// files that say its scenario, that of member_scenario(index). They are kept in memory, without
// checkpoints. Throws as the constructor of EnsembleRun.
MemberReport write_member(const ScenarioEnsemble& ensemble, std::int64_t index,
                          const Scenario& scenario, const std::vector<std::string>& outputs,
                          RunBegin begin = RunBegin::anew, const BeginWords& words = {});

}  // namespace v0
}  // namespace polhode
