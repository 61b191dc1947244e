// SPDX-License-Identifier: MIT
// The stepper of a problem by its method, and the steppers of a rotor with a damper.
#include "dynamics/steppers.hpp"

#include <variant>

#include "dynamics/adaptive/adaptive_stepper.hpp"
#include "dynamics/adaptive/damper_field.hpp"
#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/damper_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::unique_ptr<Stepper> make_stepper(const Problem& problem) {
  return std::visit([&](const auto& method) { return make_stepper(problem, method); },
                    problem.method);
}

std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem) {
  if (const auto* const method = std::get_if<Collocation>(&problem.method))
    return make_stepper(problem, *method);
  return make_stepper(problem, std::get<Adaptive>(problem.method));
}

std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem,
                                                             const Adaptive& method) {
  return term_stepper<DamperField>(problem, method);
}

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
