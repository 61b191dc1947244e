// SPDX-License-Identifier: MIT
// Fits and simulations of scenarios.
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "fit/bind_fit.hpp"
#include "fit/kept_rows.hpp"
#include "fit/spin_problem.hpp"
#include "io/io_parts.hpp"
#include "io/work_loop.hpp"
#include "motion/samples.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/run/fit.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/run/simulate.hpp"

namespace polhode::python {

namespace {

using ScenarioFit = FitOf<io::FitReport>;

ScenarioFit fit_of(const io::Scenario& scenario, int threads, nb::handle progress) {
  ScenarioFit fit{std::make_shared<const io::Scenario>(scenario), {}};
  const std::int64_t starts = io::require_fit(scenario).starts;
  WorkLoop loop("the fit was stopped", count_to(progress, starts));
  io::FitOptions options;
  options.threads = checked_threads(threads);
  options.stop = [&loop] { return loop.is_stopped(); };
  options.progress = [&loop](const io::RunProgress& at) { loop.reach(at.reached); };
  loop.do_work([&] { fit.report = io::fit_scenario(*fit.scenario, options); });
  return fit;
}

// What a file of rows would hold.
struct Kept {
  std::vector<io::ColumnGroup> groups;
  std::vector<double> rows;
  std::vector<std::string> notes;
};

constexpr const char* extension = ".rows-in-memory";

// The scenario, whose outputs of this extension go into `kept`.
io::Scenario keeping(const io::Scenario& scenario, Kept& kept) {
  io::Scenario changed = scenario;
  io::OutputFormat format("rows-in-memory", extension, "Rows for Python.",
                          [&kept](const io::SinkRequest& request) -> std::unique_ptr<io::Sink> {
                            kept.groups = request.groups;
                            kept.notes = request.provenance.notes;
                            return std::make_unique<TableSink>(kept.rows);
                          });
  changed.output.formats = changed.output.formats.with(std::move(format));
  return changed;
}

double middle_of(const fit::Snapshots& seen) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  const auto reach = [&](const auto& rows) {
    for (const auto& row : rows) {
      first = std::min(first, row.t);
      last = std::max(last, row.t);
    }
  };
  reach(seen.attitudes);
  reach(seen.directions);
  reach(seen.rates);
  reach(seen.measurements);
  return 0.5 * (first + last);
}

// Priors of the attitude and the rate are those at t0.
bool may_move(const fit::SpinFit& fit) {
  if (fit.attitude_prior) return false;
  return std::ranges::none_of(fit.priors, [](const fit::NormalPrior& prior) {
    return std::ranges::any_of(prior.unknowns,
                               [](const std::string& name) { return name.starts_with("w_"); });
  });
}

// The fit of snapshots, as it begins at a solution; of scaled errors where these are asked for. The
// epoch is the middle of the observations where it may be: far from them, an error of the rate is
// one of the attitude, along a curve.
SpinProblem problem_at(const ScenarioFit& fit, std::size_t solution, bool scaled,
                       const std::optional<double>& epoch) {
  const io::FitReport& report = fit.report;
  const io::FoundSpin& found = report.solutions.at(solution);
  SpinProblem problem{report.problem, report.drive};
  const bool has_scaled = scaled && found.scaled;
  const fit::SpinSolution& from = has_scaled ? *found.scaled : found.raw;
  problem.fit.start = from.state;
  if (report.drive) problem.drive = fit::solved_drive(report.problem, *report.drive, from);
  if (has_scaled) problem.fit.error_factor = found.scaled->error_factor;
  const bool moves = may_move(problem.fit);
  if (epoch && !moves && *epoch != from.state.t0)
    throw nb::value_error("epoch: priors of the attitude or the rate are of t = 0; expected None");
  if (!moves) return problem;
  const double t = epoch.value_or(middle_of(problem.fit.seen));
  const fit::PredictedAttitude there =
      report.drive ? fit::driven_attitudes(problem.fit.start, *problem.drive, {&t, 1}).front()
                   : fit::predicted(problem.fit, from, {&t, 1}).front();
  problem.fit.start = {t, there.q, there.w_F, from.state.inertia_F};
  return problem;
}

// What of a problem is not in its scenario: (state, numbers of torques and jumps, error factor).
nb::tuple parts_of(const SpinProblem& problem) {
  std::vector<double> drive;
  if (problem.drive) {
    for (const fit::TorqueParameter& one : problem.drive->parameters) drive.push_back(one.start);
    for (const fit::SpinJump& jump : problem.drive->jumps)
      for (int k = 0; k < 3; ++k) drive.push_back(jump.change[k]);
  }
  return nb::make_tuple(spin_parts(problem.fit.start), nb::cast(drive), problem.fit.error_factor);
}

// The same problem again.
SpinProblem problem_of(const io::Scenario& scenario, const nb::tuple& given) {
  io::FitProblem of = io::fit_problem(scenario);
  of.fit.start = spin_of(nb::cast<nb::tuple>(given[0]));
  of.fit.error_factor = nb::cast<double>(given[2]);
  const auto numbers = nb::cast<std::vector<double>>(given[1]);
  std::size_t i = 0;
  if (of.drive) {
    for (fit::TorqueParameter& one : of.drive->parameters) one.start = numbers.at(i++);
    for (fit::SpinJump& jump : of.drive->jumps)
      for (int k = 0; k < 3; ++k) jump.change[k] = numbers.at(i++);
  }
  return {std::move(of.fit), std::move(of.drive)};
}

}  // namespace

nb::tuple kept_rows(
    const io::Scenario& scenario,
    const std::function<void(const io::Scenario&, const std::string& path)>& write) {
  Kept kept;
  write(keeping(scenario, kept), std::string("rows") + extension);
  nb::list groups;
  std::size_t width = 0;
  for (const io::ColumnGroup& group : kept.groups) {
    nb::list columns;
    for (const io::Column& column : group.columns)
      columns.append(nb::make_tuple(column.name, column.unit));
    groups.append(nb::make_tuple(group.name, columns));
    width += group.columns.size();
  }
  Result table({kept.rows.size() / width, width});
  std::copy(kept.rows.begin(), kept.rows.end(), table.at(0));
  return nb::make_tuple(groups, table.take(), nb::cast(kept.notes));
}

void bind_scenario_fit(nb::module_& m) {
  bind_fit_of<io::FitReport>(m, "_ScenarioFit")
      .def("problem", problem_at, "solution"_a, "scaled"_a, "epoch"_a.none())
      .def("raw", [](const ScenarioFit& f,
                     std::size_t k) { return solution_dict(f.report.solutions.at(k).raw); })
      .def("scaled", [](const ScenarioFit& f, std::size_t k) -> nb::object {
        const io::FoundSpin& found = f.report.solutions.at(k);
        if (!found.scaled) return nb::none();
        return solution_dict(*found.scaled);
      });
  m.def("_spin_problem_parts", parts_of);
  m.def("_spin_problem_of", problem_of);
  m.def("_fit_scenario", fit_of, "scenario"_a, "threads"_a, "progress"_a.none());
  m.def("_hardware_threads", ensemble::hardware_threads);
  m.def("_simulate", [](const io::Scenario& scenario, nb::handle folder, bool may_replace) {
    return io::write_simulation(scenario, path_text(folder), may_replace);
  });
}

}  // namespace polhode::python
