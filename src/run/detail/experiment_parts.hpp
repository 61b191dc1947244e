// SPDX-License-Identifier: MIT
// What runs, describes and cites an experiment: one overload of each function for each kind. The
// functions of the public headers visit the variant with them (run/experiment_parts.cpp), so that
// the compiler names each one that a new kind lacks.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/run.hpp"
#include "polhode/run/summary.hpp"
#include "run/detail/run_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

RowLayout row_layout(const Rotation& rotation, const Scenario& scenario);
std::vector<ColumnGroup> row_groups(const Rotation& rotation, const Scenario& scenario);
RunFacts run_facts(const Rotation& rotation, const Scenario& scenario);
std::string propagation_text(const Rotation& rotation, const Units& units);
// What outputs say of it, in addition to text, title and citations.
std::vector<std::string> notes_of(const Rotation& rotation, const Scenario& scenario);
// The words by which citations knows what it is made of.
std::vector<std::string> cited_parts(const Rotation& rotation);
// As run_rows; it has [time].
RunReport rows_of(const Rotation& rotation, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control);
std::vector<SummaryLine> summary(const Rotation& rotation, const Scenario& scenario,
                                 const FreeRotation& motion);
std::vector<SummaryLine> report_lines(const Rotation& rotation, const Scenario& scenario,
                                      const RunReport& report, const std::string& events);

// This visits.
std::vector<std::string> cited_parts(const Scenario& scenario);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
