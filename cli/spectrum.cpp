// SPDX-License-Identifier: MIT
#include <memory>
#include <string>

#include "commands.hpp"
#include "polhode/run/spectrum_report.hpp"

namespace polhode::cli {
namespace {

struct SpectrumCommand {
  io::SpectrumRequest request;
  bool csv = false;
};

void show(const SpectrumCommand& of) {
  const io::SpectrumReport report = io::spectrum_report(of.request);
  print(of.csv ? io::spectrum_csv(report) : io::spectrum_text(report));
  if (const int close = analysis::unresolved(report.spectrum); of.csv && close > 0)
    warn("spectrum: " + std::to_string(close) +
         " lines are closer than 10 turns over the samples to another (column isolation)");
}

}  // namespace

void add_spectrum(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("spectrum", "The leading frequencies of a column of a table");
  const auto of = std::make_shared<SpectrumCommand>();
  io::SpectrumRequest& request = of->request;
  command->add_option("FILE", request.file, "Output of polhode run, or any table of numbers")
      ->required();
  command->add_option("--column", request.column, "What to analyse, by name or number")->required();
  command->add_option("--imaginary", request.imaginary,
                      "Its imaginary part: lines then have a sign");
  command->add_option("--time", request.time, "Column of evenly spaced times")
      ->capture_default_str();
  command->add_option("--time-unit", request.time_unit, "Its unit, where the file does not say it");
  command->add_option("--unit", request.unit,
                      "Of frequencies; arcsec/yr of yr, kyr, Myr, otherwise rad per unit of time");
  command->add_option("--lines", request.options.lines, "How many, at most")->capture_default_str();
  command->add_option("--window", request.options.window, "Order of Hann's window, 0 to 5")
      ->capture_default_str();
  command
      ->add_option("--smallest", request.options.smallest,
                   "Leave out lines below this fraction of the largest")
      ->capture_default_str();
  command->add_flag("--csv", of->csv, "Print a CSV table");
  command->footer("\nExample:\n  " + full_name(*command) +
                  " mars.csv --column obliquity --lines 5");
  command->callback([of] { show(*of); });
}

}  // namespace polhode::cli
