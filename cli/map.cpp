// SPDX-License-Identifier: MIT
#include "polhode/run/map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/ensemble/cells.hpp"
#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "progress.hpp"
#include "resume.hpp"
#include "stop_signals.hpp"

namespace polhode::cli {
namespace {

constexpr std::size_t reasons_shown = 3;

struct MapOptions {
  std::string scenario;
  std::vector<std::string> out;
  int threads = 0;
  BeginOptions begin;
};

std::size_t points_of(const std::vector<MapCell>& cells, std::size_t width) {
  std::size_t points = 0;
  for (const MapCell& cell : cells)
    if (cell.failure.empty()) points += cell.numbers.size() / width;
  return points;
}

// How many cells there are, what they hold, and why some hold nothing.
std::string summary_of(const ScenarioMap& map, const std::vector<MapCell>& cells) {
  std::string text = fmt::format("cells             {}\n", cells.size());
  const std::vector<Column> columns = map.groups().back().columns;
  if (map.plan().kind == MapKind::andoyer_section || map.plan().kind == MapKind::spin_orbit_section)
    text += fmt::format("points            {}\n", points_of(cells, columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const MapCell& cell : cells) {
      if (!cell.failure.empty()) continue;
      for (std::size_t k = i; k < cell.numbers.size(); k += columns.size()) {
        least = std::min(least, cell.numbers[k]);
        most = std::max(most, cell.numbers[k]);
      }
    }
    if (least <= most)
      text += fmt::format("{:<17} {:.10g} to {:.10g} {}\n", columns[i].name, least, most,
                          columns[i].unit == "1" ? "" : columns[i].unit);
  }
  std::size_t failed = 0;
  std::string reasons;
  for (const MapCell& cell : cells) {
    if (cell.failure.empty()) continue;
    if (++failed <= reasons_shown) reasons += "  " + cell.failure + "\n";
  }
  if (failed == 0) return text;
  text += fmt::format("failed            {}, which hold nan:\n", failed) + reasons;
  return failed <= reasons_shown ? text : text + "  ...\n";
}

// A signal came, and the cells that were complete are kept.
struct Stopped {};

void look_at_signals() {
  if (StopSignals::came() != 0) throw Stopped();
}

void compute_cells(const MapOptions& options, const ScenarioMap& map, MapRows& rows) {
  ProgressLine progress(0.0, static_cast<double>(map.size()), "cells",
                        static_cast<double>(rows.size()));
  const int threads = options.threads > 0 ? options.threads : hardware_threads();
  run_cells(
      rows.size(), map.size(), threads,
      [&](std::int64_t index) -> MapCell {
        return map.cell(index, [](double) { look_at_signals(); });
      },
      [&](std::int64_t index, const MapCell& cell) {
        rows.push(cell);
        progress(static_cast<double>(index + 1));
        if (index + 1 < map.size()) look_at_signals();
      });
}

std::string done_of(const ScenarioMap& map, const MapRows& rows) {
  return fmt::format("{} of {} cells", rows.size(), map.size());
}

// What --resume has found, on standard error.
void announce(const ScenarioMap& map, const MapRows& rows) {
  const std::string text = rows.size() > 0 ? ": continues after " + done_of(map, rows)
                                           : ": no cells to continue from, starts anew";
  std::fputs((map.scenario().document.name + text + "\n").c_str(), stderr);
}

std::vector<std::string> command_of(const MapOptions& options) {
  std::vector<std::string> words = {"map", options.scenario};
  for (const std::string& path : options.out) words.insert(words.end(), {"--out", path});
  if (options.threads > 0)
    words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  return words;
}

void make_map(const MapOptions& options) {
  const Scenario scenario = read_scenario(options.scenario);
  const ScenarioMap map(scenario.document.text,
                        options.scenario == "-" ? "<stdin>" : options.scenario);
  std::vector<std::string> out = options.out;
  if (out.empty()) out.push_back("-");
  for (auto path = out.begin(); path != out.end(); ++path)
    if (std::find(out.begin(), path, *path) != path)
      throw DomainError("map: " + *path + " is there twice");
  if (options.begin.resume && is_complete(map, out, begin_words()))
    return print_nothing_to_do(scenario.document.name, out);
  const StopSignals signals;
  MapRows rows(map, out, options.begin.begin(), begin_words());
  if (options.begin.resume) announce(map, rows);
  try {
    compute_cells(options, map, rows);
  } catch (const Stopped&) {
    throw Interrupted(StopSignals::came(),
                      scenario.document.name + ": stopped after " + done_of(map, rows) +
                          how_to_continue(command_of(options), rows.are_kept()));
  }
  rows.finish();
  if (std::find(out.begin(), out.end(), "-") == out.end()) print(summary_of(map, rows.cells()));
}

}  // namespace

void add_map(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "map",
      "Run a scenario over the grid of its [map], on all processors: chaos, extremes, sections");
  const auto options = std::make_shared<MapOptions>();
  command->add_option("FILE", options->scenario, "Scenario (.toml); - is standard input")
      ->required();
  command
      ->add_option("--out,-o", options->out,
                   "PATH.csv or PATH.h5, any number of them; - is CSV to standard output, also the "
                   "default")
      ->type_name("PATH");
  command
      ->add_option("--threads", options->threads,
                   "How many cells at a time; left out: one on each processor. The result does "
                   "not depend on it")
      ->check(CLI::PositiveNumber);
  add_begin_options(*command, options->begin,
                    "Go on from PATH.cells, which a map that was stopped has left",
                    "Begin anew where an unfinished map is, and lose its cells");
  command->footer(
      "\nCtrl-C stops a map and keeps its cells; --resume continues it.\n"
      "\nExample:\n  polhode map examples/hyperion-map.toml --out hyperion.csv --threads 2");
  command->callback([options] { make_map(*options); });
}

}  // namespace polhode::cli
