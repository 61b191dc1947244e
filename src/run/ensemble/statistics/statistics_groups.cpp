// SPDX-License-Identifier: MIT
// What the rows of the statistics are, and what outputs say of them.
#include <fmt/format.h>

#include <algorithm>

#include "run/ensemble/statistics/statistics.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

const char* const axis_pairs[] = {"11", "12", "13", "22", "23", "33"};

// "P_phi_p5", "P_phi_p97.5"
std::string quantile_name(const std::string& column, double p) {
  return column + fmt::format("_p{:.10g}", 100.0 * p);
}

// "-90 <= g < 90"
std::string fraction_text(const EnsembleFraction& of) {
  return (of.low ? number_text(*of.low) + " <= " : "") + of.column +
         (of.high ? " < " + number_text(*of.high) : "");
}

}  // namespace

std::vector<ColumnGroup> StatisticsFrame::groups() const {
  const EnsemblePlan& plan = ensemble_.plan();
  const std::string angle = ensemble_.scenario().units().label(Dimension::angle);
  const std::string squared = angle == "1" ? "1" : angle + "2";
  std::vector<ColumnGroup> all = {ensemble_.row_groups().front(), {"members", {{"members", "1"}}}};
  for (const StatisticsColumns::Attitude& attitude : columns_.attitudes) {
    const std::string& name = attitude.group;
    ColumnGroup group{name, {{name + "_members", "1"}}};
    for (const char* part : {"w", "x", "y", "z"})
      group.columns.push_back({name + "_mean_" + part, "1"});
    for (const char* pair : axis_pairs) group.columns.push_back({name + "_cov_" + pair, squared});
    group.columns.push_back({name + "_mean_error", angle});
    group.columns.push_back({name + "_cov_error", squared});
    all.push_back(std::move(group));
  }
  for (const StatisticsColumns::Number& number : columns_.numbers) {
    const auto& [name, unit, is_date] = number.column;
    ColumnGroup group{name, {{name + "_members", "1"}}};
    for (const char* what : {"_mean", "_deviation", "_least", "_greatest"})
      group.columns.push_back({name + what, unit});
    for (const double p : plan.quantiles) group.columns.push_back({quantile_name(name, p), unit});
    if (!is_exact()) group.columns.push_back({name + "_p_error", unit});
    all.push_back(std::move(group));
  }
  for (const StatisticsColumns::Number& mode : columns_.modes) {
    ColumnGroup group{mode.column.name, {}};
    for (const char* what : {"_SAM", "_LAM", "_other"})
      group.columns.push_back({mode.column.name + what, "1"});
    all.push_back(std::move(group));
  }
  for (const EnsembleFraction& one : plan.fractions)
    all.push_back({one.name + "_part", {{one.name + "_members", "1"}, {one.name + "_part", "1"}}});
  for (const std::string& event : ensemble_.events())
    all.push_back({event + "_part", {{event + "_part", "1"}}});
  return all;
}

std::vector<std::string> StatisticsFrame::notes() const {
  const EnsemblePlan& plan = ensemble_.plan();
  std::vector<std::string> notes;
  if (std::any_of(columns_.numbers.begin(), columns_.numbers.end(),
                  [](const auto& one) { return one.is_angle; }))
    notes.push_back("angles: within half a turn of those of the file's own run");
  if (is_exact())
    notes.push_back("quantiles: of all numbers");
  else
    notes.push_back(fmt::format(
        "quantiles: from {} bins over the range of the first {} members and half of it on either "
        "side; _p_error bounds the error of those of a row",
        plan.bins, pilots()));
  if (!columns_.attitudes.empty())
    notes.push_back(
        "attitudes: Frechet mean, covariance of the rotation vectors about it in body axes; "
        "_mean_error and _cov_error bound what one step leaves, and are infinite where nothing "
        "bounds it");
  for (const EnsembleFraction& one : plan.fractions)
    notes.push_back("fraction: " + one.name + "_part: " + fraction_text(one));
  if (!columns_.events.empty())
    notes.push_back(
        "events: EVENT_part is the part of all members that did not fail to which the event has "
        "happened by then, before or at their end");
  return notes;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
