// SPDX-License-Identifier: MIT
#include "many_runs.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace polhode::cli {

void add_files(CLI::App& command, ManyRuns& options, const Kinds& kinds) {
  command.add_option("FILE", options.scenario, "Scenario (.toml); - is standard input")->required();
  add_set_option(command, options.set);
  command
      .add_option("--out,-o", options.out,
                  paths_in_words(kinds.formats(),
                                 [](const OutputFormat& format) { return !format.needs.dates; }) +
                      ", any number of them; - is CSV to standard output, also the default")
      ->type_name("PATH");
}

void add_work(CLI::App& command, ManyRuns& options, const ManyRunsWords& words) {
  command
      .add_option("--threads", options.threads,
                  "How many " + words.at_a_time +
                      " at a time; left out: one on each processor. The result does not depend on "
                      "it")
      ->check(whole_number());
  add_begin_options(
      command, options.begin,
      "Continue " + words.one + " that was stopped, from its FIRST_OUTPUT.checkpoint",
      "Begin anew where an unfinished " + words.name + " is, and lose its " + words.members);
  add_checkpoint_option(command, options.checkpoint);
}

std::vector<std::string> command_of(const std::string& name, const ManyRuns& options) {
  std::vector<std::string> words = {name, options.scenario};
  for (const std::string& change : options.set) words.insert(words.end(), {"--set", change});
  for (const std::string& path : options.out) words.insert(words.end(), {"--out", path});
  if (options.threads > 0)
    words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  return words;
}

void announce(const std::string& scenario, bool continues, std::int64_t done, std::int64_t size,
              const std::string& members) {
  const std::string text = continues
                               ? fmt::format(": continues after {} of {} {}", done, size, members)
                               : ": no " + members + " to continue from, starts anew";
  std::fputs((scenario + text + "\n").c_str(), stderr);
}

}  // namespace polhode::cli
