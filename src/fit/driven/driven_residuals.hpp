// SPDX-License-Identifier: MIT
// Residuals of snapshots of a driven body, and what their unknowns are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fit/detail/snapshot_rows.hpp"
#include "fit/driven/driven_motion.hpp"
#include "polhode/fit/driven_spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class DrivenResiduals {
 public:
  DrivenResiduals(const SpinFit& fit, const SpinDrive& drive);

  // In order, with their starts and bounds: those of the state, of torques, of jumps.
  std::vector<Unknown> unknowns() const;
  // Where the two ratios of moments are, if they are unknown.
  std::optional<TriangleBound> triangle() const;

  // At unknowns x about the start of the fit.
  SpinState state(std::span<const double> x) const;
  SpinDrive drive(std::span<const double> x) const;
  std::vector<DrivenColumn> columns(std::span<const double> x) const;
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const;
  double attitude_rms(std::span<const double> x) const;

  const SnapshotRows& rows() const { return rows_; }

 private:
  // None where the drive takes no such numbers, or leads nowhere.
  std::optional<std::vector<MovedPoint>> moved(std::span<const double> x,
                                               std::span<const DrivenColumn> columns) const;

  SpinFit fit_;
  SpinDrive drive_;
  std::vector<std::size_t> parameters_;  // of the state
  SnapshotRows rows_;
};

std::vector<Vec3> changes_of(const SpinDrive& drive);
std::vector<double> starts_of(const SpinDrive& drive);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
