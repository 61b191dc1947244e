// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/run/run.hpp"

namespace polhode::cli {

void add_cite(CLI::App& app, const io::Kinds& kinds) {
  CLI::App* command = app.add_subcommand("cite", "Print the papers that a scenario rests on");
  struct Options {
    std::string scenario;
    std::vector<std::string> set;
    bool bibtex = false;
  };
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->scenario, "Scenario (.toml); - is standard input")
      ->required();
  add_set_option(*command, options->set);
  command->add_flag("--bibtex", options->bibtex, "Print entries for BibTeX");
  command->footer("Example:\n  " + full_name(*command) + " examples/apophis.toml");
  command->callback([options, kinds] {
    std::string text;
    for (const io::Citation& citation :
         io::citations(changed_scenario(options->scenario, options->set, kinds))) {
      if (options->bibtex)
        text += fmt::format("% For {}.\n{}\n", citation.reason, io::bibtex(citation));
      else
        text += fmt::format("[{}] {}\n    For {}.\n", citation.key, citation.text, citation.reason);
    }
    print(text);
  });
}

}  // namespace polhode::cli
