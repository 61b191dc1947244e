// SPDX-License-Identifier: MIT
// A driven spin state at many times, with derivatives by any of its unknowns.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fit/detail/snapshot_residuals.hpp"
#include "polhode/fit/driven_spin_fit.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// A part of the motion without a jump, its times in order, of which the first are asked for and
// `to` is one; then a jump, made forwards and unmade backwards.
struct DrivenLeg {
  double from, to;
  std::vector<double> times;
  std::size_t asked;
  std::optional<std::size_t> jump;
  bool is_first;  // of those that begin at t0
};

// They end at jumps.
std::vector<DrivenLeg> driven_legs(std::span<const double> times, double t0,
                                   const std::vector<SpinJump>& jumps);

// What one unknown changes: the attitude at t0, by a rotation about `axis_F`; a component of the
// rate at t0; a ratio of moments; a parameter of torques; a component of a jump.
struct DrivenColumn {
  enum class Of { turn, rate, ratio, torque, jump };
  Of of = Of::turn;
  std::size_t index = 0;  // of the moment, the parameter, the jump
  Vec3 axis_F;            // of the turn, the rate, the jump
};

// A drive with its numbers, and the body in the axes of its terms.
class DrivenMotion {
 public:
  // DomainError for a tensor that is not diagonal in these axes or none that a body may have, and
  // for parameters that the terms do not take.
  DrivenMotion(const SpinDrive& drive, const SpinState& start, std::span<const double> parameters,
               std::span<const Vec3> changes);

  // At times in any order. None where the run cannot go on, or ends in no numbers.
  std::optional<std::vector<MovedPoint>> at(std::span<const double> times,
                                            std::span<const DrivenColumn> columns) const;
  // The momentum and the attitude at t0 that lead without jumps to where the last jump leads.
  std::optional<SpinState> after_jumps() const;
  // DomainError for a parameter, or with `moments` a ratio, on which the effects of the terms do
  // not depend as is asked (driven_spin_fit.hpp); looked at at these times.
  void require_affine(std::span<const double> times, bool moments) const;
  // DomainError for a term that jumps at a zero of a switching function that depends on the state.
  void require_no_jumps(std::span<const double> times) const;

 private:
  class Wanted;
  bool add_columns(std::span<const DrivenLeg> legs, std::span<const DrivenColumn> six,
                   const Wanted& wanted, std::vector<MovedPoint>& points) const;
  std::vector<AnyPerturbation> stepped_terms(std::size_t parameter, double& step) const;
  RotorState jumped(const RotorState& s, std::size_t j, double sign) const;
  SpinState shown(const RotorState& s) const;

  const SpinDrive& drive_;
  SpinState start_;
  std::vector<double> parameters_;
  std::vector<Vec3> changes_;
  Mat3 R_;  // v_F = R v_B
  System system_;
  RotorState initial_;
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
