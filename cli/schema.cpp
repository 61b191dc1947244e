// SPDX-License-Identifier: MIT
// Hidden: what docs/reference is generated from (tests/cli check that it is current).
#include "polhode/io/schema.hpp"

#include <memory>

#include "commands.hpp"

namespace polhode::cli {

void add_schema(CLI::App& app) {
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of scenario files");
  const auto markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown, "The key reference of docs/reference/scenario.md");
  command->footer("Example:\n  polhode schema > scenario.schema.json");
  command->group("");
  command->callback([markdown] {
    print(*markdown ? markdown_reference(scenario_schema()) : json_schema(scenario_schema()));
  });
}

}  // namespace polhode::cli
