// SPDX-License-Identifier: MIT
// How each kind of experiment is run and described. The variant of a scenario is visited here, and
// nowhere else in this layer.
#include "run/detail/experiments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/error.hpp"
#include "polhode/run/citations.hpp"
#include "polhode/run/detail/integrated_run.hpp"
#include "polhode/run/detail/rows_maker.hpp"
#include "polhode/scenario/custom_experiment.hpp"
#include "polhode/scenario/obliquity.hpp"
#include "polhode/secular/planet.hpp"
#include "polhode/version.hpp"
#include "run/detail/summary_lines.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {

RowLayout row_layout(const Scenario& scenario) {
  return detail::row_layout(scenario.rotation(), scenario);
}

std::vector<ColumnGroup> row_groups(const Scenario& scenario) {
  return std::visit([&](const auto& kind) { return detail::row_groups(kind, scenario); },
                    scenario.experiment);
}

RunFacts run_facts(const Scenario& scenario) {
  const Units& units = scenario.units();
  RunFacts result{
      .name = scenario.document.title.empty() ? scenario.document.name : scenario.document.title,
      .epoch = {},
      .axes = {},
      .seconds = Units("s").to_core(1.0, units.time(), Dimension::time)};
  std::visit([&](const auto& kind) { detail::add_facts(kind, result); }, scenario.experiment);
  result.rate *= units.to_core(1.0, Dimension::time);
  if (!row_times(scenario)) return result;
  const SaveAt& rows = *row_times(scenario);
  const auto time = [&](std::int64_t k) { return units.from_core(rows[k], Dimension::time); };
  result.first = time(0);
  result.last = time(rows.size() - 1);
  result.rising = rows.is_list() || rows.size() < 2 || rows[0] < rows[1];
  for (std::int64_t k = 1; rows.is_list() && result.rising && k < rows.size(); ++k)
    result.rising = rows[k - 1] < rows[k];
  return result;
}

std::vector<std::string> detail::file_notes(const Scenario& scenario) {
  std::vector<std::string> notes;
  for (const ScenarioFile& file : scenario.document.files)
    notes.push_back("file " + file_note(file));
  return notes;
}

std::string detail::method_in_units(const Method& method, const Units& units) {
  const MethodTraits traits = method_traits(method);
  return traits.text + (traits.step ? " " + units.time() : "");  // the step is its last word
}

std::string propagation_text(const Scenario& scenario) {
  return std::visit(
      [&](const auto& kind) { return detail::propagation_text(kind, scenario.units()); },
      scenario.experiment);
}

namespace {

// That the run goes on behind its last row. Empty: it does not.
std::string stop_note(const Scenario& scenario) {
  const std::optional<SaveAt>& rows = row_times(scenario);
  if (!rows || rows->end() == (*rows)[rows->size() - 1]) return {};
  const auto time = [&](double t) {
    return detail::number_text(scenario.units().from_core(t, Dimension::time)) + " " +
           scenario.units().time();
  };
  return "the last row, at t = " + time((*rows)[rows->size() - 1]) +
         ", lies before stop = " + time(rows->end()) +
         ", since this is not a whole number of steps; the run goes on to stop, or to an event "
         "that "
         "stops it";
}

}  // namespace

Provenance provenance(const Scenario& scenario) {
  Provenance result;
  result.version = version();
  result.title = scenario.document.title;
  result.scenario_name = scenario.document.name;
  result.scenario_text = scenario.document.text;
  result.notes = std::visit([&](const auto& kind) { return detail::notes_of(kind, scenario); },
                            scenario.experiment);
  if (std::string note = stop_note(scenario); !note.empty())
    result.notes.push_back(std::move(note));
  for (const Citation& citation : citations(scenario)) result.citations.emplace_back(citation.text);
  result.run = run_facts(scenario);
  result.options = scenario.output.options;
  return result;
}

std::vector<SummaryLine> summary(const Scenario& scenario) {
  return std::visit([&](const auto& kind) { return detail::summary(kind, scenario); },
                    scenario.experiment);
}

std::vector<SummaryLine> report_lines(const Scenario& scenario, const RunReport& report,
                                      const std::string& events) {
  return std::visit(
      [&](const auto& kind) { return detail::report_lines(kind, scenario, report, events); },
      scenario.experiment);
}

