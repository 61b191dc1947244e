// SPDX-License-Identifier: MIT
// StepJumps: torques that jump within the steps of a splitting, whose derivative does not know it.
#pragma once

#include <string>

#include "dynamics/adaptive/switch_watch.hpp"
#include "dynamics/splitting/splitting_map.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class StepJumps {
 public:
  // `why` ends the sentence that refuses a jump.
  StepJumps(const System& system, const char* why) : switches_(system, why) {}

  // After a step by h. Empty, or where a torque jumps because the state says so. A function that
  // changes its sign and back within one step is not seen, though kicks inside the step may feel
  // the torque between: steps must be shorter than that.
  std::string seen(const SplittingMap& map, const SplittingState& from, double h,
                   const SplittingState& to);
  // The same after a part of a step, up to a sample, which the run does not keep.
  std::string seen_in_part(const SplittingMap& map, const SplittingState& from, double h,
                           const SplittingState& to) const;

  void transfer(StateBytes& bytes) {
    bytes(has_begun_);
    switches_.transfer(bytes);
  }

 private:
  SwitchWatch switches_;
  bool has_begun_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
