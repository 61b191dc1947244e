// SPDX-License-Identifier: MIT
// Histograms of an ensemble: one or two numbers of each member, at each time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ensemble/accumulator.hpp"
#include "polhode/error.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

static_assert(ensemble::Accumulator<MemberHistogram>);
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// From 0, which lies below all bins, to count() + 1.
void append_edges(const ensemble::Bins& bins, std::size_t bin, std::vector<double>& row) {
  const std::span<const double> edges = bins.edges();
  row.push_back(bin == 0 ? -infinity : edges[bin - 1]);
  row.push_back(bin == edges.size() ? infinity : edges[bin]);
}

void append_count(std::int64_t count, std::int64_t of, std::vector<double>& row) {
  row.push_back(static_cast<double>(count));
  row.push_back(of == 0 ? nan : static_cast<double>(count) / static_cast<double>(of));
}

void append_cells(const ensemble::Histogram& of, double time, std::vector<double>& rows) {
  for (std::size_t bin = 0; bin <= of.bins().count() + 1; ++bin) {
    rows.push_back(time);
    append_edges(of.bins(), bin, rows);
    append_count(of.count(bin), of.count(), rows);
  }
}

void append_cells(const ensemble::Histogram2D& of, double time, std::vector<double>& rows) {
  for (std::size_t x = 0; x <= of.x_bins().count() + 1; ++x)
    for (std::size_t y = 0; y <= of.y_bins().count() + 1; ++y) {
      rows.push_back(time);
      append_edges(of.x_bins(), x, rows);
      append_edges(of.y_bins(), y, rows);
      append_count(of.count(x, y), of.count(), rows);
    }
}

// Of one axis of numbers that were kept, over their range.
ensemble::Bins own_bins(const std::vector<double>& numbers, std::size_t axis, std::size_t axes,
                        int count) {
  double least = infinity, greatest = -infinity;
  for (std::size_t k = axis; k < numbers.size(); k += axes) {
    least = std::min(least, numbers[k]);
    greatest = std::max(greatest, numbers[k]);
  }
  return least <= greatest ? bins_over(least, greatest, 0.0, count)
                           : ensemble::Bins::linear(0.0, 1.0, count);
}

}  // namespace

ensemble::Bins bins_over(double least, double greatest, double margin, int count) {
  const double size = std::max(std::fabs(least), std::fabs(greatest));
  const double finest = 4.0 * std::numeric_limits<double>::epsilon() * size * count;
  const double beyond = margin == 0.0 && greatest - least > finest
                            ? 0.0
                            : std::max(margin * (greatest - least), size > 0.0 ? finest : 1.0);
  return ensemble::Bins::linear(least - beyond, greatest + beyond, count);
}

MemberHistogram::MemberHistogram(std::span<const ensemble::Bins> bins)
    : of_(bins.size() == 1 ? Of(ensemble::Histogram(bins[0]))
                           : Of(ensemble::Histogram2D(bins[0], bins[1]))) {}

MemberHistogram MemberHistogram::kept(std::size_t axes) { return MemberHistogram(Kept{axes, {}}); }

std::size_t MemberHistogram::axes() const {
  const Kept* const kept = std::get_if<Kept>(&of_);
  return kept != nullptr ? kept->axes : std::holds_alternative<ensemble::Histogram>(of_) ? 1 : 2;
}

void MemberHistogram::add(std::int64_t member, std::span<const double> x) {
  if (!std::all_of(x.begin(), x.end(), [](double one) { return std::isfinite(one); })) return;
  if (Kept* const kept = std::get_if<Kept>(&of_))
    kept->numbers.insert(kept->numbers.end(), x.begin(), x.end());
  else if (ensemble::Histogram* const one = std::get_if<ensemble::Histogram>(&of_))
    one->add(member, x[0]);
  else
    std::get<ensemble::Histogram2D>(of_).add(member, x[0], x[1]);
}

