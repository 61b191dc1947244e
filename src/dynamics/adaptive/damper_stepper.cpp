// SPDX-License-Identifier: MIT
#include "dynamics/adaptive/damper_field.hpp"
#include "dynamics/adaptive/term_stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem,
                                                             const Adaptive& method) {
  return term_stepper<DamperField>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
