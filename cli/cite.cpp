// SPDX-License-Identifier: MIT
#include <fmt/format.h>

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
      text += fmt::format("[{}] {}\n    For {}.\n", citation.key, citation.text, citation.reason);
    print(text);
  });
}

}  // namespace polhode::cli
