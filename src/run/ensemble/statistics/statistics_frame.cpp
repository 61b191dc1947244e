// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "polhode/error.hpp"
#include "run/ensemble/member_columns.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double most_exact = 8e6;         // numbers that are kept, of all columns and times
constexpr double most_bytes = 2147483648;  // of the statistics of one chunk
constexpr double margin = 0.5;             // of bins, in ranges of the pilots, on either side
constexpr std::int64_t part_of_pilots = 8;
constexpr std::int64_t most_for_bins = 1024, most_for_attitudes = 64;  // of them
constexpr std::int64_t most_first_times = 1'000'000;                   // of an event, that are kept
constexpr int event_bins = 10'000;                                     // beyond

bool is_attitude(const ColumnGroup& group) {
  return group.name == "q" || group.name == "q_inertial";
}

}  // namespace

StatisticsColumns::StatisticsColumns(const ScenarioEnsemble& ensemble) {
  const Scenario& scenario = ensemble.scenario();
  const bool is_rotation = std::holds_alternative<Rotation>(scenario.experiment);
  const std::string angle = scenario.units().label(Dimension::angle);
  std::size_t place = 0;
  const auto is_event = [&](const ColumnGroup& group) {
    return std::ranges::any_of(ensemble.events(), [&](const std::string& event) {
      return group.name == first_time_name(event);
    });
  };
  for (const ColumnGroup& group : ensemble.row_groups()) {
    if (is_event(group)) {
      events.push_back({group.columns[0], place++, false});
      continue;
    }
    if (is_rotation && is_attitude(group)) attitudes.push_back({group.name, place});
    for (const Column& column : group.columns) {
      const Number one{column, place++, column.unit == angle};
      if (place == 1 || column.is_date || (is_rotation && is_attitude(group))) continue;
      (is_rotation && column.name == "mode" ? modes : numbers).push_back(one);
    }
  }
  for (const EnsembleFraction& fraction : ensemble.plan().fractions)
    fractions.push_back(*member_number(ensemble, fraction.column));
  for (const EnsembleHistogram& histogram : ensemble.plan().histograms) {
    std::vector<MemberNumber>& axes = histograms.emplace_back();
    for (const EnsembleHistogram::Axis& axis : histogram.axes)
      axes.push_back(*member_number(ensemble, axis.column));
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
  ranges_.assign(is_exact() ? 0 : base_.size(), {unbounded, -unbounded});
  if (!is_exact()) axis_ranges_.assign(histogram_axes(), {unbounded, -unbounded});
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
              static_cast<double>(columns_.attitudes.size()) * of_attitude) +
      histogram_bytes();
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

double StatisticsFrame::number(const MemberNumber& of, const EnsembleMember& member,
                               std::size_t rows, std::size_t epoch) const {
  using enum MemberNumber::From;
  if (of.from == drawn) return member.drawn[of.place];
  if (of.from == event && member.rows.size() >= width_) {
    const double t = member.rows[member.rows.size() - width_ + of.place];
    return (is_backwards() ? t >= times_[epoch] : t <= times_[epoch]) ? t : no_number;
  }
  return epoch < rows ? member.rows[epoch * width_ + of.place] : no_number;
}

bool StatisticsFrame::is_in(std::size_t fraction, double x) const {
  const EnsembleFraction& of = ensemble_.plan().fractions[fraction];
  const auto lies = [&](double number, double turns) {
    return (!of.low || number >= *of.low - turns) && (!of.high || number < *of.high - turns);
  };
  if (!columns_.fractions[fraction].is_angle || !of.low || !of.high) return lies(x, 0.0);
  // The bounds go round, not the number: no angle falls between two intervals by rounding.
  const double within = std::remainder(x, turn_);  // exact
  const double first = std::ceil((*of.low - within) / turn_);
  for (const double turns : {first - 1.0, first, first + 1.0})
    if (lies(within, turns * turn_)) return true;
  return false;
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
  if (!axis_ranges_.empty()) add_to_axes(member);
}

void StatisticsFrame::finish_pilots() {
  for (std::size_t k = 0; k < pilot_attitudes_.size(); ++k)
    references_[k] = pilot_attitudes_[k].mean().value_or(references_[k]);
  pilot_attitudes_.clear();
  const auto count = static_cast<int>(ensemble_.plan().bins);
  bins_.clear();
  if (is_exact()) bins_.push_back(ensemble::Bins::linear(-1.0, 1.0, 1));
  for (const auto& [least, greatest] : ranges_)
    bins_.push_back(least <= greatest ? bins_over(least, greatest, margin, count)
                                      : ensemble::Bins::linear(-1.0, 1.0, count));
}

ensemble::Quantiles StatisticsFrame::empty_quantiles(std::size_t number, std::size_t epoch) const {
  return {is_exact() ? bins_[0] : bins_[number * epochs() + epoch], exact_};
}

ensemble::FirstEvents StatisticsFrame::empty_events() const {
  const double a = is_backwards() ? -times_.front() : times_.front();
  const double b = is_backwards() ? -times_.back() : times_.back();
  return {ensemble::Bins::linear(a, b > a ? b : a + 1.0, event_bins), most_first_times};
}

std::optional<StatisticsFrame::FirstTime> StatisticsFrame::first_time(
    const StatisticsColumns::Number& event, const EnsembleMember& member) const {
  if (member.rows.size() < width_) return std::nullopt;
  const double t = member.rows[member.rows.size() - width_ + event.place];
  if (std::isnan(t)) return std::nullopt;
  const auto before = [&](double a, double b) { return is_backwards() ? a > b : a < b; };
  const auto epoch = std::lower_bound(times_.begin(), times_.end(), t, before);
  return FirstTime{is_backwards() ? -t : t, static_cast<std::size_t>(epoch - times_.begin())};
}

void StatisticsFrame::serialize(Archive& bytes) {
  bytes.all(base_, references_);
  for (std::vector<Range>* const all : {&ranges_, &axis_ranges_}) {
    std::vector<double> ends;
    for (const Range& range : *all) ends.insert(ends.end(), {range.least, range.greatest});
    bytes(ends);
    if (!bytes.reads()) continue;
    if (ends.size() != 2 * all->size()) throw DomainError("a checkpoint of other statistics");
    for (std::size_t k = 0; k < all->size(); ++k) (*all)[k] = {ends[2 * k], ends[2 * k + 1]};
  }
  if (!bytes.reads()) return;
  pilot_attitudes_.clear();
  finish_pilots();
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
