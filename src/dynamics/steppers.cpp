// SPDX-License-Identifier: MIT
#include "dynamics/steppers.hpp"

#include <variant>

namespace polhode {
inline namespace v0 {
namespace detail {

std::unique_ptr<Stepper> make_stepper(const Problem& problem) {
  return std::visit([&](const auto& method) { return make_stepper(problem, method); },
                    problem.method);
}

std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem) {
  return make_stepper(problem, *method_of_any_state(problem.method));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
