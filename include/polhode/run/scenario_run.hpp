// SPDX-License-Identifier: MIT
// ScenarioRun: a scenario's run into files that may be stopped, killed and continued.
//
// Equations   those of the system.
// Units       t in core units; rows in those of the scenario.
// Domain      a scenario with [time]. While it goes on, a small file FIRST_OUTPUT.checkpoint says
//             how to go on: it is replaced every few seconds, and removed when the run is complete
//             or has failed for good; PATH.checkpoint next to the other outputs says where it is.
//             Outputs that are not files ("-", a pipe, a device) make a run without checkpoints.
// Accuracy    a run that was stopped at any moment and continued, however often, leaves the files
//             of the straight run: text files byte for byte, HDF5 with the same contents (same
//             build of polhode).
// Errors      the constructor throws DomainError: for outputs that cannot be, for a checkpoint
//             that is there when neither resume nor restart was asked for, and for one of another
//             scenario, version, columns or outputs, saying which. run() as polhode::run, and
//             RunInterrupted when `stop` said so.
// Cost        a checkpoint is some kB and a few fsync, at most a twentieth of the time of the run.
//             Memory does not grow with the length of the run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/run/run.hpp"

namespace polhode {
inline namespace v0 {

// The run was stopped from outside. Its files are there, up to `t`.
class RunInterrupted : public std::runtime_error {
 public:
  RunInterrupted(const std::string& what, double at, bool resumes)
      : std::runtime_error(what), t(at), can_resume(resumes) {}
  double t;         // core units
  bool can_resume;  // whether there is a checkpoint of that moment
};

struct RunFiles {
  std::vector<std::string> outputs;  // what open_sink takes
  std::string events = {};           // PATH.csv; empty: none
};

// What to do where a run has been before.
enum class RunBegin {
  anew,     // nothing but its complete files may be there
  resume,   // goes on; begins where there is nothing to go on from
  restart,  // begins, whatever is there
};

// How messages call the two.
struct BeginWords {
  std::string resume = "resume";
  std::string restart = "restart";
  std::string any_machine = "any_machine";  // of ensembles
};

struct RunOptions {
  RunBegin begin = RunBegin::anew;
  double checkpoint_seconds = 5.0;        // between two checkpoints, at least
  Progress progress = {};                 // in core units
  std::function<bool()> stop = {};        // asked after every step whether the run shall end
  std::unique_ptr<Sink> extra_sink = {};  // gets the rows of this part of the run too
  bool keep_events = false;               // all of them in the report; otherwise the first 20
  BeginWords words = {};
};

class ScenarioRun {
 public:
  // Opens every output. `scenario` must outlive it.
  ScenarioRun(const Scenario& scenario, RunFiles files, RunOptions options);
  ~ScenarioRun();
  ScenarioRun(const ScenarioRun&) = delete;
  ScenarioRun& operator=(const ScenarioRun&) = delete;

  // What it found: a run to continue, at t() with rows(); or all files complete, nothing to do.
  bool continues() const;
  bool is_complete() const;
  double t() const;
  std::int64_t rows() const;

  // Once.
  RunReport run();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace v0
}  // namespace polhode
