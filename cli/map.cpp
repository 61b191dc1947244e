// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/run/map_run.hpp"
#include "polhode/run/run.hpp"
#include "progress.hpp"
#include "resume.hpp"
#include "stop_signals.hpp"

namespace polhode::cli {
namespace {

constexpr std::size_t reasons_shown = 3;

struct MapOfFile {
  std::string program;  // as it was typed
  std::string scenario;
  std::vector<std::string> set;
  std::vector<std::string> out;
  int threads = 0;
  BeginOptions begin;
  double checkpoint = 5.0;
};

// How many cells there are, what they hold, and why some hold nothing.
std::string summary_of(const ScenarioMap& map, const MapReport& report) {
  std::string text = fmt::format("cells             {}\n", report.cells);
  const std::vector<Column> columns = map.groups().back().columns;
  if (map.plan().kind == MapKind::andoyer_section || map.plan().kind == MapKind::spin_orbit_section)
    text += fmt::format("points            {}\n", report.points);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto [least, most] = report.ranges[i];
    if (least <= most)
      text += fmt::format("{:<17} {:.10g} to {:.10g} {}\n", columns[i].name, least, most,
                          columns[i].unit == "1" ? "" : columns[i].unit);
  }
  const std::size_t failed = report.failures.size();
  if (failed == 0) return text;
  text += fmt::format("failed            {}, which hold nan:\n", failed);
  for (std::size_t i = 0; i < std::min(failed, reasons_shown); ++i)
    text += "  " + report.failures[i].why + "\n";
  return failed <= reasons_shown ? text : text + "  ...\n";
}

// What --resume has found, on standard error.
void announce(const ScenarioMap& map, const MapRun& run) {
  const std::string text =
      run.continues() ? fmt::format(": continues after {} of {} cells", run.cells(), map.size())
                      : ": no cells to continue from, starts anew";
  std::fputs((map.scenario().document.name + text + "\n").c_str(), stderr);
}

std::vector<std::string> command_of(const MapOfFile& options) {
  std::vector<std::string> words = {"map", options.scenario};
  for (const std::string& change : options.set) words.insert(words.end(), {"--set", change});
  for (const std::string& path : options.out) words.insert(words.end(), {"--out", path});
  if (options.threads > 0)
    words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  return words;
}

void make_map(const MapOfFile& options, const Kinds& kinds) {
  const ScenarioMap map(changed_scenario(options.scenario, options.set, kinds));
  std::vector<std::string> out = options.out;
  if (out.empty()) out.push_back("-");
  require_different("map", out);
  const bool to_standard_output = std::find(out.begin(), out.end(), "-") != out.end();
  const bool rows_on_terminal = to_standard_output && isatty(STDOUT_FILENO) == 1;
  const StopSignals signals;
  std::optional<ProgressLine> progress;
  MapOptions how;
  how.begin = options.begin.begin();
  how.words = begin_words();
  how.checkpoint_seconds = options.checkpoint;
  how.threads = options.threads;
  how.stop = [] { return StopSignals::came() != 0; };
  if (!rows_on_terminal)
    how.progress = [&progress](std::int64_t cells) { (*progress)(static_cast<double>(cells)); };
  MapRun run(map, out, std::move(how));
  if (run.is_complete()) return print_nothing_to_do(map.scenario().document.name, out);
  if (options.begin.resume) announce(map, run);
  progress.emplace(0.0, static_cast<double>(map.size()), "cells", static_cast<double>(run.cells()));
  MapReport report;
  try {
    report = run.run();
  } catch (const MapInterrupted& stopped) {
    progress.reset();
    throw Interrupted(
        StopSignals::came(),
        stopped.what() + how_to_continue(options.program, command_of(options), stopped.can_resume));
  }
  progress.reset();
  if (!to_standard_output) print(summary_of(map, report));
}

}  // namespace

void add_map(CLI::App& app, const Kinds& kinds, const std::string& typed) {
  CLI::App* command = app.add_subcommand(
      "map",
      "Run a scenario over the grid of its [map], on all processors: chaos, extremes, sections");
  const auto options = std::make_shared<MapOfFile>();
  options->program = typed;
  command->add_option("FILE", options->scenario, "Scenario (.toml); - is standard input")
      ->required();
  add_set_option(*command, options->set);
  command
      ->add_option("--out,-o", options->out,
                   paths_in_words(kinds.formats(),
                                  [](const OutputFormat& format) { return !format.needs.dates; }) +
                       ", any number of them; - is CSV to standard output, also the default")
      ->type_name("PATH");
  command
      ->add_option("--threads", options->threads,
                   "How many cells at a time; left out: one on each processor. The result does "
                   "not depend on it")
      ->check(whole_number());
  add_begin_options(*command, options->begin,
                    "Continue a map that was stopped, from its FIRST_OUTPUT.checkpoint",
                    "Begin anew where an unfinished map is, and lose its cells");
  command
      ->add_option("--checkpoint", options->checkpoint,
                   "Time between two checkpoints in FIRST_OUTPUT.checkpoint, at least")
      ->type_name("SECONDS")
      ->check(seconds())
      ->capture_default_str();
  command->footer(
      "\nCtrl-C stops a map and keeps its cells; --resume continues it.\n"
      "\nExample:\n  " +
      full_name(*command) + " examples/hyperion-map.toml --out hyperion.csv --threads 2");
  command->callback([options, kinds] { make_map(*options, kinds); });
}

}  // namespace polhode::cli
