// SPDX-License-Identifier: MIT
#include <memory>
#include <string>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/scenario/schema.hpp"

namespace polhode::cli {

void add_init(CLI::App& app, const Kinds& kinds) {
  CLI::App* command = app.add_subcommand("init", "Print a commented scenario to start from");
  const auto chart = std::make_shared<std::string>("attitude-rate");
  std::string names;
  for (const std::string_view name : scenario_templates(kinds.schema()))
    names += (names.empty() ? "" : ", ") + std::string(name);
  command
      ->add_option("CHART", *chart,
                   "How the state of a free body is given, or what perturbs it: " + names)
      ->capture_default_str();
  command->footer("Example:\n  " + full_name(*command) + " gravity-gradient > body.toml");
  command->callback([chart, kinds, name = full_name(*command), program = app.get_name()] {
    try {
      print(scenario_template(*chart, kinds.schema(), program));
    } catch (const DomainError& error) {
      throw DomainError(name + ": " + error.what());
    }
  });
}

}  // namespace polhode::cli
