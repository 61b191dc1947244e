// SPDX-License-Identifier: MIT
#include "polhode/run/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/error.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/run/simulate.hpp"
#include "resumable_work.hpp"

namespace polhode::cli {
namespace {

struct FitCommand : WorkOptions {
  std::vector<std::string> residuals, covariance, landscape, at, predict;
  std::string solution;
  bool json = false, scans_only = false;
};

// PATH.toml of the first solution, then PATH-2.toml and so on; also of .csv and .h5.
std::string numbered(const std::string& path, std::size_t place) {
  if (place == 0 || path == "-") return path;
  const std::size_t slash = path.rfind('/'), dot = path.rfind('.');
  const bool has_extension =
      dot != std::string::npos && (slash == std::string::npos || dot > slash);
  const std::size_t end = has_extension ? dot : path.size();
  return path.substr(0, end) + "-" + std::to_string(place + 1) + path.substr(end);
}

// A fit that ended without a solution: to continue it would find none either.
struct NoSolution : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void fail(const io::Scenario& scenario, const std::string& starts,
                       const std::string& failure) {
  throw NoSolution(fmt::format("{}: no solution: from {} the fit did not converge: {}",
                               scenario.document.name, starts, failure));
}

// Whether a table takes the place of the text on standard output.
bool prints_table(const FitCommand& options) {
  for (const std::vector<std::string>* const paths :
       {&options.residuals, &options.covariance, &options.landscape})
    if (std::count(paths->begin(), paths->end(), "-") > 0) return true;
  return false;
}

// Files of every solution; the text of all of them, unless a table takes its place on standard
// output.
template <class Report>
void write_results(const FitCommand& options, const io::Scenario& scenario, const Report& report,
                   const std::vector<double>& times) {
  const std::size_t most = io::require_fit(scenario).most_solutions;
  const std::size_t count = std::min(report.solutions.size(), most);
  const std::vector<double> predicted =
      options.predict.empty() || !options.at.empty() ? times : io::prediction_times(scenario);
  for (std::size_t i = 0; i < count; ++i)
    for (const std::string& path : options.predict)
      io::write_predictions(scenario, io::fit_predictions(report, i, predicted), numbered(path, i));
  const bool writes = !options.residuals.empty() || !options.covariance.empty() ||
                      !options.predict.empty() || !options.solution.empty();
  if (writes && count < report.solutions.size())
    say(fmt::format(
        "{}: note: files of {} of {} solutions were written; fit.most_solutions = {} is "
        "the limit",
        scenario.document.name, count, report.solutions.size(), most));
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::string& path : options.residuals)
      io::write_residuals(scenario, report, i, numbered(path, i));
    for (const std::string& path : options.covariance)
      io::write_covariance(scenario, report, i, numbered(path, i));
    if (!options.solution.empty())
      io::write_solution(scenario, report, i, numbered(options.solution, i));
  }
  if (!prints_table(options) && std::ranges::count(options.predict, "-") == 0)
    print(options.json ? io::fit_json(scenario, report, times)
                       : io::fit_text(scenario, report, times));
}

// Those of --at, and what is wrong with what is to be predicted, before the fit.
std::vector<double> times_at(const FitCommand& options, const io::Scenario& scenario) {
  if (!options.predict.empty() && options.at.empty()) io::prediction_times(scenario);
  if (!options.at.empty() && options.predict.empty() && prints_table(options))
    throw DomainError(scenario.document.name +
                      ": --at: another table goes to standard output and not the text with what is "
                      "predicted; expected --predict PATH as well");
  try {
    return io::prediction_times(scenario, options.at);
  } catch (const DomainError& error) {
    throw DomainError(std::string("--at: ") + error.what());
  }
}

std::vector<std::string> outputs_of(const FitCommand& options) {
  std::vector<std::string> paths;
  if (!options.solution.empty()) paths.push_back(options.solution);
  for (const std::vector<std::string>* const some :
       {&options.residuals, &options.covariance, &options.landscape, &options.predict})
    paths.insert(paths.end(), some->begin(), some->end());
  return paths;
}

void add_own_words(FitCommand& options) {
  const auto add = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values)
      options.own_words.insert(options.own_words.end(), {option, value});
  };
  if (!options.solution.empty()) add("--solution", {options.solution});
  add("--residuals", options.residuals);
  add("--covariance", options.covariance);
  add("--landscape", options.landscape);
  add("--at", options.at);
  add("--predict", options.predict);
  if (options.scans_only) options.own_flags.emplace_back("--scan-only");
  if (options.json) options.own_flags.emplace_back("--json");
}

