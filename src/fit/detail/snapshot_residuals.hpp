// SPDX-License-Identifier: MIT
// Residuals of snapshots, and what their unknowns are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fit/free_motion.hpp"
#include "polhode/fit/snapshots.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
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

// Which of the parameters of a motion are unknowns, in order.
std::vector<std::size_t> parameters_of(const SpinUnknowns& unknowns);
const char* parameter_name(std::size_t parameter);
// Its value; that of a turn, about the state itself, is 0.
double parameter_of(const SpinState& state, std::size_t parameter);
// The state at these unknowns, turns about that of `start`.
SpinState state_at(const SpinState& start, const std::vector<std::size_t>& parameters,
                   std::span<const double> x);

class SnapshotResiduals {
 public:
  explicit SnapshotResiduals(const SpinFit& fit);

  // The numbers at x about the state `start` of the fit: attitudes, directions, rates, then the
  // prior of the attitude; derivatives row by row where `jacobian` is not empty.
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const;
  // Of what is held together by a loss.
  std::vector<std::size_t> blocks() const { return rows_.blocks(); }
  // In rad, per axis; NaN without attitudes.
  double attitude_rms(const SpinState& state) const;

 private:
  SpinFit fit_;
  std::vector<std::size_t> parameters_;
  SnapshotRows rows_;
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
