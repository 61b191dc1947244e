// SPDX-License-Identifier: MIT
#include "dynamics/collocation/collocation_stepper.hpp"

#include "dynamics/steppers.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Collocation& method) {
  require_valid(method);
  return std::make_unique<CollocationStepper<RotorStages>>(
      std::make_shared<const RotorStages::Field>(problem.system), SmoothSteps(problem.system),
      problem.start, RotorStages::Field::start(problem.initial), method,
      collocation_control(problem.system, problem.start, method));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
