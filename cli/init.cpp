// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/scenario/schema.hpp"

namespace polhode::cli {

void add_init(CLI::App& app, const io::Kinds& kinds) {
  CLI::App* command = app.add_subcommand("init", "Print a commented scenario to start from");
  const auto word = std::make_shared<std::string>("attitude-rate");
  std::string names;
  std::vector<std::string> words;
  for (const io::TemplateSort& one : io::scenario_templates(kinds.schema())) {
    names += (names.empty() ? "" : "; ") + std::string(one.sort) + ": ";
    words.insert(words.end(), one.words.begin(), one.words.end());
    for (const std::string& name : one.words)
      names += (&name == one.words.data() ? "" : ", ") + name;
  }
  offer(*command->add_option("KIND", *word, "What the scenario shows. " + names)
             ->capture_default_str(),
        words);
  command->footer("Example:\n  " + full_name(*command) + " gravity-gradient > body.toml");
  command->callback([word, kinds, name = full_name(*command), program = app.get_name()] {
    try {
      print(io::scenario_template(*word, kinds.schema(), program));
    } catch (const DomainError& error) {
      throw DomainError(name + ": " + error.what());
    }
  });
}

}  // namespace polhode::cli
