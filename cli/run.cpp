// SPDX-License-Identifier: MIT
#include "polhode/io/run.hpp"

#include <unistd.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/io/summary.hpp"

namespace polhode::cli {
namespace {

struct RunOptions {
  std::string scenario;
  std::vector<std::string> out;
};

void run_scenario(const RunOptions& options) {
  const Scenario scenario = read_scenario(options.scenario);
  if (!scenario.time)
    throw DomainError(
        options.scenario +
        ": time: got nothing; expected a table [time], stop with step or count, or at");
  std::vector<std::string> out = options.out;
  const bool table_only = out.empty() && isatty(STDOUT_FILENO) == 1;
  if (out.empty() && !table_only) out.push_back("-");
  for (auto path = out.begin(); path != out.end(); ++path)
    if (std::find(out.begin(), path, *path) != path)
      throw DomainError("run: --out " + *path + " is there twice");

  const RowLayout layout(scenario.columns, scenario.units);
  std::vector<std::unique_ptr<Sink>> sinks;
  for (const std::string& path : out)
    sinks.push_back(open_sink(path, layout.groups(), provenance(scenario)));
  if (!sinks.empty()) run(scenario, layout, sinks);
  if (std::find(out.begin(), out.end(), "-") != out.end()) return;
  print(summary_table(summary(scenario, free_rotation(scenario))));
  if (table_only) print("(no rows written: --out PATH.csv, PATH.h5, or - for standard output)\n");
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Propagate a scenario and write its rows");
  const auto options = std::make_shared<RunOptions>();
  command->add_option("FILE", options->scenario, "Scenario (.toml); - is standard input")
      ->required();
  command
      ->add_option("--out,-o", options->out,
                   "PATH.csv or PATH.h5, any number of them; - is CSV to standard output, also the "
                   "default unless that is a terminal")
      ->type_name("PATH");
  command->footer(
      "\nExample:\n  polhode run examples/apophis.toml --out apophis.csv --out apophis.h5");
  command->callback([options] { run_scenario(*options); });
}

}  // namespace polhode::cli
