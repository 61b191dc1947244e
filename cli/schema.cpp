// SPDX-License-Identifier: MIT
// What docs/reference is generated from, too (tests/cli check that it is current).
#include "polhode/scenario/schema.hpp"

#include <memory>
#include <string>

#include "commands.hpp"

namespace polhode::cli {

void add_schema(CLI::App& app, const io::Kinds& kinds) {
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of scenario files");
  const auto part = std::make_shared<std::string>("json");
  command->add_option("PART", *part, "json, or the keys, units or columns of docs/reference")
      ->check(CLI::IsMember({"json", "keys", "units", "columns"}))
      ->capture_default_str();
  command->footer("Example:\n  " + full_name(*command) + " > scenario.schema.json");
  command->callback([part, kinds] {
    const io::Schema& schema = kinds.schema();
    print(*part == "json"    ? io::json_schema(schema)
          : *part == "keys"  ? io::markdown_reference(schema)
          : *part == "units" ? io::markdown_units()
                             : io::markdown_columns(kinds.columns()));
  });
}

}  // namespace polhode::cli
