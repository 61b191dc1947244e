// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "resumable_work.hpp"
#include "run_alone.hpp"

namespace polhode::cli {
namespace {

constexpr std::size_t reasons_shown = 3, columns_shown = 12;

struct EnsembleCommand : SharedWorkOptions {
  std::optional<std::int64_t> member;
};

std::string with_unit(const std::string& unit) { return unit == "1" ? "" : " " + unit; }

// "263 +- 6 h, 241 to 282" of mean, deviation, least and greatest; one member has one number.
std::string spread_text(double members, const double* numbers, const std::string& unit) {
  if (members == 1.0) return fmt::format("{:.10g}{}, of one member", numbers[0], with_unit(unit));
  return fmt::format("{:.10g} +- {:.4g}{}, {:.10g} to {:.10g}", numbers[0], numbers[1],
                     with_unit(unit), numbers[2], numbers[3]);
}

// Mean and deviation of the first columns at the last time, and what was asked for by name.
std::string last_statistics(const std::vector<io::ColumnGroup>& groups,
                            const std::vector<double>& row) {
  std::string text;
  std::size_t place = 0, shown = 0;
  for (const io::ColumnGroup& group : groups) {
    const std::vector<io::Column>& columns = group.columns;
    const double* const numbers = row.data() + place;
    place += columns.size();
    // of no members there is no mean, part or mode; of one no deviation
    const bool counts = columns.size() > 1 && columns[0].name.ends_with("_members");
    const bool is_of_none = (counts && numbers[0] == 0.0) ||
                            (columns[0].name == group.name + "_SAM" && std::isnan(numbers[0]));
    if (group.name == "t") text += fmt::format("at t = {:.10g} {}\n", numbers[0], columns[0].unit);
    if (columns.size() == 2 && columns[1].name.ends_with("_part"))
      text += is_of_none ? fmt::format("  {:<15} no members\n", group.name)
                         : fmt::format("  {:<15} {:.4g} of {:.0f} members\n", group.name,
                                       numbers[1], numbers[0]);
    const bool is_number = columns.size() > 4 && columns[1].name == group.name + "_mean";
    const bool is_mode = columns[0].name == group.name + "_SAM";
    if (is_number && ++shown > columns_shown) {
      if (shown == columns_shown + 1) text += "  ...\n";
      continue;
    }
    if ((is_number || is_mode) && is_of_none)
      text += fmt::format("  {:<15} no members\n", group.name);
    else if (is_mode)
      text += fmt::format("  {:<15} {:.4g} SAM, {:.4g} LAM, {:.4g} others\n", group.name,
                          numbers[0], numbers[1], numbers[2]);
    else if (is_number)
      text += fmt::format("  {:<15} {}\n", group.name,
                          spread_text(numbers[0], numbers + 1, columns[1].unit));
  }
  return text;
}

// "part 0.87 of the members, 0.05 by 1.2 h, 0.5 by 17 h"
std::string event_text(const io::EnsembleReport::FirstTimes& of,
                       const std::vector<double>& quantiles, const std::string& unit) {
  if (std::isnan(of.part)) return of.event + ": no members";
  std::string text = fmt::format("{}: part {:.4g} of the members", of.event, of.part);
  for (std::size_t i = 0; i < quantiles.size(); ++i)
    if (!std::isnan(of.times[i]))
      text += fmt::format(", {:.10g} by {:.10g} {}", quantiles[i], of.times[i], unit);
  return text;
}

// How many members there are, what was drawn, what they have become, and why some have not.
std::string summary_of(const io::ScenarioEnsemble& ensemble,
                       const std::vector<io::ColumnGroup>& groups,
                       const io::EnsembleReport& report) {
  std::string text = fmt::format("members           {}\n", report.members);
  const std::vector<std::string> keys = ensemble.plan().keys(), units = ensemble.plan().units();
  for (std::size_t i = 0; i < report.drawn.size(); ++i) {
    const io::EnsembleReport::Drawn& d = report.drawn[i];
    const double numbers[] = {d.mean, d.deviation, d.least, d.greatest};
    text += fmt::format("varied            {}: {}\n", keys[i],
                        spread_text(static_cast<double>(report.members), numbers, units[i]));
  }
  if (!report.statistics.empty()) text += last_statistics(groups, report.statistics);
  for (const io::EnsembleReport::FirstTimes& event : report.events)
    text += fmt::format("event             {}\n", event_text(event, ensemble.plan().quantiles,
                                                             ensemble.scenario().units().time()));
  for (const io::EnsembleReport::Histogram& histogram : report.histograms)
    text += fmt::format("histogram         {}: {}\n", histogram.name, histogram.path);
  if (report.failed == 0) return text;
  text +=
      fmt::format("failed            {}, left out; polhode ensemble FILE --member K runs one:\n",
                  report.failed);
  const std::size_t shown = std::min(report.failures.size(), reasons_shown);
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("  member {}: {}\n", report.failures[i].member, report.failures[i].why);
  return report.failed > static_cast<std::int64_t>(shown) ? text + "  ...\n" : text;
}

// The scenario of the member; its rows into the outputs that are no scenario.
void run_member(const io::ScenarioEnsemble& ensemble, const EnsembleCommand& options) {
  const std::int64_t index = *options.member;
  const std::string& name = ensemble.scenario().document.name;
  const Alone one{"--member", "member " + std::to_string(index), name};
  std::string text = ensemble.member_text(index);
  const std::vector<std::string> rows = write_scenario_of(one, text, options);
  if (rows.empty()) return;
  const io::Scenario member = ensemble.member_scenario(index, std::move(text));
  io::RunOptions how = begin_options(options);
  if (ensemble.events().empty() && ensemble.plan().indicators.empty())
    return run_alone(one, member, rows, std::move(how));
  // what the ensemble knows of it beside the columns of a run
  const io::MemberReport report = io::write_member(ensemble, index, member, rows, how);
  if (report.was_complete) return print_nothing_to_do(name, rows);
  require_done(one, report.failure);
}

// Tables of the file that its keep leaves out: no error, so that --set ensemble.keep shows members
// of an ensemble as it is.
void say_what_is_not_made(const io::ScenarioEnsemble& ensemble) {
  const io::EnsemblePlan& plan = ensemble.plan();
  if (plan.keep == io::EnsembleKeep::statistics) return;
  const char* const keep = plan.keep == io::EnsembleKeep::final ? "final" : "rows";
  for (const auto& [table, count] : {std::pair("histogram", plan.histograms.size()),
                                     std::pair("fraction", plan.fractions.size())})
    if (count > 0)
      say(
          fmt::format("{}: note: [[ensemble.{}]] is left out: it goes with keep = "
                      "\"statistics\", and this is keep = \"{}\"",
                      ensemble.scenario().document.name, table, keep));
}

void make_ensemble(EnsembleCommand& options, const io::Kinds& kinds) {
  const auto read = [&] { return changed_scenario(options.scenario, options.set, kinds); };
  if (has_served(options, [&] { return io::ensemble_work(read(), options.any_machine); })) return;
  const io::ScenarioEnsemble ensemble(read());
  require_different("ensemble", options.out);
  if (options.member) return run_member(ensemble, options);
  std::vector<std::string> out = options.out;
  if (out.empty()) out.push_back("-");
  const bool to_standard_output = std::find(out.begin(), out.end(), "-") != out.end();
  say_what_is_not_made(ensemble);
  const std::string& name = ensemble.scenario().document.name;
  ResumableWork work(options, name);
  io::RunOptions how = work.run_options(!to_standard_output || isatty(STDOUT_FILENO) == 0);
  how.executor = options.ranks.get();
  how.any_machine = options.any_machine;
  io::EnsembleRun run(ensemble, out, std::move(how));
  if (run.is_complete()) return print_nothing_to_do(name, out);
  work.announce(run, ResumableWork::after(run.reached(), ensemble.size(), "members"), "members");
  work.line().emplace(run.reached(), ensemble.size(), "members");
  const auto begun = std::chrono::steady_clock::now();
  const io::EnsembleReport report = work.run([&] { return run.run(); });
  if (to_standard_output) return;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  print(summary_of(ensemble, run.groups(), report));
  if (const std::string hint = plot_hint(out); !hint.empty())
    print(fmt::format("{:<17} {}\n", "to draw it", hint));
  say(fmt::format("{}: {:.3g} members a second", name,
                  (static_cast<double>(report.members) - run.reached()) / took.count()));
}

}  // namespace

void add_ensemble(CLI::App& app, const io::Kinds& kinds, const std::string& typed,
                  const MakeRanks& ranks) {
  CLI::App* command = app.add_subcommand(
      "ensemble",
      "Run a scenario many times with the numbers of its [ensemble] drawn, on all processors");
  const auto options = std::make_shared<EnsembleCommand>();
  options->program = typed;
  options->command = "ensemble";
  add_scenario(*command, *options);
  add_tables(*command, *options, kinds);
  command
      ->add_option(
          "--member", options->member,
          "Run this member alone, from 0 on: its rows into --out, first times of events and "
          "indicators too, its scenario into a PATH.toml among these; without --out, "
          "print its scenario")
      ->type_name("K")
      ->check(index_of("member"));
  add_threads(*command, *options, "chunks");
  add_begin(*command, *options, {"ensemble", "an ensemble", "members"});
  add_any_machine(*command, *options);
  command->footer(
      "\nCtrl-C stops an ensemble and keeps its members; --resume continues it.\n"
      "\nExample:\n  " +
      full_name(*command) + " examples/apophis-ensemble.toml --out apophis.h5 --threads 2");
  command->callback([options, kinds, ranks] {
    options->begin(ranks);
    make_ensemble(*options, kinds);
  });
}

}  // namespace polhode::cli
