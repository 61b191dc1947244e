// SPDX-License-Identifier: MIT
// How an experiment from outside of the library is run and described.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/run/detail/integrated_run.hpp"
#include "polhode/run/detail/rows_maker.hpp"
#include "polhode/scenario/experiment_kind.hpp"
#include "run/detail/experiments.hpp"
#include "run/detail/summary_lines.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

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
    if (last < rows.size() && control.due && control.due(t))
      control.keep({t, last}, [](Archive&) {});
    if (control.progress) control.progress(t);
  }
  return report;
}

}  // namespace

std::vector<ColumnGroup> row_groups(const CustomExperiment& own, const Scenario& scenario) {
  const Units& units = scenario.units();
  ColumnGroup columns{own.kind, {}};
  for (const CustomColumn& column : own.columns)
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
  RowWriter writer(row_width(row_groups(own, scenario)), sinks, control.rows);
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
  add_table_values(lines, scenario);
  return lines.take();
}

std::vector<SummaryLine> report_lines(const CustomExperiment& own, const Scenario& scenario,
                                      const RunReport& report, const std::string& events) {
  Lines lines(scenario.units());
  if (!own.formula) add_report(lines, report, "model", events);
  return lines.take();
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
