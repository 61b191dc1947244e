// SPDX-License-Identifier: MIT
// The outputs of a run or a map that may be stopped, killed and continued: what earlier ones have
// left next to them, how far each has been written, and the checkpoint FIRST_OUTPUT.checkpoint,
// which is replaced as a whole.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "polhode/output/output_format.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"
#include "run/detail/earlier_run.hpp"
#include "run/detail/identity.hpp"
#include "run/detail/pace.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// How messages call what is kept.
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