// A fit that keeps what it finds, and says how to continue when it is stopped.
class KeptFit {
 public:
  KeptFit(const FitCommand& options, const io::Scenario& scenario)
      : work_(options, scenario.document.name),
        checkpoint_(scenario, outputs_of(options), work_.run_options(false)) {
    work_.announce(checkpoint_, fmt::format("after {:.0f} results", checkpoint_.reached()),
                   "results");
  }

  ensemble::CellJournal* journal() { return &checkpoint_.journal(); }
  std::optional<ProgressLine>& line() { return work_.line(); }
  // Results that are read again take no time.
  void tell(const io::RunProgress& at) {
    if (!line()) return;
    if (checkpoint_.journal().is_replaying())
      line()->begin_at(at);
    else
      (*line())(at);
  }

  template <class Fit>
  auto run(const Fit& fit) {
    try {
      auto report = fit();
      work_.end();
      return report;
    } catch (const io::RunInterrupted& stopped) {
      throw work_.interrupted(
          stopped, checkpoint_.keep(),
          "a fit that writes a file, such as --solution PATH.toml, can be continued");
    }
  }

  void keep() { checkpoint_.keep(); }
  // The fit is complete, or has no solution.
  void forget() { checkpoint_.forget(); }

 private:
  ResumableWork work_;
  io::FitCheckpoint checkpoint_;
};

io::FitOptions fit_options(const FitCommand& options, KeptFit& kept) {
  io::FitOptions how;
  how.threads = options.threads > 0 ? options.threads : ensemble::hardware_threads();
  how.scans_only = options.scans_only;
  how.journal = kept.journal();
  how.stop = [] { return StopSignals::came() != 0; };
  how.progress = [&kept](const io::RunProgress& at) { kept.tell(at); };
  return how;
}

void fit_snapshots(const FitCommand& options, const io::Scenario& scenario, KeptFit& kept) {
  if (!options.landscape.empty() || options.scans_only)
    throw DomainError(scenario.document.name +
                      (options.scans_only ? ": --scan-only" : ": --landscape") +
                      ": there is none; expected light curves and fit.from = "
                      "\"search\"");
  const std::vector<double> times = times_at(options, scenario);
  const io::FitOptions how = fit_options(options, kept);
  if (const std::int64_t starts = io::require_fit(scenario).starts; starts > 1)
    kept.line().emplace(0.0, starts, "starts");
  const io::FitReport report = kept.run([&] { return io::fit_scenario(scenario, how); });
  if (!report.is_found())
    fail(scenario,
         report.starts == 1 ? std::string("its start")
                            : fmt::format("each of {} starts", report.starts),
         report.failure);
  write_results(options, scenario, report, times);
}

void fit_light_curves(FitCommand options, const io::Scenario& scenario, KeptFit& kept) {
  const std::vector<double> times = times_at(options, scenario);
  const io::LightPlan& plan = io::require_fit(scenario).light;
  const bool scans = plan.searches && plan.periods.empty();
  if (!options.landscape.empty() && !scans)
    throw DomainError(scenario.document.name +
                      ": --landscape: no scan is made, and there is no landscape; expected "
                      "fit.from = \"search\" without fit.periods");
  if (options.scans_only && !scans)
    throw DomainError(scenario.document.name +
                      ": --scan-only: no scan is made; expected fit.from = \"search\" without "
                      "fit.periods");
  io::FitOptions how = fit_options(options, kept);
  how.begins = [&](const std::string& stage, const std::string& work) {
    kept.line().reset();
    kept.line().emplace(stage != "surfaces"                        ? stage
                        : plan.shape == io::LightPlan::Shape::mesh ? std::string("fits of the mesh")
                                                                   : std::string("convex bodies"),
                        work);
  };
  const io::LightReport report = kept.run([&] { return io::fit_light_scenario(scenario, how); });
  for (const std::string& path : options.landscape) io::write_landscape(scenario, report, path);
  if (report.start && !report.is_found() && report.chosen.empty() && report.notes.empty())
    fail(scenario, "its start", report.failure);
  if (!report.is_found()) {
    // minima, pairs and what they came to are worth reading without a solution
    if (!prints_table(options))
      print(options.json ? io::fit_json(scenario, report) : io::fit_text(scenario, report));
    if (options.scans_only) return;
    if (report.start) fail(scenario, "its start", report.failure);
    throw NoSolution(fmt::format("{}: no solution: {}", scenario.document.name, report.failure));
  }
  if (prints_table(options) && !report.verdict.empty())
    say(scenario.document.name + ": note: " + report.verdict);
  if (!options.covariance.empty() && !report.has_errors()) {
    say(scenario.document.name + ": note: --covariance: no file was written, since no solution " +
        "describes the data");
    options.covariance.clear();
  }
  write_results(options, scenario, report, times);
}

