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
  if (const auto* const method = std::get_if<Collocation>(&problem.method))
    return make_stepper(problem, *method);
  return make_stepper(problem, std::get<Adaptive>(problem.method));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
