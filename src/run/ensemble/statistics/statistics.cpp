// SPDX-License-Identifier: MIT
// The statistics of an ensemble, and the columns of their rows.
#include "run/ensemble/statistics/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "polhode/error.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr int classes = 3;  // short axis, long axis, others

// The column has 1 and -1 for the two modes.
int class_of(double mode) { return mode == 1.0 ? 0 : mode == -1.0 ? 1 : 2; }

// NaN of none: 0 / 0 may have a sign.
double part(std::int64_t count, std::int64_t of) {
  return of == 0 ? no_value : static_cast<double>(count) / static_cast<double>(of);
}

Quaternion attitude_at(const double* q) { return {q[0], q[1], q[2], q[3]}; }

template <class A>
void merge_all(std::vector<A>& all, const std::vector<A>& later) {
  for (std::size_t i = 0; i < all.size(); ++i) all[i].merge(later[i]);
}

// The numbers of one column at one time, with what the bins leave open.
void append(std::vector<double>& row, const ensemble::NumberMoments& moments,
            const ensemble::Quantiles& quantiles, const EnsemblePlan& plan) {
  row.insert(row.end(), {static_cast<double>(moments.count()), moments.mean(0),
                         moments.deviation(0), moments.least(0).value, moments.greatest(0).value});
  double error = quantiles.count() == 0 ? no_value : 0.0;
  for (const double p : plan.quantiles) {
    const ensemble::Bounded found = quantiles.quantile(p);
    row.push_back(found.value);
    error = std::max({error, found.highest - found.value, found.value - found.lowest});
  }
  if (!quantiles.is_exact()) row.push_back(error);
}

void append(std::vector<double>& row, const ensemble::AttitudeSpread& attitude,
            const Units& units) {
  row.push_back(static_cast<double>(attitude.count()));
  const std::optional<ensemble::FrechetMean> found = attitude.frechet();
  if (!found) {
    row.insert(row.end(), 12, no_value);
    return;
  }
  const auto& [q, covariance, error, of_covariance] = *found;
  row.insert(row.end(), {q.w, q.x, q.y, q.z});
  const double unit = units.from_core(1.0, Dimension::angle);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) row.push_back(covariance.row[i][j] * unit * unit);
  row.insert(row.end(), {error * unit, of_covariance * unit * unit});
}

}  // namespace

RowStatistics::RowStatistics(const StatisticsFrame& frame) : frame_(&frame) {
  const StatisticsColumns& columns = frame.columns();
  const std::size_t epochs = frame.epochs();
  counts_.assign(epochs, 0);
  moments_.assign(columns.numbers.size() * epochs, ensemble::NumberMoments(1));
  quantiles_.reserve(moments_.size());
  for (std::size_t i = 0; i < columns.numbers.size(); ++i)
    for (std::size_t e = 0; e < epochs; ++e) quantiles_.push_back(frame.empty_quantiles(i, e));
  attitudes_.reserve(columns.attitudes.size() * epochs);
  for (std::size_t i = 0; i < columns.attitudes.size(); ++i)
    for (std::size_t e = 0; e < epochs; ++e) attitudes_.emplace_back(frame.reference(i, e));
  modes_.assign(columns.modes.size() * epochs, ensemble::Fractions(classes));
  parts_.assign(columns.fractions.size() * epochs, ensemble::Fractions(2));
  events_.assign(columns.events.size(), frame.empty_events());
  happened_.assign(columns.events.size() * epochs, 0);
  for (std::size_t h = 0; h < columns.histograms.size(); ++h)
    for (std::size_t k = 0; k < frame.histogram_times(h); ++k) {
      if (k == 0) histograms_.emplace_back();
      histograms_[h].push_back(frame.empty_histogram(h, k));
    }
}

