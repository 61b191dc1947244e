// SPDX-License-Identifier: MIT
// How an experiment from outside is run and described.
#include "polhode/scenario/own_experiment.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/run/detail/rows_maker.hpp"
#include "run/detail/experiment_parts.hpp"
#include "run/detail/summary_lines.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::vector<ColumnGroup> row_groups(const OwnExperiment& own, const Scenario& scenario) {
  const Units& units = scenario.units();
  ColumnGroup columns{own.kind, {}};
  for (const OwnColumn& column : own.columns)
    columns.columns.push_back({column.name, units.label(column.dimension)});
  return {{"t", {{"t", units.time()}}}, std::move(columns)};
}

void add_facts(const OwnExperiment&, RunFacts&) {}

std::string propagation_text(const OwnExperiment& own, const Units& units) {
  return method_in_units(own.method, units);
}

std::vector<std::string> notes_of(const OwnExperiment& own, const Scenario& scenario) {
  std::vector<std::string> notes = {"kind: " + own.kind};
  for (std::string& note : file_notes(scenario)) notes.push_back(std::move(note));
  notes.push_back("method: " + propagation_text(own, scenario.units()));
  return notes;
}

std::vector<std::string> cited_parts(const OwnExperiment&) { return {}; }

RunReport rows_of(const OwnExperiment& own, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control) {
  if (own.maker == nullptr)
    throw DomainError(scenario.document.name + ": kind: got \"" + own.kind +
                      "\" without a model; expected one that own_experiment has made");
  RowWriter writer(row_width(row_groups(own, scenario)), sinks,
                   control.from == nullptr ? 0 : control.from->pushed);
  return completed(own.maker->run(writer, control), writer);
}

std::vector<SummaryLine> summary(const OwnExperiment& own, const Scenario& scenario) {
  Lines lines(scenario.units());
  lines.text("title", "title", scenario.document.title);
  lines.text("kind", "kind", own.kind);
  for (const OwnFact& fact : own.facts)
    lines.number(fact.key, fact.label, fact.number, fact.dimension);
  lines.text("method", "method", propagation_text(own, scenario.units()));
  return lines.take();
}

std::vector<SummaryLine> report_lines(const OwnExperiment&, const Scenario& scenario,
                                      const RunReport& report, const std::string& events) {
  Lines lines(scenario.units());
  add_report(lines, report, "model", events);
  return lines.take();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
