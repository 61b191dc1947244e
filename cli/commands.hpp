// SPDX-License-Identifier: MIT
// The subcommands of `polhode`: each adds itself to the command line, one source per subcommand.
#pragma once

#include <CLI/CLI.hpp>
#include <string_view>

namespace polhode::cli {

void add_run(CLI::App& app);
void add_info(CLI::App& app);
void add_convert(CLI::App& app);
void add_init(CLI::App& app);
void add_cite(CLI::App& app);
void add_golden(CLI::App& app);
void add_schema(CLI::App& app);

// Writes to standard output; OutputError when it cannot.
void print(std::string_view text);

// The whole program: exit status 0, 2 for bad input, 1 for a run that failed. Never throws.
int command_line(int argc, const char* const* argv);

}  // namespace polhode::cli
