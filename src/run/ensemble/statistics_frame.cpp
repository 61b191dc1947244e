// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "polhode/error.hpp"
#include "run/ensemble/statistics.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double most_exact = 8e6;         // numbers that are kept, of all columns and times
constexpr double most_bytes = 2147483648;  // of the statistics of one chunk
constexpr double margin = 0.5;             // of bins, in ranges of the pilots, on either side
constexpr std::int64_t part_of_pilots = 8;
constexpr std::int64_t most_for_bins = 1024, most_for_attitudes = 64;  // of them

const char* const axis_pairs[] = {"11", "12", "13", "22", "23", "33"};

bool is_attitude(const ColumnGroup& group) {
  return group.name == "q" || group.name == "q_inertial";
}

// "P_phi_p5", "P_phi_p97.5"
std::string quantile_name(const std::string& column, double p) {
  return column + fmt::format("_p{:.10g}", 100.0 * p);
}

// Wide enough for doubles to lie between the edges.
Bins bins_over(double least, double greatest, int count) {
  const double size = std::max(std::fabs(least), std::fabs(greatest));
  const double finest = 4.0 * std::numeric_limits<double>::epsilon() * size * count;
  const double beyond = std::max(margin * (greatest - least), size > 0.0 ? finest : 1.0);
  return Bins::linear(least - beyond, greatest + beyond, count);
}

}  // namespace

StatisticsColumns::StatisticsColumns(const ScenarioEnsemble& ensemble) {
  const Scenario& scenario = ensemble.scenario();
  const bool is_rotation = std::holds_alternative<Rotation>(scenario.experiment);
  const std::string angle = scenario.units().label(Dimension::angle);
  std::size_t place = 0;
  for (const ColumnGroup& group : ensemble.row_groups()) {
    if (is_rotation && is_attitude(group)) attitudes.push_back({group.name, place});
    for (const Column& column : group.columns) {
      const Number one{column, place++, column.unit == angle};
      if (place == 1 || column.is_date || (is_rotation && is_attitude(group))) continue;
      (is_rotation && column.name == "mode" ? modes : numbers).push_back(one);
    }
  }
}

StatisticsFrame::StatisticsFrame(const ScenarioEnsemble& ensemble)
    : ensemble_(ensemble),
      columns_(ensemble),
      width_(row_width(ensemble.row_groups())),
      turn_(ensemble.scenario().units().from_core(2.0 * std::numbers::pi, Dimension::angle)) {
  const SaveAt& rows = *row_times(ensemble.scenario());
  const double numbers = static_cast<double>(rows.size()) *
                         static_cast<double>(std::max<std::size_t>(columns_.numbers.size(), 1));
  const bool keeps_all = numbers * static_cast<double>(ensemble.size()) <= most_exact;
  exact_ = keeps_all ? ensemble.size() : 0;
  require_room();
  for (std::int64_t k = 0; k < rows.size(); ++k)
    times_.push_back(ensemble.scenario().units().from_core(rows[k], Dimension::time));
  base_.assign(columns_.numbers.size() * epochs(), 0.0);
  references_.assign(columns_.attitudes.size() * epochs(), Quaternion{});
  if (pilots() == 0) return;
  ranges_.assign(is_exact() ? 0 : base_.size(), {infinity, -infinity});
  pilot_attitudes_.resize(references_.size());
}

// Statistics of several chunks are there at a time.
void StatisticsFrame::require_room() const {
  constexpr double of_moments = 300.0, of_attitude = 300.0, of_number = 8.0;
  const double rows = static_cast<double>(row_times(ensemble_.scenario())->size());
  const double of_quantiles =
      of_number * static_cast<double>(is_exact() ? ensemble_.plan().chunk : ensemble_.plan().bins);
  const double bytes =
      rows * (static_cast<double>(columns_.numbers.size()) * (of_moments + of_quantiles) +
              static_cast<double>(columns_.attitudes.size()) * of_attitude);
  if (bytes > most_bytes)
    throw DomainError(ensemble_.scenario().document.name + ": ensemble: statistics of " +
                      fmt::format("{:.3g} rows and {} columns take {:.3g} GB for each chunk", rows,
                                  columns_.numbers.size(), bytes * 1e-9) +
                      "; expected 2 GB at most: fewer rows, columns or bins");
}