void fit_file(const FitCommand& options, const io::Kinds& kinds) {
  const io::Scenario scenario = changed_scenario(options.scenario, options.set, kinds);
  io::require_own_files(scenario, outputs_of(options));
  for (const std::vector<std::string>* const tables :
       {&options.residuals, &options.covariance, &options.landscape, &options.predict})
    for (const std::string& path : *tables)
      static_cast<void>(scenario.output.formats.of_output(path));  // before the work
  KeptFit kept(options, scenario);
  try {
    if (io::observes_light(scenario))
      fit_light_curves(options, scenario, kept);
    else
      fit_snapshots(options, scenario, kept);
  } catch (const NoSolution&) {
    kept.forget();
    throw;
  } catch (const io::OutputError&) {  // a full disk does not lose the results
    try {
      kept.keep();
    } catch (const io::OutputError&) {  // the first error is the one to report
    }
    throw;
  }
  kept.forget();
}

}  // namespace

void add_fit(CLI::App& app, const io::Kinds& kinds, const std::string& typed) {
  CLI::App* command = app.add_subcommand(
      "fit", "Find the spin state that was observed, with its uncertainty: kind = \"fit\"");
  const auto options = std::make_shared<FitCommand>();
  options->program = typed;
  options->command = "fit";
  add_scenario(*command, *options);
  command
      ->add_option("--residuals", options->residuals,
                   "Residuals of each observation, PATH.csv or PATH.h5; of a second solution "
                   "PATH-2.csv and so on. Any number of them")
      ->type_name("PATH")
      ->allow_extra_args(false);
  command
      ->add_option("--covariance", options->covariance,
                   "Covariance of the unknowns, as --residuals")
      ->type_name("PATH")
      ->allow_extra_args(false);
  command
      ->add_option("--solution", options->solution,
                   "A scenario that begins at the solution, for polhode run; of a second solution "
                   "PATH-2.toml and so on. Of a convex body its mesh, too: PATH-seen.obj")
      ->type_name("PATH");
  command
      ->add_option("--landscape", options->landscape,
                   "Of light curves: chi-square of the scan by its two frequencies, PATH.csv or "
                   "PATH.h5. Any number of them")
      ->type_name("PATH")
      ->allow_extra_args(false);
  command
      ->add_option("--at", options->at,
                   "A time at which the attitude is predicted with its error: a number in the unit "
                   "of the file, or a date, \"2004-10-07T13:56:00 UTC\". Any number of them")
      ->type_name("WHEN")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--predict", options->predict,
          "Attitudes and their errors at the times --at, or else at the rows of [time], as "
          "--residuals")
      ->type_name("PATH")
      ->allow_extra_args(false);
  add_threads(*command, *options, "starts");
  add_begin(*command, *options, {"fit", "a fit", "results"});
  command->add_flag("--scan-only", options->scans_only,
                    "Stop after the period scan (light curves)");
  command->add_flag("--json", options->json, "For programs: every digit");
  command->footer("Example:\n  " + full_name(*command) +
                  " examples/toutatis-1992.toml --solution fitted.toml");
  command->callback([options, kinds] {
    add_own_words(*options);
    fit_file(*options, kinds);
  });
}

void add_simulate(CLI::App& app, const io::Kinds& kinds) {
  struct Options {
    std::string scenario, folder;
    std::vector<std::string> set;
    bool may_replace = false;
  };
  CLI::App* command = app.add_subcommand(
      "simulate", "Write what a file of kind \"fit\" would observe at its [time], with noise");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->scenario, "Scenario (.toml); - is standard input")
      ->required();
  add_set_option(*command, options->set);
  command
      ->add_option("--into", options->folder,
                   "Folder for the files that [[observation]] names; it is made")
      ->type_name("DIR")
      ->required();
  command->add_flag("--replace", options->may_replace, "Replace files that are there");
  command->footer("Example:\n  " + full_name(*command) +
                  " examples/toutatis-1992.toml --set simulate.seed=2 --into synthetic");
  command->callback([options, kinds] {
    const io::Scenario scenario = changed_scenario(options->scenario, options->set, kinds);
    for (const std::string& path :
         io::write_simulation(scenario, options->folder, options->may_replace))
      print(path + "\n");
  });
}

}  // namespace polhode::cli
