// SPDX-License-Identifier: MIT
// In this header: resumable_run, scenario_run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/ensemble/executor.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/run/run.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// Runs, maps, ensembles and fits that write files: how they begin, how they are stopped, killed and
// resumed.
//
// Domain      one that is under way has a small file FIRST_OUTPUT.checkpoint, from which it can be
//             resumed. It is replaced every few seconds, and removed when all is complete or
//             has failed for good; PATH.checkpoint next to each other output holds the path to it.
//             Outputs that are not files ("-", a pipe, a device) have no checkpoints.
// Accuracy    one that was interrupted and resumed, however often and on any number of threads,
//             leaves the same files: text byte for byte, HDF5 with the same contents (same build
//             of polhode).
// Errors      constructors throw DomainError: for outputs that cannot be written, for a checkpoint
//             that is there although neither resume nor restart was asked for, and for one of
//             another scenario, version, columns or outputs, with what differs.
// Cost        a checkpoint is a few kB and a few fsync, at most a twentieth of the time.
namespace detail {
class Sweep;
}  // namespace detail

// How to begin if the outputs of an unfinished run are there.
enum class RunBegin {
  anew,     // the constructor throws, so that nothing is lost
  resume,   // continues the unfinished run, or begins if there is none
  restart,  // begins again and loses the unfinished run
};

// The words for resume and restart in messages.
struct BeginWords {
  std::string resume = "resume";
  std::string restart = "restart";
  std::string any_machine = "any_machine";  // of maps and ensembles
};

struct RunProgress {
  double reached;  // t in core units; or the number of cells, members or starts so far
  double part;     // estimated fraction of the time since it began or was resumed; 0: unknown
};

struct RunOptions {
  RunBegin begin = RunBegin::anew;
  BeginWords words = {};
  double checkpoint_seconds = 5.0;  // between two checkpoints, at least
  // Called after every step, block of rows, cell or chunk, one call after the other, from any
  // thread. What it throws ends the work and passes through.
  std::function<void(const RunProgress&)> progress = {};
  std::function<bool()> stop = {};        // asked after every step, from any thread
  std::unique_ptr<Sink> extra_sink = {};  // also gets the rows of this part of the work
  // Maps and ensembles compute this many cells or chunks at a time; 0 means one on each
  // processor.
  int threads = 0;
  // Computes the cells of a map or the chunks of an ensemble in several processes, each with a
  // map_work or ensemble_work of the same scenario, instead of on threads.
  ensemble::Executor* executor = nullptr;
  // Maps and ensembles may run on machines whose sines and logarithms differ in the last digits,
  // together or one after the other. The results then differ in the last digits.
  bool any_machine = false;
  // The report of a run has all events, not only the first 20.
  bool keep_events = false;
};

// Thrown if the work is stopped from outside. The files hold what was done until then.
class RunInterrupted : public std::runtime_error {
 public:
  explicit RunInterrupted(const std::string& what, double at = 0.0, bool resumes = false)
      : std::runtime_error(what), reached(at), can_resume(resumes) {}
  double reached;   // as that of RunProgress
  bool can_resume;  // whether there is a checkpoint of that moment
};

// Base of ScenarioRun, MapRun, EnsembleRun and FitCheckpoint: the state in which they begin.
class ResumableRun {
 public:
  ResumableRun(const ResumableRun&) = delete;
  ResumableRun& operator=(const ResumableRun&) = delete;

  // True if an unfinished run is continued, from reached() with rows() in its files.
  bool continues() const;
  // True if all files are complete.
  bool is_complete() const;
  double reached() const;  // as that of RunProgress
  std::int64_t rows() const;

 protected:
  explicit ResumableRun(std::unique_ptr<detail::Sweep> sweep);
  ~ResumableRun();
  std::unique_ptr<detail::Sweep> sweep_;
};

// ScenarioRun: a scenario's run into files that may be stopped, killed and resumed.
//
// Equations   those of the system.
// Units       t in core units; rows in those of the scenario.
// Domain      a scenario with [time]; files and checkpoints as in polhode/run/scenario_run.hpp.
// Errors      the constructor as there. run() as polhode::run, and RunInterrupted when `stop` said
//             so.
// Cost        memory does not grow with the length of the run.

struct RunFiles {
  std::vector<std::string> outputs;  // what open_sink takes
  std::string events = {};           // PATH.csv; empty: none
};

class ScenarioRun : public ResumableRun {
 public:
  // Opens every output. `scenario` must outlive it.
  ScenarioRun(const Scenario& scenario, RunFiles files, RunOptions options);

  // Once.
  RunReport run();

 private:
  class Parts;
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
