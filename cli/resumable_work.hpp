// SPDX-License-Identifier: MIT
// Shared by run, map, ensemble and fit: options, a line of progress, Ctrl-C and how to continue.
#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "polhode/run/scenario_run.hpp"
#include "progress.hpp"
#include "stop_signals.hpp"

namespace polhode::cli {

struct WorkOptions {
  std::string program;  // as it was typed
  std::string command;  // "map"
  std::string scenario;
  std::vector<std::string> set, out;
  int threads = 0;
  bool resume = false, restart = false;
  double checkpoint = 5.0;
  // Words of the options that only this command has, in front of --threads and behind it.
  std::vector<std::string> own_words = {}, own_flags = {};
};

// Options of work that several processes may share.
struct SharedWorkOptions : WorkOptions {
  bool any_machine = false;
  // They last until the last message is written: MPI_Finalize does not return once mpirun was told
  // to stop.
  std::unique_ptr<ensemble::Ranks> ranks;

  // Makes the ranks from the options that were typed.
  void begin(const MakeRanks& make);
};

// The words of help: "run", "a run", "rows".
struct WorkWords {
  std::string name, one, results;
};

// FILE and --set.
void add_scenario(CLI::App& command, WorkOptions& options);
// --out of tables.
void add_tables(CLI::App& command, WorkOptions& options, const io::Kinds& kinds);
// --threads.
void add_threads(CLI::App& command, WorkOptions& options, const std::string& at_a_time);
// --resume, --restart and --checkpoint.
void add_begin(CLI::App& command, WorkOptions& options, const WorkWords& words);
// --any-machine.
void add_any_machine(CLI::App& command, SharedWorkOptions& options);

// True for a process that does not lead: it has computed cells for the one that does, by the work
// that `make` returns. DomainError for a scenario that not all of several processes can read.
bool has_served(SharedWorkOptions& options, const ensemble::Ranks::MakeWork& make);

// Options that say whether to resume or restart, and the time between checkpoints.
io::RunOptions begin_options(const WorkOptions& options);

// The index of a "member".
CLI::Validator index_of(const std::string& what);

// DomainError when a command has one path twice.
void require_different(const std::string& command, const std::vector<std::string>& paths);

// "NAME: nothing to do: complete in a.csv, a.h5"
void print_nothing_to_do(const std::string& name, const std::vector<std::string>& paths);
// Writes a line to standard error.
void say(const std::string& line);

// Work of a command on a scenario called `name`, from its options to its end.
class ResumableWork {
 public:
  ResumableWork(const WorkOptions& options, std::string name)
      : options_(options), name_(std::move(name)) {}

  // Notes Ctrl-C from here on until run() has ended. `shows`: progress goes to the line.
  io::RunOptions run_options(bool shows = true);
  // Prints what --resume has found: it continues "after 7 of 143 cells", or has no "cells".
  void announce(const io::ResumableRun& run, const std::string& where,
                const std::string& results) const;
  // "after 7 of 143 cells"
  static std::string after(double reached, std::int64_t size, const std::string& results);
  std::optional<ProgressLine>& line() { return line_; }

  // f(); if it is stopped, the message says how to continue.
  template <class F>
  auto run(const F& f) {
    try {
      auto result = f();
      end();
      return result;
    } catch (const io::RunInterrupted& stopped) {
      throw interrupted(stopped, stopped.can_resume,
                        "outputs that are not files cannot be continued");
    }
  }
  // The same for work that ends by another exception.
  Interrupted interrupted(const std::exception& stopped, bool can_resume,
                          const std::string& advice);
  void end();

 private:
  const WorkOptions& options_;
  std::string name_;
  std::optional<StopSignals> signals_;
  std::optional<ProgressLine> line_;
};

}  // namespace polhode::cli
