// SPDX-License-Identifier: MIT
// The subcommands of `polhode`: each adds itself to the command line, one source per subcommand.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace polhode::cli {

void add_run(CLI::App& app);
void add_info(CLI::App& app);
void add_convert(CLI::App& app);
void add_init(CLI::App& app);
void add_cite(CLI::App& app);
void add_golden(CLI::App& app);
void add_map(CLI::App& app);
void add_schema(CLI::App& app);
void add_shape(CLI::App& app);

// Writes to standard output; OutputError when it cannot.
void print(std::string_view text);

// Ctrl-C or SIGTERM came, and the command has ended in order: exit status 128 + signal.
struct Interrupted : std::runtime_error {
  Interrupted(int by, const std::string& what) : std::runtime_error(what), signal(by) {}
  int signal;
};

// The whole program: exit status 0, 2 for bad input, 1 for a run that failed, 128 + signal for one
// that was stopped. Never throws.
int command_line(int argc, const char* const* argv);

}  // namespace polhode::cli
