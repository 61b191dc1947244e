// SPDX-License-Identifier: MIT
// The histograms of an ensemble beside its statistics.
#include <algorithm>
#include <cmath>

#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
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
  std::vector<Bins> bins;
  for (std::size_t axis = 0; axis < of.axes.size(); ++axis) {
    const auto& [column, count, bounds] = of.axes[axis];
    const auto bin_count = static_cast<int>(count);
    if (bounds) {
      bins.push_back(Bins::linear(bounds->lowest, bounds->highest, bin_count));
      continue;
    }
    const auto& [least, greatest] = axis_ranges_[first_axis(histogram, time) + axis];
    bins.push_back(least <= greatest ? bins_over(least, greatest, histogram_margin, bin_count)
                                     : Bins::linear(0.0, 1.0, bin_count));
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
}  // namespace v0
}  // namespace polhode
