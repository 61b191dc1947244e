// SPDX-License-Identifier: MIT
#include "polhode/dynamics/custom_method.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/steppers.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/detail/fixed_stepper.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What a CustomMethod holds.
struct StepperMaker {
  double step;
  StepMap map;
};

namespace {

struct CustomMap {
  using State = TimedState<RotorState>;
  using Shown = SystemState;

  std::shared_ptr<const StepperMaker> maker;
  System system;

  State stepped(State at, double h) const {
    at.s = maker->map(system, at.t.hi, at.s, h);
    at.s.q = normalized(at.s.q);
    at.t = at.t + DoubleDouble(h);
    return at;
  }
  static SystemState state(const State& at) { return at.s; }
  static std::string failure(const State& from, State& to) {
    if (has_finite_numbers(to.s)) return {};
    return "the state is not finite after the step from t = " + number_text(from.t.hi) +
           ": take a smaller step, or see whether the map or a term grows without bound";
  }
  static std::int64_t evaluations(const State&, std::int64_t steps) { return steps; }
  static void serialize(Archive& bytes, State& at) { bytes.all(at.t, at.s); }
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const CustomMethod& method) {
  return std::make_unique<FixedStepper<CustomMap>>(
      CustomMap{method.maker, problem.system},
      TimedState<RotorState>{problem.start, problem.initial}, method.maker->step);
}

}  // namespace detail

CustomMethod custom_method(FixedStepMap steps) {
  if (steps.kind.empty()) throw DomainError("custom_method: got an empty kind; expected a name");
  const std::string shown = "custom_method: " + steps.kind + ": ";
  if (!(steps.step > 0.0) || !std::isfinite(steps.step))
    throw DomainError(shown + "step " + detail::number_text(steps.step) +
                      " must be positive and finite");
  if (!steps.map) throw DomainError(shown + "got no map; expected one that makes a step");
  MethodTraits traits{.kind = steps.kind,
                      .text = steps.kind + ", step " + detail::number_text(steps.step),
                      .further = std::move(steps.further),
                      .step = steps.step};
  return {std::move(traits), std::make_shared<const detail::StepperMaker>(
                                 detail::StepperMaker{steps.step, std::move(steps.map)})};
}

}  // namespace v0
}  // namespace polhode
