// SPDX-License-Identifier: MIT
// What the commands share that may be stopped and continued.
#pragma once

#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode::cli {

// --resume and --restart, of which at most one is given.
struct BeginOptions {
  bool resume = false;
  bool restart = false;

  RunBegin begin() const;
};
void add_begin_options(CLI::App& command, BeginOptions& options, const std::string& resume_help,
                       const std::string& restart_help);
// --checkpoint SECONDS, of which the number is the default.
void add_checkpoint_option(CLI::App& command, double& seconds_between);
BeginWords begin_words();

// What an option takes: a whole number from 1 on, or from 0 on.
CLI::Validator whole_number();
CLI::Validator member_index();

// DomainError when a command has one path twice.
void require_different(const std::string& command, const std::vector<std::string>& paths);

// The end of the line of one that was stopped: "; continue with: polhode map FILE --resume".
std::string how_to_continue(const std::string& program, const std::vector<std::string>& command,
                            bool can_resume);
// "NAME: nothing to do: complete in a.csv, a.h5"
void print_nothing_to_do(const std::string& name, const std::vector<std::string>& paths);

}  // namespace polhode::cli
