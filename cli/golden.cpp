// SPDX-License-Identifier: MIT
#include "polhode/run/golden.hpp"

#include <memory>
#include <string>

#include "commands.hpp"

namespace polhode::cli {

void add_golden(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "golden", "Write exact cases (JSON, CSV) to test an engine or a simulator with");
  const auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "Folder for golden.json and golden.csv; made if needed")
      ->required();
  command->footer("Example:\n  " + full_name(*command) + " golden");
  command->callback([folder] {
    const std::vector<io::GoldenCase> cases = io::golden_cases();
    std::size_t samples = 0;
    for (const io::GoldenCase& c : cases) samples += c.samples.size();
    io::write_golden(*folder, cases);
    print(std::to_string(cases.size()) + " cases, " + std::to_string(samples) +
          " states: golden.json and golden.csv in " + *folder + "\n");
  });
}

}  // namespace polhode::cli
