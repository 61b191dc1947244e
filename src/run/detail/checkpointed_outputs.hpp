// SPDX-License-Identifier: MIT
// Outputs that are written with checkpoints, of runs, maps, ensembles and fits: what a checkpoint
// must agree in with the run that resumes from it, when to make one, and the files that an earlier
// run has left.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/part_file.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// A property in which a checkpoint must agree with the run or map that resumes from it.
struct IdentityPart {
  std::string name;  // as messages call it: "columns"
  std::string text;
};
using Identity = std::vector<IdentityPart>;
inline void serialize_identity(Archive& bytes, Identity& identity) {
  bytes.list(identity, [&](IdentityPart& part) { bytes.all(part.name, part.text); });
}
// The part of what acts on the body, in numbers that this machine has computed.
inline constexpr char surroundings_part[] = "orbits and torques";

// What is written: the names of files without their folders, and those of columns.
struct IdentityOutputs {
  std::vector<std::string> paths;
  std::string events = {};  // empty: none
  std::vector<std::string> columns;
};
// The version, the columns, the text and the files of the scenario, its method, what acts on the
// body at some times of the run, and each output. The scenario has [time].
Identity identity_of(const Scenario& scenario, const IdentityOutputs& outputs);
// "columns was "q g", is "q"": how the first part that differs does. Empty: none.
std::string difference(const Identity& theirs, const Identity& ours);

// Decides when to make a checkpoint: looks at the clock after every 1 to 64 steps, and leaves most
// of the time to the run.
class CheckpointTimer {
 public:
  using Clock = std::chrono::steady_clock;

  explicit CheckpointTimer(double seconds) : seconds_(std::max(seconds, 0.0)) { wait(0.0); }
  bool due() {
    if (--calls_left_ > 0) return false;
    const Clock::time_point now = Clock::now();
    if (now - looked_ < std::chrono::microseconds(200)) stride_ = std::min(2 * stride_, 64);
    if (now - looked_ > std::chrono::microseconds(2000)) stride_ = 1;
    calls_left_ = stride_;
    looked_ = now;
    return now >= next_;
  }
  void made(Clock::time_point begun) {
    wait(std::chrono::duration<double>(Clock::now() - begun).count() / share);
  }

 private:
  static constexpr double share = 0.05;  // of the time that checkpoints may take

  void wait(double least) {
    const std::chrono::duration<double> pause(std::min(std::max(seconds_, least), 1e9));
    next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
  }

  double seconds_;
  int stride_ = 1;
  int calls_left_ = 1;
  Clock::time_point looked_ = Clock::now();
  Clock::time_point next_;
};

// Where an output is to be, and its columns.
struct PlannedOutput {
  std::string path;
  std::vector<ColumnGroup> groups;
};

// A disk that was full says what to do: make space, and what `next` says. Empty: nothing helps.
template <class F, class Next>
void with_remedy(const F& f, const Next& next) {
  try {
    f();
  } catch (const NoSpace& full) {
    const std::string then = next();
    if (then.empty()) throw;
    throw OutputError(std::string(full.what()) + "; " + full.remedy + ", then " + then);
  }
}

// The words of messages for a run, a map, an ensemble or a fit.
struct CheckpointKind {
  std::string name;   // "run"
  std::string again;  // what a restart does: "runs the scenario anew"
};

struct CheckpointSetup {
  CheckpointKind kind;
  Identity identity;
  std::vector<PlannedOutput> outputs;  // the checkpoint stands next to the first
  OutputFormats formats;               // that there are
  // True if complete outputs can be recognised, so that there is nothing to do.
  bool can_be_complete = true;
  // Makes of the identity of a checkpoint what may differ from ours.
  std::function<void(Identity& theirs, const Identity& ours)> forgive = {};
  // What a message adds that says how they differ.
  std::function<std::string(const std::string& difference)> advice = {};
};
// The setup of tables with the same columns, those of a map or an ensemble.
CheckpointSetup setup_of_tables(CheckpointKind kind, const Scenario& scenario,
                                const std::vector<ColumnGroup>& groups,
                                const std::vector<std::string>& paths);

// What a checkpoint asks of an output that is open; see Sink.
struct CheckpointedOutput {
  std::function<std::optional<SinkPosition>()> position;
  std::function<void()> kept;
};
CheckpointedOutput checkpointed_output(Sink& sink);

// The place of a run or map between two steps or cells, in words.
struct CheckpointPlace {
  std::string reached;  // "7 of 143 cells": what is said of an unfinished one
  std::string stopped;  // "after 7 of 143 cells", behind "stopped "
  std::string goes_on;  // the same behind "--resume goes on "
};

struct CheckpointHead;

// The outputs of a run or a map that may be stopped, killed and resumed: the files that earlier
// ones have left next to them, how far each has been written, and the checkpoint
// FIRST_OUTPUT.checkpoint, which is replaced as a whole: a line for people and one archive.
class CheckpointedOutputs {
 public:
  // Finds what is there. DomainError for what must not be lost or is of another run. `options` must
  // outlive it.
  CheckpointedOutputs(CheckpointSetup setup, const RunOptions& options,
                      const Provenance& provenance);
  CheckpointedOutputs(const CheckpointedOutputs&) = delete;
  CheckpointedOutputs& operator=(const CheckpointedOutputs&) = delete;

  bool continues() const { return continues_; }
  // All outputs are there: nothing to do.
  bool is_complete() const { return complete_; }
  // Reads the state to resume from.
  Archive& state() { return state_; }

  // Calls the function for each path in order, with where the output goes on, and forgets what was
  // there before where all of it begins anew.
  using Open = std::function<CheckpointedOutput(const std::string& path,
                                                const std::optional<SinkPosition>& from)>;
  void open(const Open& open);

  // Whether there are checkpoints, and whether the next one is due.
  bool keeps() const { return keeps_; }
  bool is_due() { return keeps_ && timer_.due(); }
  // `serialize` writes the state.
  void keep(CheckpointPlace place, const std::function<void(Archive&)>& serialize);
  // The checkpoint goes: nothing will go on from it.
  void forget();

  // A disk that was full says what to do then.
  template <class F>
  void with_remedy(const F& f) const {
    detail::with_remedy(f, [&] { return remedy(); });
  }

 private:
  void find(const Provenance& provenance);
  void take_up(const std::string& found, CheckpointHead* head);
  bool are_files() const;
  std::string remedy() const;

  CheckpointSetup setup_;
  const RunOptions& options_;
  std::vector<std::string> paths_;  // of the outputs
  CheckpointTimer timer_;
  std::string found_;    // the text of a checkpoint
  Archive state_;        // reads the state from it
  std::string goes_on_;  // of the latest checkpoint
  std::vector<SinkPosition> positions_;
  std::vector<CheckpointedOutput> outputs_;
  bool continues_ = false;
  bool complete_ = false;
  bool keeps_ = false;
  bool is_safe_ = false;  // there is a checkpoint
  bool pointed_ = false;  // each output says where the checkpoint is
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
