// SPDX-License-Identifier: MIT
// The subcommands of `polhode`: each adds itself to the command line, one source per subcommand.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/cli/command_line.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode::cli {

// Those that read scenarios know the kinds of things that these may hold.
// Those that can be stopped say how to continue: by the program as it was typed.
void add_run(CLI::App& app, const io::Kinds& kinds, const std::string& typed);
void add_info(CLI::App& app, const io::Kinds& kinds, bool has_ranks);
void add_convert(CLI::App& app, const io::Kinds& kinds);
void add_init(CLI::App& app, const io::Kinds& kinds);
void add_cite(CLI::App& app, const io::Kinds& kinds);
void add_completion(CLI::App& app);
void add_golden(CLI::App& app);
void add_map(CLI::App& app, const io::Kinds& kinds, const std::string& typed,
             const MakeRanks& ranks);
void add_ensemble(CLI::App& app, const io::Kinds& kinds, const std::string& typed,
                  const MakeRanks& ranks);
void add_fit(CLI::App& app, const io::Kinds& kinds, const std::string& typed);
void add_simulate(CLI::App& app, const io::Kinds& kinds);
void add_nutation(CLI::App& app);
void add_plot(CLI::App& app);
void add_schema(CLI::App& app, const io::Kinds& kinds);
void add_shape(CLI::App& app);
void add_spectrum(CLI::App& app);

// A word as a shell reads it.
std::string quoted(const std::string& word);

// The command that draws the first of these that can be drawn; empty if none can.
std::string plot_hint(const std::vector<std::string>& outputs);

// "polhode run": the name of the program, and that of its subcommand.
std::string full_name(const CLI::App& command);

// The words that completion offers for an option whose command checks them by itself.
void offer(CLI::Option& option, const std::vector<std::string>& words);
// --set KEY=VALUE, any number of them: changes of a scenario before it is read.
void add_set_option(CLI::App& command, std::vector<std::string>& changes);
io::Scenario changed_scenario(const std::string& path, const std::vector<std::string>& changes,
                              const io::Kinds& kinds);

// Writes to standard output; OutputError when it cannot.
void print(std::string_view text);
// Writes "warning: TEXT" to standard error.
void warn(const std::string& text);

// Ctrl-C or SIGTERM came, and the command has ended in order: exit status 128 + signal.
struct Interrupted : std::runtime_error {
  Interrupted(int by, const std::string& what) : std::runtime_error(what), signal(by) {}
  int signal;
};

}  // namespace polhode::cli
