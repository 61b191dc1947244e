// SPDX-License-Identifier: MIT
// AttitudeSpread: the Frechet mean of many attitudes and the covariance of the rotation vectors
// about it, in one pass and in memory that does not grow: moments about a reference attitude near
// the mean.
//
// Equations   q_i = r exp(v_i/2), |v_i| <= pi the angle from the reference r. The Frechet mean x
//             makes the mean of the squared angles least: mean of w_i = 0 with q_i = x exp(w_i/2).
//             From r one Newton step: x = r exp(d/2), (mean of J(v_i)) d = mean of v_i, with J(v) =
//             1 - v^/2 + (1 - h) v^ v^ / |v|^2, h = (|v|/2) cot(|v|/2), v^ = v x. Covariance: w_i =
//             v_i - d + v_i x d / 2, over n - 1 (docs/design/0039-statistics.md).
// Units       rad, components along the body axes of the mean (of r those of a reference).
// Domain      any quaternions but 0; those that are 0 or not finite are left out and named. No mean
//             where the root mean square angle from it is a right angle or more: 132 degrees of
//             uniform attitudes, 104 of those that turn evenly about an axis (of a few at random it
//             may be less). Of a cloud with members beyond a right angle the mean is the one next
//             to the reference. Fewer than two attitudes have covariances of NaN.
// Accuracy    mean_error and covariance_error bound (the latter in the matrix norm) what one step
//             leaves, but for rounding: about theta d^2 / 2 and theta |d| / 6 of the covariance,
//             theta the angle of the farthest. Infinite where the farthest may be half a turn from
//             the mean: no bound, though mostly right. A second pass about `mean` has a d of nearly
//             0; frechet_mean makes as many as it takes. Budget attitude_spread. The bits do not
//             depend on how many are added at a time, by which function, or on the set of
//             instructions.
// Errors      DomainError for a reference that is 0 or not finite, another one to merge, rows that
//             do not fit, a set that this processor lacks, and as an Accumulator.
// Cost        benchmarks/statistics.cpp; 22 numbers, and those of LeftOut.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ensemble/number_moments.hpp"
#include "polhode/ensemble/bins.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {
struct SpreadSums;
}  // namespace detail

struct FrechetMean {
  Quaternion mean;  // w >= 0
  Mat3 covariance;
  double mean_error;  // rad
  double covariance_error;
};

class AttitudeSpread {
 public:
  explicit AttitudeSpread(const Quaternion& reference);

  void add(std::int64_t member, const Quaternion& q);
  // Members first, first + 1, ...
  void add(std::int64_t first, std::span<const RotorState> states);
  void merge(const AttitudeSpread& later);

  const Quaternion& reference() const { return reference_; }
  std::int64_t count() const { return static_cast<std::int64_t>(count_); }
  const LeftOut& left_out() const { return left_out_; }

  // About the reference, exact but for rounding: mean and covariance of v, the largest angle.
  Vec3 mean_vector() const;
  Mat3 covariance() const;
  Extreme farthest() const;

  std::optional<FrechetMean> frechet() const;

  std::vector<double> numbers() const;
  // With the reference that is among the numbers.
  AttitudeSpread restored(std::span<const double> numbers) const;

 private:
  friend struct detail::SpreadSums;

  Quaternion reference_;
  double count_ = 0.0;
  double mean_[3] = {};      // of v
  double products_[6] = {};  // about it: xx yx yy zx zy zz
  double bend_[6] = {};      // sum of (1 - h) v v^T / |v|^2
  double farthest_ = -1.0, farthest_member_ = -1.0;
  LeftOut left_out_;
};

// As add_rows of AttitudeMoments, each epoch about its own reference.
void add_rows(std::span<AttitudeSpread> epochs, std::int64_t first,
              std::span<const RotorState> states, InstructionSet set = widest_instruction_set());

// The same of attitudes that are all at hand, by as many passes as the mean takes to settle to
// rounding: some four, each of all states. None also where it has not after 50.
std::optional<FrechetMean> frechet_mean(std::span<const RotorState> states);

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