// Time after time, so that what is kept of one stays near while all members come.
void RowStatistics::add(std::int64_t first, std::span<const EnsembleMember> members) {
  const StatisticsColumns& columns = frame_->columns();
  const std::size_t epochs = frame_->epochs(), width = frame_->width();
  std::vector<std::size_t> rows;
  for (const EnsembleMember& member : members)
    rows.push_back(member.failure.empty() ? frame_->epochs_of(member) : 0);
  const auto each_at = [&](std::size_t e, std::size_t place, const auto& use) {
    for (std::size_t m = 0; m < members.size(); ++m)
      if (e < rows[m])
        use(first + static_cast<std::int64_t>(m), members[m].rows[e * width + place]);
  };
  for (std::size_t e = 0; e < epochs; ++e)
    counts_[e] += std::count_if(rows.begin(), rows.end(), [&](std::size_t n) { return e < n; });
  for (std::size_t i = 0; i < columns.numbers.size(); ++i)
    for (std::size_t e = 0; e < epochs; ++e) {
      ensemble::NumberMoments& moments = moments_[i * epochs + e];
      ensemble::Quantiles& quantiles = quantiles_[i * epochs + e];
      each_at(e, columns.numbers[i].place, [&](std::int64_t member, double number) {
        const double x = frame_->number(columns.numbers[i], e, number);
        moments.add(member, {&x, 1});
        quantiles.add(member, x);
      });
    }
  for (std::size_t i = 0; i < columns.modes.size(); ++i)
    for (std::size_t e = 0; e < epochs; ++e)
      each_at(e, columns.modes[i].place, [&](std::int64_t member, double mode) {
        modes_[i * epochs + e].add(member, class_of(mode));
      });
  if (!columns.attitudes.empty()) add_attitudes(first, members, rows);
  add_fractions(first, members, rows);
  add_events(first, members);
  add_to_histograms(first, members, rows);
}

void RowStatistics::add_fractions(std::int64_t first, std::span<const EnsembleMember> members,
                                  std::span<const std::size_t> rows) {
  const std::vector<MemberNumber>& fractions = frame_->columns().fractions;
  for (std::size_t i = 0; i < fractions.size(); ++i)
    for (std::size_t e = 0; e < frame_->epochs(); ++e)
      for (std::size_t m = 0; m < members.size(); ++m) {
        if (!members[m].failure.empty()) continue;
        const double x = frame_->number(fractions[i], members[m], rows[m], e);
        if (std::isnan(x)) continue;
        parts_[i * frame_->epochs() + e].add(first + static_cast<std::int64_t>(m),
                                             frame_->is_in(i, x) ? 1 : 0);
      }
}

// Members whose run has ended count on: what had not happened to them never does.
void RowStatistics::add_events(std::int64_t first, std::span<const EnsembleMember> members) {
  const std::vector<StatisticsColumns::Number>& events = frame_->columns().events;
  for (std::size_t i = 0; i < events.size(); ++i)
    for (std::size_t m = 0; m < members.size(); ++m) {
      if (!members[m].failure.empty()) continue;
      const auto time = frame_->first_time(events[i], members[m]);
      if (!time) {
        events_[i].add_without();
        continue;
      }
      events_[i].add(first + static_cast<std::int64_t>(m), time->along);
      if (time->epoch < frame_->epochs()) ++happened_[i * frame_->epochs() + time->epoch];
    }
}

// In the lanes of the processor where all members have all times.
void RowStatistics::add_attitudes(std::int64_t first, std::span<const EnsembleMember> members,
                                  std::span<const std::size_t> rows) {
  const std::size_t epochs = frame_->epochs(), width = frame_->width();
  const bool all =
      std::all_of(rows.begin(), rows.end(), [&](std::size_t n) { return n == epochs; });
  std::vector<RotorState> states(all ? members.size() * epochs : 0);
  for (std::size_t i = 0; i < frame_->columns().attitudes.size(); ++i) {
    const std::size_t place = frame_->columns().attitudes[i].place;
    const std::span<ensemble::AttitudeSpread> kept =
        std::span(attitudes_).subspan(i * epochs, epochs);
    for (std::size_t m = 0; m < members.size(); ++m)
      for (std::size_t e = 0; e < rows[m]; ++e) {
        const Quaternion q = attitude_at(members[m].rows.data() + e * width + place);
        if (all)
          states[m * epochs + e].q = q;
        else
          kept[e].add(first + static_cast<std::int64_t>(m), q);
      }
    if (all) ensemble::add_rows(kept, first, states);
  }
}

