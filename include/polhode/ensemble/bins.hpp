// SPDX-License-Identifier: MIT
// Bins: edges that numbers are counted between: even ones, ones of a fixed relative width, or any.
//
// Equations   edges e_0 < ... < e_n; bin k of n holds e_{k-1} <= x < e_k, the last one e_n too. 0
//             is what lies below e_0, n + 1 what lies above e_n. Logarithmic: e_{k+1} = e_k (1 +
//             a)/(1 - a), a the relative error of a number that is taken for the `middle` 2 e_k
//             e_{k+1}/(e_k + e_{k+1}) of its bin [masson2019].
// Units       those of the numbers.
// Domain      1 to 1e6 bins, finite edges. Copies share their edges.
// Accuracy    a number is compared with the edges themselves, so that its bin is exact; logarithmic
//             edges are products, the same on every machine.
// Errors      DomainError for edges that do not grow or are not finite, too many bins, a relative
//             error outside (0, 1), logarithmic edges of numbers that are not positive.
// Cost        benchmarks/statistics.cpp; 8 bytes an edge, shared.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace ensemble {

class Bins {
 public:
  static Bins linear(double lowest, double highest, int count);
  // Over the numbers given, as those of a first chunk, and `margin` of their range on either side;
  // those that are not finite are passed over. DomainError if none is left; one number alone gets a
  // range about itself.
  static Bins around(std::span<const double> numbers, double margin, int count);
  // From `smallest` to `largest` or just beyond.
  static Bins logarithmic(double relative_error, double smallest, double largest);
  // The same on either side of one bin from -smallest to smallest.
  static Bins signed_logarithmic(double relative_error, double smallest, double largest);
  static Bins of_edges(std::vector<double> edges);

  std::size_t count() const { return shared_->edges.size() - 1; }
  std::span<const double> edges() const { return shared_->edges; }
  // 0 to count() + 1; of NaN count() + 1.
  std::size_t index(double x) const;
  // What a number of bin 1 to count() is taken for.
  double middle(std::size_t bin) const;

  bool operator==(const Bins& other) const;

 private:
  enum class Widths { even, relative, any };
  struct Shared {
    std::vector<double> edges;
    Widths widths;
    double per_width;  // of even ones; of relative ones, of their logarithms
  };
  Bins(std::vector<double> edges, Widths widths);
  std::size_t near(double x) const;

  std::shared_ptr<const Shared> shared_;
};

// LeftOut: the members that a statistic leaves out, because their run failed or their numbers are
// not finite: how many, and the first few by name.
//
// Domain      indices of members, 0 or more.
// Accuracy    exact.
// Errors      DomainError from restored for other numbers than those of numbers().
// Cost        nine numbers.
namespace detail {
class NumberReader;
}  // namespace detail

class LeftOut {
 public:
  static constexpr std::size_t kept = 8;

  LeftOut() = default;
  explicit LeftOut(detail::NumberReader& numbers);  // the next ones, as numbers() wrote them

  void add(std::int64_t member);
  void merge(const LeftOut& later);

  std::int64_t count() const { return count_; }
  // The first of them, at most `kept`, in the order in which they were added.
  std::span<const std::int64_t> first() const;

  std::vector<double> numbers() const;
  LeftOut restored(std::span<const double> numbers) const;

 private:
  std::int64_t count_ = 0;
  std::array<std::int64_t, kept> first_{};
};

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

struct Bounds {
  double lowest, highest;
};
// An estimate with bounds on the exact value; all three are equal if the estimate is exact.
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
  // Confidence interval of the quantile of the distribution, for z standard deviations (1.96 for
  // 95 %). Infinite if there are too few members.
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

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