void MemberHistogram::merge(const MemberHistogram& later) {
  if (later.of_.index() != of_.index() || later.axes() != axes())
    throw DomainError("MemberHistogram::merge: got another shape; expected the same");
  if (Kept* const kept = std::get_if<Kept>(&of_)) {
    const std::vector<double>& more = std::get<Kept>(later.of_).numbers;
    kept->numbers.insert(kept->numbers.end(), more.begin(), more.end());
  } else if (ensemble::Histogram* const one = std::get_if<ensemble::Histogram>(&of_)) {
    one->merge(std::get<ensemble::Histogram>(later.of_));
  } else {
    std::get<ensemble::Histogram2D>(of_).merge(std::get<ensemble::Histogram2D>(later.of_));
  }
}

void MemberHistogram::append_rows(double time, int bins, std::vector<double>& rows) const {
  if (const ensemble::Histogram* const one = std::get_if<ensemble::Histogram>(&of_))
    return append_cells(*one, time, rows);
  if (const ensemble::Histogram2D* const two = std::get_if<ensemble::Histogram2D>(&of_))
    return append_cells(*two, time, rows);
  const auto& [axes, numbers] = std::get<Kept>(of_);
  std::vector<ensemble::Bins> over;
  for (std::size_t axis = 0; axis < axes; ++axis)
    over.push_back(own_bins(numbers, axis, axes, bins));
  MemberHistogram counted(over);
  for (std::size_t k = 0; k < numbers.size(); k += axes)
    counted.add(0, std::span(numbers).subspan(k, axes));
  counted.append_rows(time, bins, rows);
}

std::vector<double> MemberHistogram::numbers() const {
  if (const Kept* const kept = std::get_if<Kept>(&of_)) return kept->numbers;
  if (const ensemble::Histogram* const one = std::get_if<ensemble::Histogram>(&of_))
    return one->numbers();
  return std::get<ensemble::Histogram2D>(of_).numbers();
}

MemberHistogram MemberHistogram::restored(std::span<const double> numbers) const {
  if (const ensemble::Histogram* const one = std::get_if<ensemble::Histogram>(&of_))
    return MemberHistogram(one->restored(numbers));
  if (const ensemble::Histogram2D* const two = std::get_if<ensemble::Histogram2D>(&of_))
    return MemberHistogram(two->restored(numbers));
  if (numbers.size() % axes() != 0)
    throw DomainError("MemberHistogram::restored: got " + std::to_string(numbers.size()) +
                      " numbers; expected a multiple of " + std::to_string(axes()));
  return MemberHistogram(Kept{axes(), {numbers.begin(), numbers.end()}});
}

namespace {

constexpr double histogram_margin = 0.1;  // of bins, in ranges of the pilots, on either side

}  // namespace

std::size_t StatisticsFrame::histogram_times(std::size_t histogram) const {
  return ensemble_.plan().histograms[histogram].at_all_times ? times_.size() : 1;
}

std::size_t StatisticsFrame::histogram_axes() const {
  std::size_t axes = 0;
  for (std::size_t h = 0; h < columns_.histograms.size(); ++h)
    axes += histogram_times(h) * columns_.histograms[h].size();
  return axes;
}

std::size_t StatisticsFrame::first_axis(std::size_t histogram, std::size_t time) const {
  std::size_t axes = time * columns_.histograms[histogram].size();
  for (std::size_t h = 0; h < histogram; ++h)
    axes += histogram_times(h) * columns_.histograms[h].size();
  return axes;
}

double StatisticsFrame::histogram_bytes() const {
  // a count, and at the end a row of the file: t, two edges of each column, members, part
  const auto of_cell = [](const EnsembleHistogram& one) {
    return 8.0 * (4.0 + 2.0 * static_cast<double>(one.axes.size()));
  };
  const double rows = static_cast<double>(row_times(ensemble_.scenario())->size());
  double bytes = 0.0;
  for (const EnsembleHistogram& one : ensemble_.plan().histograms) {
    double cells = 1.0;
    for (const EnsembleHistogram::Axis& axis : one.axes)
      cells *= static_cast<double>(axis.bins + 2);
    bytes += of_cell(one) * cells * (one.at_all_times ? rows : 1.0);
  }
  return bytes;
}

