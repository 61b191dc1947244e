// SPDX-License-Identifier: MIT
// What docs/reference is generated from, too (tests/cli check that it is current).
#include "polhode/scenario/schema.hpp"

#include <memory>
#include <string>

#include "commands.hpp"

namespace polhode::cli {

void add_schema(CLI::App& app, const Kinds& kinds) {
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of scenario files");
  const auto part = std::make_shared<std::string>("json");
  command->add_option("PART", *part, "json, or the keys, units or columns of docs/reference")
      ->check(CLI::IsMember({"json", "keys", "units", "columns"}))
      ->capture_default_str();
  command->footer("Example:\n  " + full_name(*command) + " > scenario.schema.json");
  command->callback([part, kinds] {
    const Schema& schema = kinds.schema();
    print(*part == "json"    ? json_schema(schema)
          : *part == "keys"  ? markdown_reference(schema)
          : *part == "units" ? markdown_units()
                             : markdown_columns(kinds.columns()));
  });
}

}  // namespace polhode::cli
