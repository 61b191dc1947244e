// SPDX-License-Identifier: MIT
// What the commands share that run a scenario many times: map and ensemble.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands.hpp"
#include "resume.hpp"
#include "stop_signals.hpp"

namespace polhode::cli {

struct ManyRuns {
  std::string program;  // as it was typed
  std::string scenario;
  std::vector<std::string> set;
  std::vector<std::string> out;
  int threads = 0;
  BeginOptions begin;
  double checkpoint = 5.0;
};

// How help calls them: "a map", "map", "cells"; and what a thread takes at a time.
struct ManyRunsWords {
  std::string one;
  std::string name;
  std::string members;
  std::string at_a_time;
};

// FILE, --set and --out.
void add_files(CLI::App& command, ManyRuns& options, const Kinds& kinds);
// --threads, --resume, --restart and --checkpoint.
void add_work(CLI::App& command, ManyRuns& options, const ManyRunsWords& words);

// The same command, to continue with.
std::vector<std::string> command_of(const std::string& name, const ManyRuns& options);

// What --resume has found, on standard error: how many of the cells or members are done.
void announce(const std::string& scenario, bool continues, std::int64_t done, std::int64_t size,
              const std::string& members);

// What MapOptions and EnsembleOptions have of these.
template <class Options>
Options work_of(const ManyRuns& options) {
  Options how;
  how.begin = options.begin.begin();
  how.words = begin_words();
  how.checkpoint_seconds = options.checkpoint;
  how.threads = options.threads;
  how.stop = [] { return StopSignals::came() != 0; };
  return how;
}

}  // namespace polhode::cli
