// SPDX-License-Identifier: MIT
#include "resume.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

#include "polhode/error.hpp"

namespace polhode::cli {
namespace {

// A word as a shell reads it.
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

CLI::Validator whole_number() {
  return in_range(1, std::numeric_limits<int>::max(), "a whole number, 1 or more");
}
CLI::Validator member_index() {
  return in_range(std::int64_t{0}, std::int64_t{1'000'000'000'000},
                  "the index of a member, 0 or more");
}

RunBegin BeginOptions::begin() const {
  return resume ? RunBegin::resume : restart ? RunBegin::restart : RunBegin::anew;
}

void add_begin_options(CLI::App& command, BeginOptions& options, const std::string& resume_help,
                       const std::string& restart_help) {
  CLI::Option* resume = command.add_flag("--resume", options.resume, resume_help);
  command.add_flag("--restart", options.restart, restart_help)->excludes(resume);
}

void add_checkpoint_option(CLI::App& command, double& seconds_between) {
  command
      .add_option("--checkpoint", seconds_between,
                  "Time between two checkpoints in FIRST_OUTPUT.checkpoint, at least")
      ->type_name("SECONDS")
      ->check(in_range(0.0, 1e9, "a number of seconds, from 0 to 1e9"))
      ->capture_default_str();
}

BeginWords begin_words() { return {"--resume", "--restart", "--any-machine"}; }

void require_different(const std::string& command, const std::vector<std::string>& paths) {
  for (auto path = paths.begin(); path != paths.end(); ++path) {
    if (path->empty())
      throw DomainError(command + ": got an empty path; expected a file to write, or -");
    if (std::find(paths.begin(), path, *path) != path)
      throw DomainError(command + ": " + *path + " is named twice");
  }
}

std::string how_to_continue(const std::string& program, const std::vector<std::string>& command,
                            bool can_resume) {
  if (!can_resume) return "; outputs that are not files cannot be continued";
  std::string text = "; continue with: " + quoted(program);
  for (const std::string& word : command) text += " " + quoted(word);
  return text + " --resume";
}

void print_nothing_to_do(const std::string& name, const std::vector<std::string>& paths) {
  std::string names;
  for (const std::string& path : paths) names += (names.empty() ? "" : ", ") + path;
  print(name + ": nothing to do: complete in " + names + "\n");
}

}  // namespace polhode::cli
