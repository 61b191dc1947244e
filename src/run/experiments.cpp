// SPDX-License-Identifier: MIT
// Runs and describes the experiment of a scenario: the variant is visited here, and nowhere else in
// this layer.
#include "run/detail/experiments.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/detail/scenario/obliquity.hpp"
#include "polhode/error.hpp"
#include "polhode/run/detail/integrated_run.hpp"
#include "polhode/run/run.hpp"
#include "polhode/version.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

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
    return polhode::detail::number_text(scenario.units().from_core(t, Dimension::time)) + " " +
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

}  // namespace io
}  // namespace v0
}  // namespace polhode
