// SPDX-License-Identifier: MIT
#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/damper_stages.hpp"
#include "dynamics/steppers.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem,
                                                             const Collocation& method) {
  require_valid(method);
  return std::make_unique<CollocationStepper<DamperStages>>(
      std::make_shared<const SweptDamper>(problem.system), SmoothSteps(problem.system),
      problem.start, SweptDamper::start(problem.initial), method,
      collocation_control(problem.system, problem.start, method));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
