// SPDX-License-Identifier: MIT
// AngleMoments: circular mean, resultant and deviation of an angle of each member. (What an
// unwrapped angle does is for NumberMoments.)
//
// Equations   R e^{i mean} = (1/n) sum of e^{i a}; circular deviation sqrt(-2 ln R).
// Units       rad; the mean in (-pi, pi].
// Domain      any angles; those that are not finite are left out and named. Angles all around have
//             no mean: it is told where R is 0.9 or more, or exp(-n R^2) below 1/1000, the chance
//             of such an R of as many angles at random (Rayleigh). No member: R is NaN.
// Accuracy    budget angle_moments_eps: R and the mean to tens of eps of thousands, n eps at the
//             very worst; the deviation of angles within less than 1e-7 has no digits. The same
//             bits on every processor.
// Errors      DomainError as an Accumulator.
// Cost        benchmarks/statistics.cpp; three numbers, and those of LeftOut.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "polhode/ensemble/bins.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

class AngleMoments {
 public:
  AngleMoments() = default;

  void add(std::int64_t member, double angle);
  void merge(const AngleMoments& later);

  std::int64_t count() const { return count_; }  // without those left out
  const LeftOut& left_out() const { return left_out_; }

  std::optional<double> mean() const;
  double resultant() const;
  double deviation() const;

  std::vector<double> numbers() const;
  AngleMoments restored(std::span<const double> numbers) const;

 private:
  double cosine_ = 0.0, sine_ = 0.0;  // sums
  std::int64_t count_ = 0;
  LeftOut left_out_;
};

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
