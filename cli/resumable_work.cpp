// SPDX-License-Identifier: MIT
#include "resumable_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>

#include "polhode/error.hpp"

namespace polhode::cli {

std::string quoted(const std::string& word) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::strchr("_-./+=:,@%", c) != nullptr;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

namespace {

// A check that all of the text is a number of this type in a range.
template <class T>
CLI::Validator in_range(T first, T last, const std::string& expected) {
  return CLI::Validator(
      [=](const std::string& text) {
        T x{};
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, x);
        const bool good = error == std::errc() && stop == end && x >= first && x <= last;
        return good ? std::string() : "got \"" + text + "\"; expected " + expected;
      },
      "");
}

}  // namespace

CLI::Validator index_of(const std::string& what) {
  return in_range(std::int64_t{0}, std::int64_t{1'000'000'000'000},
                  "the index of a " + what + ", 0 or more");
}

void add_scenario(CLI::App& command, WorkOptions& options) {
  command.add_option("FILE", options.scenario, "Scenario (.toml); - is standard input")->required();
  add_set_option(command, options.set);
}

void add_tables(CLI::App& command, WorkOptions& options, const io::Kinds& kinds) {
  command
      .add_option(
          "--out,-o", options.out,
          io::paths_in_words(kinds.formats(),
                             [](const io::OutputFormat& format) { return !format.needs.dates; }) +
              ", any number of them; - is CSV to standard output, also the default")
      ->type_name("PATH");
}

void add_threads(CLI::App& command, WorkOptions& options, const std::string& at_a_time) {
  command
      .add_option("--threads", options.threads,
                  "How many " + at_a_time +
                      " at a time; left out: one on each processor. The result does not depend on "
                      "it")
      ->check(in_range(1, std::numeric_limits<int>::max(), "a whole number, 1 or more"));
}

void add_begin(CLI::App& command, WorkOptions& options, const WorkWords& words) {
  CLI::Option* resume = command.add_flag(
      "--resume", options.resume,
      "Continue " + words.one + " that was stopped, from its FIRST_OUTPUT.checkpoint");
  command
      .add_flag(
          "--restart", options.restart,
          "Begin anew where an unfinished " + words.name + " is, and lose its " + words.results)
      ->excludes(resume);
  command
      .add_option("--checkpoint", options.checkpoint,
                  "Time between two checkpoints in FIRST_OUTPUT.checkpoint, at least")
      ->type_name("SECONDS")
      ->check(in_range(0.0, 1e9, "a number of seconds, from 0 to 1e9"))
      ->capture_default_str();
}

void add_any_machine(CLI::App& command, SharedWorkOptions& options) {
  command.add_flag("--any-machine", options.any_machine,
                   "Let machines work together, or go on, whose sines and logarithms differ in "
                   "last digits: so do the results");
}

void SharedWorkOptions::begin(const MakeRanks& make) {
  if (any_machine) own_flags = {"--any-machine"};
  if (make) ranks = make(std::max(threads, 1));
}

bool has_served(SharedWorkOptions& options, const ensemble::Ranks::MakeWork& make) {
  if (!options.ranks) return false;
  if (options.ranks->leads()) {
    if (options.scenario != "-") return false;
    throw DomainError("polhode " + options.command +
                      ": got - and several processes, of which one has standard input; expected a "
                      "file that all can read");
  }
  const StopSignals signals;  // they are for the one that leads: it says when to stop
  options.ranks->serve(make);
  return true;
}

io::RunOptions begin_options(const WorkOptions& options) {
  io::RunOptions how;
  if (options.resume) how.begin = io::RunBegin::resume;
  if (options.restart) how.begin = io::RunBegin::restart;
  how.words = {"--resume", "--restart", "--any-machine"};
  how.checkpoint_seconds = options.checkpoint;
  return how;
}

void require_different(const std::string& command, const std::vector<std::string>& paths) {
  for (auto path = paths.begin(); path != paths.end(); ++path) {
    if (path->empty())
      throw DomainError(command + ": got an empty path; expected a file to write, or -");
    if (std::find(paths.begin(), path, *path) != path)
      throw DomainError(command + ": " + *path + " is named twice");
  }
}

void print_nothing_to_do(const std::string& name, const std::vector<std::string>& paths) {
  std::string names;
  for (const std::string& path : paths) names += (names.empty() ? "" : ", ") + path;
  print(name + ": nothing to do: complete in " + names + "\n");
}

void say(const std::string& line) { std::fputs((line + "\n").c_str(), stderr); }

io::RunOptions ResumableWork::run_options(bool shows) {
  signals_.emplace();
  io::RunOptions how = begin_options(options_);
  how.threads = options_.threads;
  how.stop = [] { return StopSignals::came() != 0; };
  if (shows) how.progress = [this](const io::RunProgress& at) { (*line_)(at); };
  return how;
}

void ResumableWork::announce(const io::ResumableRun& run, const std::string& where,
                             const std::string& results) const {
  if (options_.resume)
    say(name_ + (run.continues() ? ": continues " + where
                                 : ": no " + results + " to continue from, starts anew"));
}

std::string ResumableWork::after(double reached, std::int64_t size, const std::string& results) {
  return fmt::format("after {:.0f} of {} {}", reached, size, results);
}

Interrupted ResumableWork::interrupted(const std::exception& stopped, bool can_resume,
                                       const std::string& advice) {
  end();
  std::string text = stopped.what() + std::string("; ");
  if (!can_resume) return {StopSignals::came(), text + advice};
  text += "continue with: " + quoted(options_.program);
  const auto add = [&](const std::string& word) { text += " " + quoted(word); };
  const auto add_each = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      add(option);
      add(value);
    }
  };
  add(options_.command);
  add(options_.scenario);
  add_each("--set", options_.set);
  add_each("--out", options_.out);
  for (const std::string& word : options_.own_words) add(word);
  if (options_.threads > 0) add_each("--threads", {std::to_string(options_.threads)});
  for (const std::string& word : options_.own_flags) add(word);
  return {StopSignals::came(), text + " --resume"};
}

void ResumableWork::end() {
  line_.reset();
  signals_.reset();
}

}  // namespace polhode::cli