std::int64_t StatisticsFrame::pilots() const {
  if (is_exact() && columns_.attitudes.empty()) return 0;
  return std::clamp<std::int64_t>(ensemble_.size() / part_of_pilots, 1,
                                  is_exact() ? most_for_attitudes : most_for_bins);
}

std::size_t StatisticsFrame::epochs_of(const EnsembleMember& member) const {
  const std::size_t rows = std::min(member.rows.size() / width_, epochs());
  if (rows == 0 || member.rows[(rows - 1) * width_] == times_[rows - 1]) return rows;
  return rows - 1;
}

double StatisticsFrame::number(const StatisticsColumns::Number& of, std::size_t epoch,
                               double x) const {
  if (!of.is_angle) return x;
  const auto index = static_cast<std::size_t>(&of - columns_.numbers.data());
  const double base = base_[index * epochs() + epoch];
  return std::fabs(x - base) <= 0.5 * turn_ ? x : base + std::remainder(x - base, turn_);
}

void StatisticsFrame::set_base(const EnsembleMember& base) {
  const std::size_t rows = epochs_of(base);
  for (std::size_t e = 0; e < rows; ++e) {
    const double* const row = base.rows.data() + e * width_;
    for (std::size_t i = 0; i < columns_.numbers.size(); ++i)
      if (std::isfinite(row[columns_.numbers[i].place]))
        base_[i * epochs() + e] = row[columns_.numbers[i].place];
    for (std::size_t i = 0; i < columns_.attitudes.size(); ++i) {
      const double* const q = row + columns_.attitudes[i].place;
      references_[i * epochs() + e] = {q[0], q[1], q[2], q[3]};
    }
  }
}

void StatisticsFrame::add_pilot(std::int64_t index, const EnsembleMember& member) {
  if (!member.failure.empty()) return;
  const std::size_t rows = epochs_of(member);
  for (std::size_t e = 0; e < rows; ++e) {
    const double* const row = member.rows.data() + e * width_;
    for (std::size_t i = 0; i < columns_.numbers.size() && !ranges_.empty(); ++i) {
      const double x = number(columns_.numbers[i], e, row[columns_.numbers[i].place]);
      if (!std::isfinite(x)) continue;
      Range& range = ranges_[i * epochs() + e];
      range = {std::min(range.least, x), std::max(range.greatest, x)};
    }
    for (std::size_t i = 0; i < columns_.attitudes.size(); ++i) {
      const double* const q = row + columns_.attitudes[i].place;
      pilot_attitudes_[i * epochs() + e].add(index, Quaternion{q[0], q[1], q[2], q[3]});
    }
  }
}

void StatisticsFrame::finish_pilots() {
  for (std::size_t k = 0; k < pilot_attitudes_.size(); ++k)
    references_[k] = pilot_attitudes_[k].mean().value_or(references_[k]);
  pilot_attitudes_.clear();
  const auto count = static_cast<int>(ensemble_.plan().bins);
  bins_.clear();
  if (is_exact()) bins_.push_back(Bins::linear(-1.0, 1.0, 1));
  for (const auto& [least, greatest] : ranges_)
    bins_.push_back(least <= greatest ? bins_over(least, greatest, count)
                                      : Bins::linear(-1.0, 1.0, count));
}

Quantiles StatisticsFrame::empty_quantiles(std::size_t number, std::size_t epoch) const {
  return {is_exact() ? bins_[0] : bins_[number * epochs() + epoch], exact_};
}

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
  return notes;
}

void StatisticsFrame::transfer(StateBytes& bytes) {
  bytes.all(base_, references_);
  std::vector<double> ends;
  for (const Range& range : ranges_) ends.insert(ends.end(), {range.least, range.greatest});
  bytes(ends);
  if (!bytes.reads()) return;
  if (ends.size() != 2 * ranges_.size()) throw DomainError("a checkpoint of other statistics");
  for (std::size_t k = 0; k < ranges_.size(); ++k) ranges_[k] = {ends[2 * k], ends[2 * k + 1]};
  pilot_attitudes_.clear();
  finish_pilots();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
