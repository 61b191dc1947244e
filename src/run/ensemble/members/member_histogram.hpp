// SPDX-License-Identifier: MIT
// An Accumulator of one or two numbers of each member: in bins that are known beforehand, or kept
// until their range is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/ensemble/histogram.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Even ones over a range and `margin` of it on either side, wide enough for doubles to lie between
// the edges.
Bins bins_over(double least, double greatest, double margin, int count);

class MemberHistogram {
 public:
  // In the bins of one axis or two; without any, numbers of so many axes are kept.
  explicit MemberHistogram(std::span<const Bins> bins);
  static MemberHistogram kept(std::size_t axes);

  std::size_t axes() const;
  // Numbers that are not finite are passed over.
  void add(std::int64_t member, std::span<const double> x);
  void merge(const MemberHistogram& later);

  // Rows of `time`, the edges of each axis, the count and the part of all: the cells of the first
  // bin of the first axis side by side; the first and the last bin are open. Numbers that were kept
  // go into `bins` of each axis over their range.
  void append_rows(double time, int bins, std::vector<double>& rows) const;

  std::vector<double> numbers() const;
  MemberHistogram restored(std::span<const double> numbers) const;

 private:
  struct Kept {
    std::size_t axes;
    std::vector<double> numbers;  // of one member after the other
  };
  using Of = std::variant<Kept, Histogram, Histogram2D>;
  explicit MemberHistogram(Of of) : of_(std::move(of)) {}

  Of of_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
