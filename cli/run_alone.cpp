// SPDX-License-Identifier: MIT
#include "run_alone.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode::cli {

std::vector<std::string> write_scenario_of(const Alone& one, const std::string& text,
                                           const WorkOptions& options) {
  std::vector<std::string> rows;
  std::ranges::copy_if(options.out, std::back_inserter(rows),
                       [](const std::string& path) { return !path.ends_with(".toml"); });
  if (rows.empty() && (options.resume || options.restart))
    throw DomainError("polhode " + options.command + ": got --resume or --restart of " +
                      one.option +
                      " without rows in --out, which has nothing to go on from; expected " +
                      one.option + " alone, or --out PATH.csv as well");
  if (options.out.empty()) print(text);
  for (const std::string& path : options.out) {
    if (!path.ends_with(".toml")) continue;
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw io::OutputError(path + ": cannot be written");
  }
  return rows;
}

void require_done(const Alone& one, const std::string& failure) {
  if (!failure.empty())
    throw std::runtime_error(one.scenario + ": " + one.called + " failed: " + failure);
}

void run_alone(const Alone& one, const io::Scenario& scenario, const std::vector<std::string>& rows,
               io::RunOptions how) {
  io::ScenarioRun run(scenario, {rows, {}}, std::move(how));
  if (run.is_complete()) return print_nothing_to_do(scenario.document.name, rows);
  const io::RunReport report = run.run();
  require_done(one, report.outcome.ok() ? std::string() : report.outcome.advice);
}

}  // namespace polhode::cli
