// SPDX-License-Identifier: MIT
// A stepper whose steps are made in parts, so that those of several bodies can be solved together.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "dynamics/collocation/rotor_stages.hpp"
#include "dynamics/collocation/sweeps.hpp"
#include "dynamics/steppers.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class StepperInParts : public Stepper {
 public:
  // The first part of advance(stop). Empty, or why there is no step.
  virtual std::string begin(double stop) = 0;
  // What is tried, to be solved by sweeps, and the judge of them.
  virtual RotorStages& tried() = 0;
  virtual SweepJudge judge() const = 0;
  // What advance says; nothing while there is another one to solve.
  virtual std::optional<std::string> solved(const SweepJudge& judge) = 0;
};

std::unique_ptr<StepperInParts> make_stepper_in_parts(const Problem& problem,
                                                      const Collocation& method);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
