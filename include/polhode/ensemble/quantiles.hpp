// SPDX-License-Identifier: MIT
// Quantiles: of a number of each member, exact while there are few, else from counts in bins that
// are fixed beforehand, each with the bounds between which it lies.
//
// Equations   x_k the k-th least of n numbers, from 0. Quantile p: x_k + f (x_{k+1} - x_k) with (n
//             - 1) p = k + f [hyndman1996, definition 7]. Bounds for what the members are drawn
//             from, without a word on how it is distributed: how many of them are below its
//             quantile is binomial, n p -+ z sqrt(n p (1 - p)).
// Units       those of the numbers.
// Domain      any numbers; those that are not finite are left out and named. The least and the
//             greatest are kept, so that numbers beyond the bins have bounds, too.
// Accuracy    up to `exact` numbers exact; beyond, `value` takes each for the middle of its bin, so
//             that it is off by half a bin at most, or by the relative error of logarithmic bins
//             (of the larger of the two numbers that a quantile lies between); `lowest` and
//             `highest` are the edges and hold in any case. All is exact in counts, so that nothing
//             depends on the order of members or on chunks.
// Errors      DomainError for p outside [0, 1], z below 0, a rank that is not there, `exact` below
//             0 or above 2^31, and as an Accumulator. Of no number quantiles are NaN.
// Cost        that of Bins; 8 bytes a number while exact, then 8 a bin. A quantile: time in
//             proportion to them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "polhode/ensemble/bins.hpp"
#include "polhode/ensemble/left_out.hpp"

namespace polhode {
inline namespace v0 {

struct Bounds {
  double lowest, highest;
};
// What is told, and the bounds between which the exact one lies: equal while all is exact.
struct Bounded {
  double value, lowest, highest;
};

class Quantiles {
 public:
  Quantiles(Bins bins, std::int64_t exact);

  void add(std::int64_t member, double x);
  void merge(const Quantiles& later);

  const Bins& bins() const { return bins_; }
  std::int64_t count() const { return count_; }  // without those left out
  bool is_exact() const { return cells_.empty(); }
  const LeftOut& left_out() const { return left_out_; }

  Bounded quantile(double p) const;
  // The k-th least number, from 0.
  Bounded ranked(std::int64_t k) const;
  // Which part of the numbers is x or less.
  Bounded part_up_to(double x) const;
  // Where the quantile of what the members are drawn from lies, but for z deviations of chance:
  // z = 1.96 for 95 %. Infinite where there are too few members to say.
  Bounds interval(double p, double z) const;

  std::vector<double> numbers() const;
  Quantiles restored(std::span<const double> numbers) const;

 private:
  void count_in_bins();
  Bounds bounds_of(std::size_t bin) const;

  Bins bins_;
  std::int64_t exact_;
  std::int64_t count_ = 0;
  double least_, greatest_;
  std::vector<double> values_;       // while there are at most exact_
  std::vector<std::int64_t> cells_;  // afterwards
  LeftOut left_out_;
};

}  // namespace v0
}  // namespace polhode
