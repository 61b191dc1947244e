// SPDX-License-Identifier: MIT
#include "polhode/cli/command_line.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/version.hpp"
#include "stop_signals.hpp"

namespace polhode {
namespace cli {
namespace {

constexpr int bad_input = 2;
constexpr int failed_run = 1;

int failure(int status, const std::string& message) {
  std::fputs((message + "\n").c_str(), stderr);
  return status;
}

// The program, as the shell was told to find it.
std::string typed_program(int argc, const char* const* argv) {
  const std::string typed = argc > 0 && argv[0] != nullptr ? argv[0] : "";
  return typed.empty() ? "polhode" : typed;
}

// The file that was started, without its folder: a program with kinds of its own has another name.
std::string program_name(int argc, const char* const* argv) {
  const std::string path = typed_program(argc, argv);
  const std::string name = path.substr(path.rfind('/') + 1);
  return name.empty() ? "polhode" : name;
}

// "polhode rum FILE": CLI11 only says that a subcommand is missing.
std::string unknown_command(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::string names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_name() == argv[1]) return {};
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  return app.get_name() + ": got command \"" + std::string(argv[1]) + "\"; expected one of " +
         names;
}

// CLI11 names the argument that it cannot place, but not what it could; and not even that where
// something else is missing too, as after "--form" for "--from".
std::string unknown_argument(const CLI::App& command, const std::string& name) {
  const std::vector<std::string> left = command.remaining();
  if (left.empty()) return {};
  const bool is_option = left.front().size() > 1 && left.front().front() == '-';
  std::string expected;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_lnames().empty() == is_option) continue;
    expected += (expected.empty() ? "" : ", ") + option->get_name(!is_option);
  }
  if (is_option) return name + ": got option \"" + left.front() + "\"; expected one of " + expected;
  return name + ": got \"" + left.front() + "\"; expected " +
         (expected.empty() ? "no argument" : "nothing after " + expected);
}

// Help and version are exceptions to CLI11, too.
int parse_outcome(const CLI::App& app, const CLI::ParseError& error, int argc,
                  const char* const* argv) {
  if (error.get_exit_code() != 0) {
    std::string unknown = unknown_command(app, argc, argv);
    if (!unknown.empty()) return failure(bad_input, unknown);
    const auto used = app.get_subcommands();
    const std::string command = used.empty() ? app.get_name() : full_name(*used.front());
    unknown = unknown_argument(used.empty() ? app : *used.front(), command);
    if (!unknown.empty()) return failure(bad_input, unknown);
    std::string text = error.what();
    for (char& c : text)
      if (c == '\n') c = ' ';
    return failure(bad_input, command + ": " + text + "; see " + command + " --help");
  }
  app.exit(error);
  std::cout.flush();
  const bool written = std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return written ? 0 : failure(failed_run, "<stdout>: cannot be written");
}

}  // namespace

std::string full_name(const CLI::App& command) {
  return command.get_parent()->get_name() + " " + command.get_name();
}

void print(std::string_view text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw io::OutputError(std::string("<stdout>: cannot be written: ") + std::strerror(errno));
}

void warn(const std::string& text) { std::fputs(("warning: " + text + "\n").c_str(), stderr); }

}  // namespace cli

inline namespace v0 {

int command_line(int argc, const char* const* argv, const io::Kinds& kinds,
                 const MakeRanks& ranks) {
  using namespace cli;
  let_large_writes_fail();
  CLI::App app("Exact rotation of rigid bodies, in every variable set.", program_name(argc, argv));
  app.set_version_flag("--version", "polhode " + std::string(version()));
  app.require_subcommand(1);
  const std::string& name = app.get_name();
  app.footer("\nExample:\n  " + name + " init tumbler > body.toml && " + name +
             " run body.toml --out body.csv");
  const std::string typed = typed_program(argc, argv);
  add_run(app, kinds, typed);
  add_map(app, kinds, typed, ranks);
  add_ensemble(app, kinds, typed, ranks);
  add_fit(app, kinds, typed);
  add_simulate(app, kinds);
  add_info(app, kinds, ranks != nullptr);
  add_convert(app, kinds);
  add_init(app, kinds);
  add_cite(app, kinds);
  add_completion(app);
  add_golden(app);
  add_nutation(app);
  add_plot(app);
  add_schema(app, kinds);
  add_shape(app);
  add_spectrum(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return parse_outcome(app, error, argc, argv);
  } catch (const Interrupted& error) {
    return failure(128 + error.signal, error.what());
  } catch (const DomainError& error) {
    return failure(bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return failure(failed_run, name + ": out of memory");
  } catch (const std::exception& error) {
    return failure(failed_run, error.what());
  }
}

}  // namespace v0
}  // namespace polhode
