// SPDX-License-Identifier: MIT
// What runs, describes and cites an experiment: one overload of each function for each kind. The
// functions of the public headers visit the variant with them (run/experiments.cpp), so that
// the compiler names each one that a new kind lacks.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/detail/run_state.hpp"
#include "polhode/run/run.hpp"
#include "polhode/run/summary.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Of a rotation.
RowLayout row_layout(const Rotation& rotation, const Scenario& scenario);
std::vector<ColumnGroup> row_groups(const Rotation& rotation, const Scenario& scenario);
// What it adds to the facts of its rows.
void add_facts(const Rotation& rotation, RunFacts& facts);
std::string propagation_text(const Rotation& rotation, const Units& units);
// What outputs say of it, in addition to text, title and citations.
std::vector<std::string> notes_of(const Rotation& rotation, const Scenario& scenario);
// The words by which citations knows what it is made of.
std::vector<std::string> cited_parts(const Rotation& rotation);
// As run_rows; it has [time].
RunReport rows_of(const Rotation& rotation, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control);
std::vector<SummaryLine> summary(const Rotation& rotation, const Scenario& scenario);
std::vector<SummaryLine> report_lines(const Rotation& rotation, const Scenario& scenario,
                                      const RunReport& report, const std::string& events);

// The same of a spin axis over ages.
std::vector<ColumnGroup> row_groups(const Obliquity& of, const Scenario& scenario);
void add_facts(const Obliquity& of, RunFacts& facts);
std::string propagation_text(const Obliquity& of, const Units& units);
std::vector<std::string> notes_of(const Obliquity& of, const Scenario& scenario);
std::vector<std::string> cited_parts(const Obliquity& of);
RunReport rows_of(const Obliquity& of, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control);
std::vector<SummaryLine> summary(const Obliquity& of, const Scenario& scenario);
std::vector<SummaryLine> report_lines(const Obliquity& of, const Scenario& scenario,
                                      const RunReport& report, const std::string& events);

// The same of an experiment from outside.
std::vector<ColumnGroup> row_groups(const CustomExperiment& own, const Scenario& scenario);
void add_facts(const CustomExperiment& own, RunFacts& facts);
std::string propagation_text(const CustomExperiment& own, const Units& units);
std::vector<std::string> notes_of(const CustomExperiment& own, const Scenario& scenario);
std::vector<std::string> cited_parts(const CustomExperiment& own);
RunReport rows_of(const CustomExperiment& own, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control);
std::vector<SummaryLine> summary(const CustomExperiment& own, const Scenario& scenario);
std::vector<SummaryLine> report_lines(const CustomExperiment& own, const Scenario& scenario,
                                      const RunReport& report, const std::string& events);

// What kinds share: the files that the scenario names, and a method with the unit of its step.
std::vector<std::string> file_notes(const Scenario& scenario);
std::string method_in_units(const Method& method, const Units& units);

// This visits.
std::vector<std::string> cited_parts(const Scenario& scenario);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