void RowStatistics::merge(const RowStatistics& later) {
  for (std::size_t e = 0; e < counts_.size(); ++e) counts_[e] += later.counts_[e];
  merge_all(moments_, later.moments_);
  merge_all(quantiles_, later.quantiles_);
  merge_all(attitudes_, later.attitudes_);
  merge_all(modes_, later.modes_);
  merge_all(parts_, later.parts_);
  merge_all(events_, later.events_);
  for (std::size_t k = 0; k < happened_.size(); ++k) happened_[k] += later.happened_[k];
  for (std::size_t h = 0; h < histograms_.size(); ++h)
    merge_all(histograms_[h], later.histograms_[h]);
}

std::vector<double> RowStatistics::rows() const {
  const StatisticsColumns& columns = frame_->columns();
  const EnsemblePlan& plan = frame_->ensemble().plan();
  const Units& units = frame_->ensemble().scenario().units();
  const std::size_t epochs = frame_->epochs();
  std::vector<double> all;
  std::vector<std::int64_t> happened(events_.size(), 0);  // by now
  for (std::size_t e = 0; e < epochs; ++e) {
    all.insert(all.end(), {frame_->time(e), static_cast<double>(counts_[e])});
    for (std::size_t i = 0; i < columns.attitudes.size(); ++i)
      append(all, attitudes_[i * epochs + e], units);
    for (std::size_t i = 0; i < columns.numbers.size(); ++i) {
      const std::size_t at = i * epochs + e;
      append(all, moments_[at], quantiles_[at], plan);
      if (!frame_->is_exact() && quantiles_[at].is_exact())
        all.push_back(no_value);  // of no number
    }
    for (std::size_t i = 0; i < columns.modes.size(); ++i)
      for (int k = 0; k < classes; ++k) all.push_back(modes_[i * epochs + e].fraction(k));
    for (std::size_t i = 0; i < columns.fractions.size(); ++i) {
      const ensemble::Fractions& of = parts_[i * epochs + e];
      all.insert(all.end(), {static_cast<double>(of.count()), of.fraction(1)});
    }
    for (std::size_t i = 0; i < events_.size(); ++i) {
      happened[i] += happened_[i * epochs + e];
      all.push_back(part(happened[i], events_[i].count()));
    }
  }
  return all;
}

std::vector<EnsembleReport::FirstTimes> RowStatistics::first_times() const {
  std::vector<EnsembleReport::FirstTimes> all;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const ensemble::FirstEvents& of = events_[i];
    EnsembleReport::FirstTimes found{
        frame_->ensemble().events()[i], part(of.times().count(), of.count()), {}};
    for (const double p : frame_->ensemble().plan().quantiles) {
      const std::optional<ensemble::Bounded> time = of.count() > 0 ? of.time_of(p) : std::nullopt;
      const double t = time ? time->value : no_value;
      found.times.push_back(frame_->is_backwards() ? -t : t);
    }
    all.push_back(std::move(found));
  }
  return all;
}

void RowStatistics::serialize(Archive& bytes) {
  bytes(counts_);
  serialize_all(bytes, moments_);
  serialize_all(bytes, quantiles_);
  serialize_all(bytes, attitudes_);
  serialize_all(bytes, modes_);
  serialize_all(bytes, parts_);
  serialize_all(bytes, events_);
  bytes(happened_);
  for (std::vector<MemberHistogram>& of_times : histograms_) serialize_all(bytes, of_times);
}

namespace {

const char* const axis_pairs[] = {"11", "12", "13", "22", "23", "33"};

// "P_phi_p5", "P_phi_p97.5"
std::string quantile_name(const std::string& column, double p) {
  return column + fmt::format("_p{:.10g}", 100.0 * p);
}

// "-90 <= g < 90"
std::string fraction_text(const EnsembleFraction& of) {
  return (of.low ? polhode::detail::number_text(*of.low) + " <= " : "") + of.column +
         (of.high ? " < " + polhode::detail::number_text(*of.high) : "");
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
}  // namespace io
}  // namespace v0
}  // namespace polhode
