// SPDX-License-Identifier: MIT
// What was seen beside a motion: residuals, and their derivatives from those of the motion.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "polhode/fit/snapshots.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The attitude and the rate at one time and, by each unknown, the rotation vector of the attitude
// in body axes F and the change of the rate; none without derivatives.
struct MovedPoint {
  Quaternion q;
  Vec3 w_F;
  std::vector<Vec3> turn, rate;
};

class SnapshotRows {
 public:
  SnapshotRows(const Snapshots& seen, const std::optional<ObservedAttitude>& prior);

  // Of attitudes, directions, rates: where `points` are wanted.
  const std::vector<double>& times() const { return times_; }
  // The numbers of attitudes, directions, rates, then the prior of the attitude, that at t0;
  // derivatives row by row where `jacobian` is not empty.
  void at(std::span<const MovedPoint> points, const MovedPoint& t0, std::span<double> numbers,
          std::span<double> jacobian) const;
  // Of what is held together by a loss.
  std::vector<std::size_t> blocks() const;
  // In rad, per axis, of points whose first are those of the attitudes; NaN without attitudes.
  double attitude_rms(std::span<const Quaternion> points) const;

 private:
  class Rows;
  Snapshots seen_;
  std::optional<ObservedAttitude> prior_;
  std::vector<double> times_;
  std::vector<Mat3> attitude_roots_, rate_roots_;
  Mat3 prior_root_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