double StatisticsFrame::on_axis(std::size_t histogram, std::size_t axis,
                                const EnsembleMember& member, std::size_t rows,
                                std::size_t epoch) const {
  const MemberNumber& of = columns_.histograms[histogram][axis];
  const double x = number(of, member, rows, epoch);
  if (!of.is_angle) return x;
  if (const auto& bounds = ensemble_.plan().histograms[histogram].axes[axis].bounds) {
    const double beyond = x - bounds->lowest;
    const double within = bounds->lowest + (beyond - turn_ * std::floor(beyond / turn_));
    return within <= bounds->highest ? within : x;
  }
  const auto same = std::ranges::find_if(columns_.numbers,
                                         [&](const auto& one) { return one.place == of.place; });
  return same == columns_.numbers.end() ? x : number(*same, epoch, x);
}

void StatisticsFrame::add_to_axes(const EnsembleMember& member) {
  const std::size_t rows = epochs_of(member);
  for (std::size_t h = 0; h < columns_.histograms.size(); ++h)
    for (std::size_t k = 0; k < histogram_times(h); ++k)
      for (std::size_t axis = 0; axis < columns_.histograms[h].size(); ++axis) {
        const double x = on_axis(h, axis, member, rows, histogram_epoch(h, k));
        if (!std::isfinite(x)) continue;
        Range& range = axis_ranges_[first_axis(h, k) + axis];
        range = {std::min(range.least, x), std::max(range.greatest, x)};
      }
}

MemberHistogram StatisticsFrame::empty_histogram(std::size_t histogram, std::size_t time) const {
  const EnsembleHistogram& of = ensemble_.plan().histograms[histogram];
  if (is_exact() && !of.axes[0].bounds) return MemberHistogram::kept(of.axes.size());
  std::vector<ensemble::Bins> bins;
  for (std::size_t axis = 0; axis < of.axes.size(); ++axis) {
    const auto& [column, count, bounds] = of.axes[axis];
    const auto bin_count = static_cast<int>(count);
    if (bounds) {
      bins.push_back(ensemble::Bins::linear(bounds->lowest, bounds->highest, bin_count));
      continue;
    }
    const auto& [least, greatest] = axis_ranges_[first_axis(histogram, time) + axis];
    bins.push_back(least <= greatest ? bins_over(least, greatest, histogram_margin, bin_count)
                                     : ensemble::Bins::linear(0.0, 1.0, bin_count));
  }
  return MemberHistogram(bins);
}

std::vector<ColumnGroup> StatisticsFrame::histogram_groups(std::size_t histogram) const {
  std::vector<ColumnGroup> groups = {ensemble_.row_groups().front()};
  for (const MemberNumber& axis : columns_.histograms[histogram]) {
    const auto& [name, unit, is_date] = axis.column;
    groups.push_back({name, {{name + "_low", unit}, {name + "_high", unit}}});
  }
  groups.push_back({"members", {{"members", "1"}, {"part", "1"}}});
  return groups;
}

void RowStatistics::add_to_histograms(std::int64_t first, std::span<const EnsembleMember> members,
                                      std::span<const std::size_t> rows) {
  double x[2] = {};
  for (std::size_t h = 0; h < histograms_.size(); ++h)
    for (std::size_t k = 0; k < histograms_[h].size(); ++k)
      for (std::size_t m = 0; m < members.size(); ++m) {
        if (!members[m].failure.empty()) continue;
        const std::size_t axes = histograms_[h][k].axes();
        for (std::size_t axis = 0; axis < axes; ++axis)
          x[axis] = frame_->on_axis(h, axis, members[m], rows[m], frame_->histogram_epoch(h, k));
        histograms_[h][k].add(first + static_cast<std::int64_t>(m), {x, axes});
      }
}

std::vector<EnsembleReport::Histogram> RowStatistics::histograms() const {
  std::vector<EnsembleReport::Histogram> all;
  for (std::size_t h = 0; h < histograms_.size(); ++h) {
    const EnsembleHistogram& of = frame_->ensemble().plan().histograms[h];
    all.push_back({of.name, frame_->histogram_groups(h), {}, {}});
    std::vector<double>& table = all.back().rows;
    for (std::size_t k = 0; k < histograms_[h].size(); ++k)
      histograms_[h][k].append_rows(frame_->time(frame_->histogram_epoch(h, k)),
                                    static_cast<int>(of.axes[0].bins), table);
  }
  return all;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
