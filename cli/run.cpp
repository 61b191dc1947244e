// SPDX-License-Identifier: MIT
#include "polhode/run/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/run/summary.hpp"
#include "resumable_work.hpp"

namespace polhode::cli {
namespace {

// All files are complete.
struct NothingToDo {};

struct RunCommand : WorkOptions {
  std::string events;
};

// The input was right: whatever goes wrong from here on is a run that failed.
io::RunReport report_of(const io::Scenario& scenario, io::ScenarioRun& run) {
  try {
    return run.run();
  } catch (const DomainError& error) {
    throw std::runtime_error(scenario.document.name + ": the run failed: " + error.what());
  }
}

// One line: where it ended, why and what to try, and what is left of its rows.
std::string failure_text(const io::Scenario& scenario, const io::RunReport& report,
                         const std::vector<std::string>& out) {
  const double t = scenario.units().from_core(report.outcome.t, io::Dimension::time);
  std::string text = scenario.document.name + ": the run failed at t = " + fmt::format("{}", t) +
                     " " + scenario.units().time() + ": " + report.outcome.advice;
  std::string parts;
  for (const std::string& path : out)
    if (path != "-") parts += (parts.empty() ? "" : ", ") + path + ".part";
  return parts.empty() ? text
                       : text + "; rows so far: " + std::to_string(report.rows) + ", in " + parts;
}

// That the disk may be too small, where nobody can tell before: of text, or of a run that an event
// may end.
void warn_of_room(const io::Scenario& scenario, const std::vector<std::string>& out,
                  const io::ScenarioRun& run) {
  for (const io::DiskNeed& need : io::disk_needs(scenario, out, run.rows()))
    if (need.usual > need.available)
      say(scenario.document.name + ": the disk may not hold " +
          io::disk_text(scenario, need, need.usual, run.rows()));
}

io::RunReport run_into_files(const RunCommand& options, const io::Scenario& scenario,
                             const std::vector<std::string>& out, bool rows_on_terminal) {
  ResumableWork work(options, scenario.document.name);
  io::ScenarioRun run(scenario, {out, options.events}, work.run_options(!rows_on_terminal));
  if (run.is_complete()) throw NothingToDo();
  const auto time = [&](double t) { return scenario.units().from_core(t, io::Dimension::time); };
  work.announce(run,
                fmt::format("at t = {} {}, after {} rows", time(run.reached()),
                            scenario.units().time(), run.rows()),
                "checkpoint");
  warn_of_room(scenario, out, run);
  work.line().emplace(io::row_times(scenario)->end(), scenario.units().time());
  return work.run([&] { return report_of(scenario, run); });
}

// "PATH.csv, PATH.h5"
std::string output_paths(const io::OutputFormats& formats) {
  std::string paths;
  for (const io::OutputFormat& format : formats.all())
    paths += (paths.empty() ? "PATH" : ", PATH") + format.extension;
  return paths;
}

// Reports tables of the file that only other commands use.
void note_plans(const io::Scenario& scenario) {
  const auto note = [&](bool has_table, const char* table, const char* command) {
    if (has_table)
      say(scenario.document.name + ": note: " + table + " is not used; polhode " + command +
          " uses it");
  };
  note(scenario.map.has_value(), "[map]", "map");
  note(scenario.ensemble.has_value(), "[ensemble]", "ensemble");
  note(scenario.fit != nullptr, "[[observation]]", "fit");
}

void run_scenario(const RunCommand& options, const io::Kinds& kinds) {
  const io::Scenario scenario = changed_scenario(options.scenario, options.set, kinds);
  if (!io::row_times(scenario))
    throw DomainError(
        options.scenario +
        ": time: got nothing; expected a table [time], stop with step or count, or at");
  if (!options.events.empty() && !io::has_events(scenario))
    throw DomainError(options.scenario +
                      (std::holds_alternative<io::Rotation>(scenario.experiment)
                           ? ": event: got nothing; expected tables [[event]] for --events"
                           : ": expected no --events, since this kind of file has none"));
  std::vector<std::string> out = options.out;
  const bool table_only = out.empty() && options.events.empty() && isatty(STDOUT_FILENO) == 1;
  if (out.empty() && options.events.empty() && !table_only) out.push_back("-");
  std::vector<std::string> paths = out;
  if (!options.events.empty()) paths.push_back(options.events);
  require_different("run", paths);

  io::RunReport report;
  const bool to_standard_output = std::find(out.begin(), out.end(), "-") != out.end();
  const bool rows_on_terminal = to_standard_output && isatty(STDOUT_FILENO) == 1;
  if (!table_only) {
    try {
      report = run_into_files(options, scenario, out, rows_on_terminal);
    } catch (const NothingToDo&) {
      return print_nothing_to_do(scenario.document.name, paths);
    }
  }
  if (!report.outcome.ok()) throw std::runtime_error(failure_text(scenario, report, out));
  for (const std::string& warning : report.warnings) warn(warning);
  note_plans(scenario);
  if (to_standard_output) return;
  std::vector<io::SummaryLine> lines = io::summary(scenario);
  if (!table_only)
    for (io::SummaryLine& line : io::report_lines(
             scenario, report,
             options.events.empty() ? "--events PATH.csv" : "all in " + options.events))
      lines.push_back(std::move(line));
  if (const std::string hint = plot_hint(out); !hint.empty())
    lines.push_back({"plot", "to draw it", {}, hint, ""});
  print(io::summary_table(lines));
  if (table_only)
    print("(no rows written: --out " + output_paths(scenario.output.formats) +
          ", or - for standard output)\n");
}

}  // namespace

void add_run(CLI::App& app, const io::Kinds& kinds, const std::string& typed) {
  CLI::App* command = app.add_subcommand("run", "Propagate a scenario and write its rows");
  const auto options = std::make_shared<RunCommand>();
  options->program = typed;
  options->command = "run";
  add_scenario(*command, *options);
  command
      ->add_option(
          "--out,-o", options->out,
          io::paths_in_words(kinds.formats()) +
              ", any number of them; - is CSV to standard output, also the default unless that is "
              "a terminal")
      ->type_name("PATH");
  command
      ->add_option("--events", options->events,
                   "PATH.csv for the events of the scenario: name, t, direction, and the columns")
      ->type_name("PATH");
  add_begin(*command, *options, {"run", "a run", "rows"});
  command->footer(
      "\nCtrl-C stops a run after its step; --resume continues it.\n"
      "\nExample:\n  " +
      full_name(*command) + " examples/apophis.toml --out apophis.csv --out apophis.h5");
  command->callback([options, kinds] {
    if (!options->events.empty()) options->own_words = {"--events", options->events};
    run_scenario(*options, kinds);
  });
}

}  // namespace polhode::cli
