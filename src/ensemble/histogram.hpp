// SPDX-License-Identifier: MIT
// Histogram and Histogram2D: how many members have their number, or pair of numbers, in each bin.
//
// Units       those of the bins.
// Domain      any numbers; those below and above all bins are counted (bins 0 and count() + 1),
//             those that are not finite left out and named: a pair by either.
// Accuracy    exact, in any order; counts up to 2^53.
// Errors      DomainError for a bin that is not there, more than 1e8 cells, and as an Accumulator.
// Cost        that of Bins; eight bytes a cell. Runs of empty cells are one number in numbers().
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "polhode/ensemble/bins.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

class Histogram {
 public:
  explicit Histogram(Bins bins);

  void add(std::int64_t member, double x);
  void merge(const Histogram& later);

  const Bins& bins() const { return bins_; }
  std::int64_t count() const { return count_; }  // all but those left out
  std::int64_t count(std::size_t bin) const;     // 0 to bins().count() + 1
  const LeftOut& left_out() const { return left_out_; }

  std::vector<double> numbers() const;
  Histogram restored(std::span<const double> numbers) const;

 private:
  Bins bins_;
  std::int64_t count_ = 0;
  std::vector<std::int64_t> cells_;
  LeftOut left_out_;
};

class Histogram2D {
 public:
  Histogram2D(Bins x, Bins y);

  void add(std::int64_t member, double x, double y);
  void merge(const Histogram2D& later);

  const Bins& x_bins() const { return x_; }
  const Bins& y_bins() const { return y_; }
  std::int64_t count() const { return count_; }
  std::int64_t count(std::size_t x_bin, std::size_t y_bin) const;
  const LeftOut& left_out() const { return left_out_; }

  std::vector<double> numbers() const;
  Histogram2D restored(std::span<const double> numbers) const;

 private:
  Bins x_, y_;
  std::int64_t count_ = 0;
  std::vector<std::int64_t> cells_;  // those of one x bin side by side
  LeftOut left_out_;
};

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
