// SPDX-License-Identifier: MIT
#include <memory>
#include <string>

#include "commands.hpp"
#include "polhode/run/citations.hpp"

namespace polhode::cli {

void add_cite(CLI::App& app, const Kinds& kinds) {
  CLI::App* command = app.add_subcommand("cite", "Print the papers that a scenario rests on");
  const auto path = std::make_shared<std::string>();
  command->add_option("FILE", *path, "Scenario (.toml); - is standard input")->required();
  command->footer("Example:\n  " + full_name(*command) + " examples/apophis.toml");
  command->callback([path, kinds] {
    std::string text;
    for (const Citation& citation : citations(read_scenario(*path, kinds)))
      text += "[" + citation.key + "] " + citation.text + "\n    For " + citation.reason + ".\n";
    print(text);
  });
}

}  // namespace polhode::cli
