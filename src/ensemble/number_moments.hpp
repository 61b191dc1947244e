// SPDX-License-Identifier: MIT
// NumberMoments: mean and covariance of several numbers of each member, and the members where each
// is least and greatest.
//
// Equations   with each member, d = x - mean, mean += d / n, S_ij += d_i (x_j - mean_j) (Welford);
//             of two parts, S = S_a + S_b + d d^T n_a n_b / n, d = mean_b - mean_a, and mean =
//             mean_a + d n_b / n [chan1983]. Covariance S / (n - 1).
// Units       those of the numbers.
// Domain      any numbers whose squares are in range. A member with a number that is not finite is
//             left out and named. Of several members with the least number the first is told. No
//             member: means, minima and maxima are NaN, of member -1; fewer than two: so are
//             covariances.
// Accuracy    budget number_moments_eps: of 20,000 members in chunks of 1000 the relative error of
//             a variance is below 2 eps sqrt(1 + (mean / deviation)^2), of a covariance the same of
//             the product of the deviations; 23 in one chunk, and n eps at the very worst.
// Errors      DomainError for a size below 1, for other than `size` numbers, an index outside, and
//             as an Accumulator.
// Cost        benchmarks/statistics.cpp; (size^2 + 11 size) / 2 + 1 numbers, and those of LeftOut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "polhode/ensemble/bins.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

// A number and the member that has it.
struct Extreme {
  double value;
  std::int64_t member;
};

class NumberMoments {
 public:
  explicit NumberMoments(int size);

  void add(std::int64_t member, std::span<const double> numbers);
  void merge(const NumberMoments& later);

  int size() const { return size_; }
  std::int64_t count() const { return count_; }  // without those left out
  const LeftOut& left_out() const { return left_out_; }

  double mean(int i) const;
  double covariance(int i, int j) const;
  double deviation(int i) const;  // sqrt(covariance(i, i))
  Extreme least(int i) const;
  Extreme greatest(int i) const;

  std::vector<double> numbers() const;
  NumberMoments restored(std::span<const double> numbers) const;

 private:
  std::size_t checked(const char* function, int i) const;
  // Means, then the lower triangle of S row by row.
  double* products() { return sums_.data() + size_; }
  const double* products() const { return sums_.data() + size_; }

  int size_;
  std::int64_t count_ = 0;
  std::vector<double> sums_;
  std::vector<Extreme> extremes_;  // least and greatest of each
  LeftOut left_out_;
};

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
