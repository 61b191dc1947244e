// SPDX-License-Identifier: MIT
// Figures are drawn by the Python package.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"

namespace polhode::cli {
namespace {

struct PlotCommand {
  std::string file, out;
  std::vector<std::string> columns;
};

constexpr const char* script = R"py(import sys
sys.path[:] = [path for path in sys.path if path]
try:
    from polhode.figures.__main__ import draw
except ImportError as error:
    print("plot: it needs the Python package polhode and Matplotlib: "
          f"pip install 'polhode[figures]' ({error})", file=sys.stderr)
    sys.exit(2)
sys.exit(draw(sys.argv[1], sys.argv[2], sys.argv[3:]))
)py";

// In place of this process. POLHODE_PYTHON: the interpreter, that of the package if this is its
// command.
[[noreturn]] void run_python(const PlotCommand& of) {
  const char* const chosen = std::getenv("POLHODE_PYTHON");
  const std::string python = chosen != nullptr && *chosen != '\0' ? chosen : "python3";
  std::vector<std::string> words{python, "-c", script, of.file, of.out};
  words.insert(words.end(), of.columns.begin(), of.columns.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  execvp(python.c_str(), arguments.data());
  throw DomainError("plot: " + python + " cannot be run: " + std::strerror(errno) +
                    "; install Python, and pip install 'polhode[figures]'");
}

}  // namespace

std::string plot_hint(const std::vector<std::string>& outputs) {
  for (const std::string& path : outputs) {
    const bool is_one = path.find("{chunk}") == std::string::npos;
    if (!is_one || !(path.ends_with(".csv") || path.ends_with(".h5"))) continue;
    return "polhode plot " + quoted(path);
  }
  return {};
}

void add_plot(CLI::App& app) {
  CLI::App* command = app.add_subcommand("plot", "Draw what a run, map or ensemble wrote");
  const auto of = std::make_shared<PlotCommand>();
  command->add_option("FILE", of->file, "CSV or HDF5 output of polhode run, map or ensemble")
      ->required();
  command->add_option("--column", of->columns,
                      "Column to draw; may be repeated. Default: chosen by the kind of file");
  command
      ->add_option(
          "--out,-o", of->out,
          "PATH.png, PATH.pdf or PATH.svg. Default: FILE with the extension .png, which must not "
          "exist")
      ->type_name("PATH");
  command->footer(
      "\nIt runs Python with the package polhode: pip install 'polhode[figures]'. "
      "Set POLHODE_PYTHON to use an interpreter other than python3.\n"
      "\nExample:\n  " +
      full_name(*command) + " apophis.csv --out apophis.pdf");
  command->callback([of] { run_python(*of); });
}

}  // namespace polhode::cli
