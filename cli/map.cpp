// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "polhode/run/map_run.hpp"
#include "resumable_work.hpp"
#include "run_alone.hpp"

namespace polhode::cli {
namespace {

constexpr std::size_t reasons_shown = 3;

struct MapCommand : SharedWorkOptions {
  std::optional<std::int64_t> cell;
};

// The scenario of the cell; the rows of its run into the outputs that are no scenario.
void run_cell(const io::ScenarioMap& map, const MapCommand& options) {
  const Alone one{"--cell", "cell " + std::to_string(*options.cell), map.scenario().document.name};
  std::string text = map.cell_text(*options.cell);
  const std::vector<std::string> rows = write_scenario_of(one, text, options);
  if (rows.empty()) return;
  const io::Scenario cell = map.cell_scenario(*options.cell, std::move(text));
  run_alone(one, cell, rows, begin_options(options));
}

// How many cells there are, what they hold, and why some hold nothing.
std::string summary_of(const io::ScenarioMap& map, const io::MapReport& report) {
  std::string text = fmt::format("cells             {}\n", report.cells);
  const std::vector<io::Column> columns = map.groups().back().columns;
  if (map.plan().kind == io::MapKind::andoyer_section ||
      map.plan().kind == io::MapKind::spin_orbit_section)
    text += fmt::format("points            {}\n", report.points);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto [least, most] = report.ranges[i];
    if (least <= most)
      text += fmt::format("{:<17} {:.10g} to {:.10g} {}\n", columns[i].name, least, most,
                          columns[i].unit == "1" ? "" : columns[i].unit);
  }
  const std::size_t failed = report.failures.size();
  if (failed == 0) return text;
  text += fmt::format(
      "failed            {}, filled with nan; to run one: polhode map FILE --cell K:\n", failed);
  for (std::size_t i = 0; i < std::min(failed, reasons_shown); ++i)
    text += fmt::format("  cell {}: {}\n", report.failures[i].cell, report.failures[i].why);
  return failed <= reasons_shown ? text : text + "  ...\n";
}

void make_map(MapCommand& options, const io::Kinds& kinds) {
  const auto read = [&] { return changed_scenario(options.scenario, options.set, kinds); };
  if (has_served(options, [&] { return io::map_work(read(), options.any_machine); })) return;
  const io::ScenarioMap map(read());
  require_different("map", options.out);
  if (options.cell) return run_cell(map, options);
  std::vector<std::string> out = options.out;
  if (out.empty()) out.push_back("-");
  const bool to_standard_output = std::find(out.begin(), out.end(), "-") != out.end();
  const std::string& name = map.scenario().document.name;
  ResumableWork work(options, name);
  io::RunOptions how = work.run_options(!to_standard_output || isatty(STDOUT_FILENO) == 0);
  how.executor = options.ranks.get();
  how.any_machine = options.any_machine;
  io::MapRun run(map, out, std::move(how));
  if (run.is_complete()) return print_nothing_to_do(name, out);
  work.announce(run, ResumableWork::after(run.reached(), map.size(), "cells"), "cells");
  work.line().emplace(run.reached(), map.size(), "cells");
  const io::MapReport report = work.run([&] { return run.run(); });
  if (to_standard_output) return;
  print(summary_of(map, report));
  if (const std::string hint = plot_hint(out); !hint.empty())
    print(fmt::format("{:<17} {}\n", "to draw it", hint));
}

}  // namespace

void add_map(CLI::App& app, const io::Kinds& kinds, const std::string& typed,
             const MakeRanks& ranks) {
  CLI::App* command = app.add_subcommand(
      "map",
      "Run a scenario over the grid of its [map], on all processors: chaos, extremes, sections");
  const auto options = std::make_shared<MapCommand>();
  options->program = typed;
  options->command = "map";
  add_scenario(*command, *options);
  add_tables(*command, *options, kinds);
  command
      ->add_option("--cell", options->cell,
                   "Run only this cell (the first is 0): its rows into --out, its scenario into a "
                   "PATH.toml among these; without --out, print its scenario")
      ->type_name("K")
      ->check(index_of("cell"));
  add_threads(*command, *options, "cells");
  add_begin(*command, *options, {"map", "a map", "cells"});
  add_any_machine(*command, *options);
  command->footer(
      "\nCtrl-C stops a map and keeps its cells; --resume continues it.\n"
      "\nExample:\n  " +
      full_name(*command) + " examples/hyperion-map.toml --out hyperion.csv --threads 2");
  command->callback([options, kinds, ranks] {
    options->begin(ranks);
    make_map(*options, kinds);
  });
}

}  // namespace polhode::cli
