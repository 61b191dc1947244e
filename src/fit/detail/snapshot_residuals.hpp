// SPDX-License-Identifier: MIT
// Residuals of snapshots, and what their unknowns are.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/detail/snapshot_rows.hpp"
#include "fit/detail/spin_motion.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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
}  // namespace v0
}  // namespace polhode
