// SPDX-License-Identifier: MIT
// The stepper of a problem by its method, and the steppers of a rotor with a damper.
#include "dynamics/steppers.hpp"

#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "dynamics/adaptive/adaptive_stepper.hpp"
#include "dynamics/adaptive/damper_field.hpp"
#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/damper_stages.hpp"
#include "dynamics/splitting/splitting_map.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/detail/fixed_stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::string below_rounding_text(double step, double t) {
  return "step " + number_text(step) + " is below the rounding of t = " + number_text(t) +
         ": take a larger step or count time from a nearer epoch";
}

namespace {

std::unique_ptr<Stepper> damper_stepper(const Problem& problem) {
  const auto* const method = std::get_if<Collocation>(&problem.method);
  if (method == nullptr)
    return term_stepper<DamperField>(problem, std::get<Adaptive>(problem.method));
  return collocation_stepper<DamperStages>(std::make_shared<const SweptDamper>(problem.system),
                                           problem.start, SweptDamper::start(problem.initial),
                                           *method);
}

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Problem& problem) {
  if (problem.system.damper()) return damper_stepper(problem);
  return std::visit([&](const auto& method) { return make_stepper(problem, method); },
                    problem.method);
}

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Splitting& method) {
  SplittingMap map(problem.system, method.scheme);
  const SplittingState start = map.start(problem.start, problem.initial);
  return std::make_unique<FixedStepper<SplittingMap>>(std::move(map), start, method.step);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