std::vector<std::string> detail::cited_parts(const Scenario& scenario) {
  return std::visit([](const auto& kind) { return detail::cited_parts(kind); },
                    scenario.experiment);
}

RunReport detail::run_rows(const Scenario& scenario, std::span<const std::unique_ptr<Sink>> sinks,
                           const RunControl& control) {
  if (!row_times(scenario))
    throw DomainError(scenario.document.name + ": time: got nothing; expected [time]");
  return std::visit(
      [&](const auto& kind) { return detail::rows_of(kind, scenario, sinks, control); },
      scenario.experiment);
}

RunReport run(const Scenario& scenario, std::span<const std::unique_ptr<Sink>> sinks,
              const Progress& progress) {
  return detail::run_rows(scenario, sinks, {.progress = progress});
}

namespace detail {

// How a spin axis over ages is run and described.

std::vector<ColumnGroup> row_groups(const Obliquity& of, const Scenario& scenario) {
  return SpinLayout(of.columns, scenario.units()).groups();
}

void add_facts(const Obliquity& of, RunFacts& facts) { facts.axes = of.axes; }

std::string propagation_text(const Obliquity& of, const Units& units) {
  return method_in_units(of.method, units);
}

std::vector<std::string> notes_of(const Obliquity& of, const Scenario& scenario) {
  std::vector<std::string> notes = {"kind: obliquity", "axes: " + of.axes,
                                    "orbit: " + of.orbit_text};
  if (!of.planet.empty())
    notes.push_back("planet: " + of.planet + ", unless the scenario says otherwise from " +
                    std::string(planet_spin(of.planet)->source));
  for (std::string& note : file_notes(scenario)) notes.push_back(std::move(note));
  notes.push_back("method: " + propagation_text(of, scenario.units()));
  return notes;
}

std::vector<std::string> cited_parts(const Obliquity& of) {
  std::vector<std::string> parts = {"obliquity"};
  if (!of.planet.empty()) {
    parts.push_back("planet pole");
    parts.push_back("spin of " + of.planet);
  }
  if (of.tides) parts.push_back("tides");
  if (of.insolation) parts.push_back("insolation");
  return parts;
}

RunReport rows_of(const Obliquity& of, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control) {
  const SpinLayout layout(of.columns, scenario.units());
  RowWriter writer(layout.width(), sinks, control.from == nullptr ? 0 : control.from->pushed);
  return with_problem(of, [&]<class Model>(const BasicProblem<Model>& problem) {
    const auto write = [&](std::span<const BasicSample<typename Model::State>> samples,
                           std::span<double> numbers) {
      for (std::size_t k = 0; k < samples.size(); ++k) {
        const double t = samples[k].t;
        layout.write(t, spin_row(tidal_spin(samples[k].s), of.history.at(t), of.insolation),
                     numbers.subspan(k * layout.width(), layout.width()));
      }
    };
    const RowsOfMotion<Model> motion{problem, *of.time, write};
    return completed(integrated_run(motion, writer, control).report, writer);
  });
}

namespace {

// What tides do at t = 0, as fractions per time.
void add_tides(Lines& lines, const Obliquity& of) {
  if (!of.tides) return;
  const TidalSpinOnHistory model(of.history, of.rates, *of.tides);
  const auto change = model.rates(DoubleDouble(0.0), model.values<double>(tidal_spin(of.initial)));
  lines.number("spin_growth", "growth of the spin by tides, of itself", change[3],
               Dimension::growth);
  if (of.tides->satellite > 0.0)
    lines.number("distance_growth", "growth of the satellite's distance", change[4],
                 Dimension::growth);
}

}  // namespace

std::vector<SummaryLine> summary(const Obliquity& of, const Scenario& scenario) {
  Lines lines(scenario.units());
  lines.text("title", "title", scenario.document.title);
  lines.text("kind", "kind", "obliquity");
  lines.text("planet", "planet", of.planet);
  lines.text("orbit", "orbit " + of.orbit, of.orbit_text);
  const OrbitElements start = of.history.at(0.0);
  const SpinAngles angles = spin_angles(of.initial, start);
  const double rate =
      of.rates.torque(0.0, orbit_plane(start).e2) * std::cos(angles.obliquity) - of.rates.geodetic;
  lines.number("obliquity", "obliquity at t = 0", angles.obliquity, Dimension::angle);
  lines.number("precession_constant", "precession constant, on a circle",
               of.rates.star + of.rates.satellites, Dimension::rate);
  lines.number("precession_rate", "precession at t = 0", rate, Dimension::rate);
  if (rate != 0.0)
    lines.number("precession_period", "period of precession then",
                 2.0 * std::numbers::pi / std::fabs(rate), Dimension::time);
  add_tides(lines, of);
  lines.text("method", "method", propagation_text(of, scenario.units()));
  return lines.take();
}

std::vector<SummaryLine> report_lines(const Obliquity&, const Scenario& scenario,
                                      const RunReport& report, const std::string& events) {
  Lines lines(scenario.units());
  add_report(lines, report, "torque", events);
  return lines.take();
}

// How an experiment from outside is run and described.

namespace {

RunReport formula_rows(const CustomExperiment& own, const Units& units, RowWriter& writer,
                       const RunControl& control) {
  constexpr std::int64_t rows_per_block = 1024;
  const SaveAt& rows = *own.rows;
  RunReport report;
  report.outcome.t = rows.end();
  while (writer.rows() < rows.size()) {
    const std::int64_t first = writer.rows();
    const std::int64_t last = std::min(rows.size(), first + rows_per_block);
    writer.push(static_cast<std::size_t>(last - first), [&](std::span<double> numbers) {
      const std::size_t width = own.columns.size() + 1;
      for (std::int64_t k = first; k < last; ++k) {
        const std::span<double> row =
            numbers.subspan(static_cast<std::size_t>(k - first) * width, width);
        row[0] = units.from_core(rows[k], Dimension::time);
        own.formula(rows[k], row.subspan(1));
        for (std::size_t i = 1; i < width; ++i)
          row[i] = units.from_core(row[i], own.columns[i - 1].dimension);
      }
    });
    const double t = rows[last - 1];
    if (last < rows.size() && control.due && control.due(t)) control.keep({t, last, {}});
    if (control.progress) control.progress(t);
  }
  return report;
}

}  // namespace

std::vector<ColumnGroup> row_groups(const CustomExperiment& own, const Scenario& scenario) {
  const Units& units = scenario.units();
  ColumnGroup columns{own.kind, {}};
  for (const OwnColumn& column : own.columns)
    columns.columns.push_back({column.name, units.label(column.dimension)});
  return {{"t", {{"t", units.time()}}}, std::move(columns)};
}

void add_facts(const CustomExperiment&, RunFacts&) {}

std::string propagation_text(const CustomExperiment& own, const Units& units) {
  if (own.formula) return "formula";
  return method_in_units(own.method, units);
}

std::vector<std::string> notes_of(const CustomExperiment& own, const Scenario& scenario) {
  std::vector<std::string> notes = {"kind: " + own.kind};
  for (std::string& note : file_notes(scenario)) notes.push_back(std::move(note));
  notes.push_back("method: " + propagation_text(own, scenario.units()));
  return notes;
}

std::vector<std::string> cited_parts(const CustomExperiment&) { return {}; }

RunReport rows_of(const CustomExperiment& own, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control) {
  if (own.maker == nullptr && !own.formula)
    throw DomainError(scenario.document.name + ": kind: got \"" + own.kind +
                      "\" without a model; expected one that custom_experiment has made");
  RowWriter writer(row_width(row_groups(own, scenario)), sinks,
                   control.from == nullptr ? 0 : control.from->pushed);
  return completed(own.formula ? formula_rows(own, scenario.units(), writer, control)
                               : own.maker->run(writer, control),
                   writer);
}

std::vector<SummaryLine> summary(const CustomExperiment& own, const Scenario& scenario) {
  Lines lines(scenario.units());
  lines.text("title", "title", scenario.document.title);
  lines.text("kind", "kind", own.kind);
  const auto add = [&](const std::vector<SummaryItem>& facts) {
    for (const SummaryItem& fact : facts)
      lines.number(fact.key, fact.label, fact.number, fact.dimension);
  };
  add(own.facts);
  if (own.more_facts) add(own.more_facts());
  lines.text("method", "method", propagation_text(own, scenario.units()));
  return lines.take();
}

std::vector<SummaryLine> report_lines(const CustomExperiment& own, const Scenario& scenario,
                                      const RunReport& report, const std::string& events) {
  Lines lines(scenario.units());
  if (!own.formula) add_report(lines, report, "model", events);
  return lines.take();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
