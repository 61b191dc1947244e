// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/scenario/changes.hpp"

namespace polhode::cli {

void add_set_option(CLI::App& command, std::vector<std::string>& changes) {
  command
      .add_option("--set", changes,
                  "Another value of a key of the file, as TOML has it: state.tumbler.mode=LAM, "
                  "event.0.value=90, \"time.at=[1, 2]\"; without a value the key is left out. Any "
                  "number of them")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

io::Scenario changed_scenario(const std::string& path, const std::vector<std::string>& changes,
                              const io::Kinds& kinds) {
  std::vector<io::ScenarioChange> all;
  try {
    for (const std::string& change : changes) all.push_back(io::change_of(change));
    io::Scenario scenario = io::read_scenario(path, kinds, all);
    for (const std::string& text : io::warnings(scenario)) warn(text);
    return scenario;
  } catch (const io::ScenarioError&) {
    throw;
  } catch (const io::ChangeError& error) {
    throw DomainError(std::string("--set: ") + error.what());
  }
}

}  // namespace polhode::cli
