// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/run/summary.hpp"

namespace polhode::cli {
namespace {

std::string instruction_sets() {
  std::string text = "instruction sets:";
  for (const InstructionSet set : supported_instruction_sets())
    text += " " + std::string(instruction_set_name(set));
  return text + "\nused for many states at a time: " +
         std::string(instruction_set_name(widest_instruction_set())) + "\n";
}

std::string processes(bool has_ranks) {
  return has_ranks ? "processes: those that mpirun starts, by MPI\n"
                   : "processes: this one alone; built without POLHODE_MPI\n";
}

}  // namespace

void add_info(CLI::App& app, const io::Kinds& kinds, bool has_ranks) {
  struct Options {
    std::string scenario;
    std::vector<std::string> set;
    bool json = false;
    bool cpu = false;
  };
  CLI::App* command = app.add_subcommand("info", "Say what the body of a scenario does");
  const auto options = std::make_shared<Options>();
  CLI::Option* const file =
      command->add_option("FILE", options->scenario, "Scenario (.toml); - is standard input");
  add_set_option(*command, options->set);
  CLI::Option* const json = command->add_flag("--json", options->json, "For programs: every digit");
  command->add_flag("--cpu", options->cpu, "What of this machine is used, instead of a scenario")
      ->excludes(file)
      ->excludes(json);
  command->footer("Example:\n  " + full_name(*command) + " examples/toutatis.toml");
  command->callback([options, kinds, has_ranks] {
    if (options->cpu) return print(instruction_sets() + processes(has_ranks));
    if (options->scenario.empty()) throw CLI::RequiredError("FILE");
    const io::Scenario scenario = changed_scenario(options->scenario, options->set, kinds);
    const auto lines = io::summary(scenario);
    print(options->json ? io::summary_json(lines) : io::summary_table(lines));
  });
}

}  // namespace polhode::cli
