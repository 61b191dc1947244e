// SPDX-License-Identifier: MIT
#include "run/ensemble/statistics/member_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "polhode/ensemble/accumulator.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

static_assert(Accumulator<MemberHistogram>);
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// From 0, which lies below all bins, to count() + 1.
void append_edges(const Bins& bins, std::size_t bin, std::vector<double>& row) {
  const std::span<const double> edges = bins.edges();
  row.push_back(bin == 0 ? -infinity : edges[bin - 1]);
  row.push_back(bin == edges.size() ? infinity : edges[bin]);
}

void append_count(std::int64_t count, std::int64_t of, std::vector<double>& row) {
  row.push_back(static_cast<double>(count));
  row.push_back(of == 0 ? nan : static_cast<double>(count) / static_cast<double>(of));
}

void append_cells(const Histogram& of, double time, std::vector<double>& rows) {
  for (std::size_t bin = 0; bin <= of.bins().count() + 1; ++bin) {
    rows.push_back(time);
    append_edges(of.bins(), bin, rows);
    append_count(of.count(bin), of.count(), rows);
  }
}

void append_cells(const Histogram2D& of, double time, std::vector<double>& rows) {
  for (std::size_t x = 0; x <= of.x_bins().count() + 1; ++x)
    for (std::size_t y = 0; y <= of.y_bins().count() + 1; ++y) {
      rows.push_back(time);
      append_edges(of.x_bins(), x, rows);
      append_edges(of.y_bins(), y, rows);
      append_count(of.count(x, y), of.count(), rows);
    }
}

// Of one axis of numbers that were kept, over their range.
Bins own_bins(const std::vector<double>& numbers, std::size_t axis, std::size_t axes, int count) {
  double least = infinity, greatest = -infinity;
  for (std::size_t k = axis; k < numbers.size(); k += axes) {
    least = std::min(least, numbers[k]);
    greatest = std::max(greatest, numbers[k]);
  }
  return least <= greatest ? bins_over(least, greatest, 0.0, count) : Bins::linear(0.0, 1.0, count);
}

}  // namespace

Bins bins_over(double least, double greatest, double margin, int count) {
  const double size = std::max(std::fabs(least), std::fabs(greatest));
  const double finest = 4.0 * std::numeric_limits<double>::epsilon() * size * count;
  const double beyond = margin == 0.0 && greatest - least > finest
                            ? 0.0
                            : std::max(margin * (greatest - least), size > 0.0 ? finest : 1.0);
  return Bins::linear(least - beyond, greatest + beyond, count);
}

MemberHistogram::MemberHistogram(std::span<const Bins> bins)
    : of_(bins.size() == 1 ? Of(Histogram(bins[0])) : Of(Histogram2D(bins[0], bins[1]))) {}

MemberHistogram MemberHistogram::kept(std::size_t axes) { return MemberHistogram(Kept{axes, {}}); }

std::size_t MemberHistogram::axes() const {
  const Kept* const kept = std::get_if<Kept>(&of_);
  return kept != nullptr ? kept->axes : std::holds_alternative<Histogram>(of_) ? 1 : 2;
}

void MemberHistogram::add(std::int64_t member, std::span<const double> x) {
  if (!std::all_of(x.begin(), x.end(), [](double one) { return std::isfinite(one); })) return;
  if (Kept* const kept = std::get_if<Kept>(&of_))
    kept->numbers.insert(kept->numbers.end(), x.begin(), x.end());
  else if (Histogram* const one = std::get_if<Histogram>(&of_))
    one->add(member, x[0]);
  else
    std::get<Histogram2D>(of_).add(member, x[0], x[1]);
}

void MemberHistogram::merge(const MemberHistogram& later) {
  if (later.of_.index() != of_.index() || later.axes() != axes())
    throw DomainError("MemberHistogram::merge: got another shape; expected the same");
  if (Kept* const kept = std::get_if<Kept>(&of_)) {
    const std::vector<double>& more = std::get<Kept>(later.of_).numbers;
    kept->numbers.insert(kept->numbers.end(), more.begin(), more.end());
  } else if (Histogram* const one = std::get_if<Histogram>(&of_)) {
    one->merge(std::get<Histogram>(later.of_));
  } else {
    std::get<Histogram2D>(of_).merge(std::get<Histogram2D>(later.of_));
  }
}

void MemberHistogram::append_rows(double time, int bins, std::vector<double>& rows) const {
  if (const Histogram* const one = std::get_if<Histogram>(&of_))
    return append_cells(*one, time, rows);
  if (const Histogram2D* const two = std::get_if<Histogram2D>(&of_))
    return append_cells(*two, time, rows);
  const auto& [axes, numbers] = std::get<Kept>(of_);
  std::vector<Bins> over;
  for (std::size_t axis = 0; axis < axes; ++axis)
    over.push_back(own_bins(numbers, axis, axes, bins));
  MemberHistogram counted(over);
  for (std::size_t k = 0; k < numbers.size(); k += axes)
    counted.add(0, std::span(numbers).subspan(k, axes));
  counted.append_rows(time, bins, rows);
}

std::vector<double> MemberHistogram::numbers() const {
  if (const Kept* const kept = std::get_if<Kept>(&of_)) return kept->numbers;
  if (const Histogram* const one = std::get_if<Histogram>(&of_)) return one->numbers();
  return std::get<Histogram2D>(of_).numbers();
}

MemberHistogram MemberHistogram::restored(std::span<const double> numbers) const {
  if (const Histogram* const one = std::get_if<Histogram>(&of_))
    return MemberHistogram(one->restored(numbers));
  if (const Histogram2D* const two = std::get_if<Histogram2D>(&of_))
    return MemberHistogram(two->restored(numbers));
  if (numbers.size() % axes() != 0)
    throw DomainError("MemberHistogram::restored: got " + std::to_string(numbers.size()) +
                      " numbers; expected a multiple of " + std::to_string(axes()));
  return MemberHistogram(Kept{axes(), {numbers.begin(), numbers.end()}});
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
