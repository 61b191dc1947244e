// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/run/summary.hpp"

namespace polhode::cli {

void add_info(CLI::App& app, const Kinds& kinds) {
  struct Options {
    std::string scenario;
    std::vector<std::string> set;
    bool json = false;
  };
  CLI::App* command = app.add_subcommand("info", "Say what the body of a scenario does");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->scenario, "Scenario (.toml); - is standard input")
      ->required();
  add_set_option(*command, options->set);
  command->add_flag("--json", options->json, "For programs: every digit");
  command->footer("Example:\n  " + full_name(*command) + " examples/toutatis.toml");
  command->callback([options, kinds] {
    const Scenario scenario = changed_scenario(options->scenario, options->set, kinds);
    const auto lines = summary(scenario);
    print(options->json ? summary_json(lines) : summary_table(lines));
  });
}

}  // namespace polhode::cli
