// SPDX-License-Identifier: MIT
#include "polhode/io/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/io/summary.hpp"
#include "progress.hpp"

namespace polhode::cli {
namespace {

struct RunOptions {
  std::string scenario;
  std::vector<std::string> out;
  std::string events;
};

void require_different(std::vector<std::string> paths) {
  for (auto path = paths.begin(); path != paths.end(); ++path)
    if (std::find(paths.begin(), path, *path) != path)
      throw DomainError("run: " + *path + " is there twice");
}

// The input was right: whatever goes wrong from here on is a run that failed.
RunReport report_of(const Scenario& scenario, const RowLayout& layout,
                    std::span<const std::unique_ptr<Sink>> sinks, bool rows_on_terminal) {
  const SaveAt& rows = *scenario.time;
  ProgressLine progress(0.0, rows[rows.size() - 1], scenario.units.time());
  try {
    return run(scenario, layout, sinks,
               rows_on_terminal ? Progress() : Progress(std::ref(progress)));
  } catch (const DomainError& error) {
    throw std::runtime_error(scenario.name + ": the run failed: " + error.what());
  }
}

// One line: where it ended, why and what to try, and what is left of its rows.
std::string failure_text(const Scenario& scenario, const RunReport& report,
                         const std::vector<std::string>& out) {
  const double t = scenario.units.from_core(report.outcome.t, Dimension::time);
  std::string text = scenario.name + ": the run failed at t = " + fmt::format("{}", t) + " " +
                     scenario.units.time() + ": " + report.outcome.advice;
  std::string parts;
  for (const std::string& path : out)
    if (path != "-") parts += (parts.empty() ? "" : ", ") + path + ".part";
  return parts.empty() ? text
                       : text + "; rows so far: " + std::to_string(report.rows) + ", in " + parts;
}

void run_scenario(const RunOptions& options) {
  const Scenario scenario = read_scenario(options.scenario);
  if (!scenario.time)
    throw DomainError(
        options.scenario +
        ": time: got nothing; expected a table [time], stop with step or count, or at");
  if (!options.events.empty() && scenario.events.empty())
    throw DomainError(options.scenario +
                      ": event: got nothing; expected tables [[event]] for --events");
  std::vector<std::string> out = options.out;
  const bool table_only = out.empty() && options.events.empty() && isatty(STDOUT_FILENO) == 1;
  if (out.empty() && options.events.empty() && !table_only) out.push_back("-");
  std::vector<std::string> paths = out;
  if (!options.events.empty()) paths.push_back(options.events);
  require_different(paths);

  const RowLayout layout = row_layout(scenario);
  std::vector<std::unique_ptr<Sink>> sinks;
  for (const std::string& path : out)
    sinks.push_back(open_sink(path, layout.groups(), provenance(scenario)));
  std::optional<EventTable> events;
  if (!options.events.empty()) events.emplace(options.events, scenario);
  RunReport report;
  const bool to_standard_output = std::find(out.begin(), out.end(), "-") != out.end();
  const bool rows_on_terminal = to_standard_output && isatty(STDOUT_FILENO) == 1;
  if (!table_only) report = report_of(scenario, layout, sinks, rows_on_terminal);
  if (events) events->write(report);
  if (!report.outcome.ok()) throw std::runtime_error(failure_text(scenario, report, out));
  if (to_standard_output) return;
  std::vector<SummaryLine> lines = summary(scenario, free_rotation(scenario));
  if (!table_only)
    for (SummaryLine& line : report_lines(scenario, report)) lines.push_back(std::move(line));
  print(summary_table(lines));
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
  command
      ->add_option("--events", options->events,
                   "PATH.csv for the events of the scenario: name, t, direction, and the columns")
      ->type_name("PATH");
  command->footer(
      "\nExample:\n  polhode run examples/apophis.toml --out apophis.csv --out apophis.h5");
  command->callback([options] { run_scenario(*options); });
}

}  // namespace polhode::cli
