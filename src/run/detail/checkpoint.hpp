// SPDX-License-Identifier: MIT
// Checkpoints of runs, maps, ensembles and fits: what one must agree in with the run that resumes
// from it, when to make one, the files that an earlier run has left, and the outputs that are
// written with it.
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
#include "polhode/output/output_format.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/trajectory/state_bytes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A property in which a checkpoint must agree with the run or map that resumes from it.
struct IdentityPart {
  std::string name;  // as messages call it: "columns"
  std::string text;
};
using Identity = std::vector<IdentityPart>;
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
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Pace(double seconds) : seconds_(std::max(seconds, 0.0)) { wait(0.0); }
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

// A path as messages name it.
std::string shown_path(const std::string& path);
// PATH.checkpoint
std::string checkpoint_path(const std::string& output);
// The checkpoint of the unfinished run that an output belongs to: next to it, or next to the first
// output of that run. Empty: there is none. DomainError when there should be one.
std::string checkpoint_among(std::span<const std::string> outputs, const BeginWords& words);
// Leaves next to an output where the checkpoint of its run is.
void point_to_checkpoint(const std::string& output, const std::string& checkpoint);
// Also removes what a kill can leave beside them: PATH.checkpoint.part and PATH.part-undo.
void forget_checkpoints(std::span<const std::string> outputs);
// A renamed file is on the disk when its folder is.
void sync_folder_of(const std::string& path);

// "FILE: an unfinished run is there (TOLD); resume continues it, ..."
[[noreturn]] void refuse_unfinished(const std::string& file, const std::string& kind,
                                    const std::string& progress, const BeginWords& words);

// Where an output is to be, and its columns.
struct PlannedOutput {
  std::string path;
  std::vector<ColumnGroup> groups;
};
// Whether all outputs are there, with none on its way. DomainError for one of another scenario, of
// other files that the scenario names or with other columns, and for one that does not say.
bool are_complete(std::span<const PlannedOutput> outputs, const OutputFormats& formats,
                  const Provenance& provenance, const BeginWords& words);

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
struct KeptKind {
  std::string name;   // "run"
  std::string again;  // what a restart does: "runs the scenario anew"
};

struct KeptSetup {
  KeptKind kind;
  Identity identity;
  std::vector<PlannedOutput> outputs;  // the checkpoint stands next to the first
  OutputFormats formats;               // that there are
  RunBegin begin = RunBegin::anew;
  BeginWords words = {};
  double seconds = 5.0;  // between two checkpoints, at least
  // True if complete outputs can be recognised, so that there is nothing to do.
  bool can_be_complete = true;
  // Makes of the identity of a checkpoint what may differ from ours.
  std::function<void(Identity& theirs, const Identity& ours)> forgive = {};
  // What a message adds that says how they differ.
  std::function<std::string(const std::string& difference)> advice = {};
};

// What a checkpoint asks of an output that is open; see Sink.
struct KeptOutput {
  std::function<std::optional<SinkPosition>()> position;
  std::function<void()> kept;
};
KeptOutput kept_output(Sink& sink);

// A state of the run or map, between two steps or cells.
struct KeptState {
  std::string bytes;
  std::string reached;  // "7 of 143 cells": where an unfinished one is
  std::string goes_on;  // "after 7 of 143 cells", behind "--resume goes on "
};

struct CheckpointFile;

// The outputs of a run or a map that may be stopped, killed and continued: the files that earlier
// ones have left next to them, how far each has been written, and the checkpoint
// FIRST_OUTPUT.checkpoint, which is replaced as a whole.
class KeptOutputs {
 public:
  // Finds what is there. DomainError for what must not be lost or is of another run.
  KeptOutputs(KeptSetup setup, const Provenance& provenance);

  bool continues() const { return continues_; }
  // All outputs are there: nothing to do.
  bool is_complete() const { return complete_; }
  // The bytes of the state to go on from.
  const std::string& state() const { return state_.bytes; }

  // Calls the function for each path in order, with where the output goes on, and forgets what was
  // there before where all of it begins anew.
  using Open =
      std::function<KeptOutput(const std::string& path, const std::optional<SinkPosition>& from)>;
  void open(const Open& open);

  // Whether there are checkpoints, and whether the next one is due.
  bool keeps() const { return keeps_; }
  bool is_due() { return keeps_ && pace_.due(); }
  void keep(KeptState state);
  // The checkpoint goes: nothing will go on from it.
  void forget();

  // A disk that was full says what to do then.
  template <class F>
  void with_remedy(const F& f) const {
    detail::with_remedy(f, [&] { return remedy(); });
  }

 private:
  void find(const Provenance& provenance);
  void take_up(const std::string& found, std::optional<CheckpointFile> file);
  bool are_files() const;
  std::string remedy() const;

  KeptSetup setup_;
  std::vector<std::string> paths_;  // of the outputs
  Pace pace_;
  KeptState state_;  // of the latest checkpoint
  std::vector<SinkPosition> positions_;
  std::vector<KeptOutput> outputs_;
  bool continues_ = false;
  bool complete_ = false;
  bool keeps_ = false;
  bool is_safe_ = false;  // there is a checkpoint
  bool pointed_ = false;  // each output says where the checkpoint is
};

// Of tables with the same columns each, those of a map or an ensemble. How they begin, and the
// seconds between checkpoints, are for the caller to set.
KeptSetup setup_of_tables(KeptKind kind, const Scenario& scenario,
                          const std::vector<ColumnGroup>& groups,
                          const std::vector<std::string>& paths);

// Sinks of all of them, in the order of the paths.
std::vector<std::unique_ptr<Sink>> opened_tables(KeptOutputs& outputs, const Scenario& scenario,
                                                 const std::vector<ColumnGroup>& groups,
                                                 const Provenance& origin);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
