// SPDX-License-Identifier: MIT
// The stepper of Adaptive for a problem of a System, of a field with a damper or without. Each is
// made in a source of its own: next to the other, the compiler takes less of the inner loop in
// line.
#pragma once

#include <memory>

#include "dynamics/adaptive/smooth_stepper.hpp"
#include "dynamics/steppers.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <template <class> class Field, MotionState S>
std::unique_ptr<BasicStepper<S>> term_stepper(const BasicProblem<System, S>& problem,
                                              const Adaptive& method) {
  require_valid(method);
  const auto made = [&]<class F>(std::shared_ptr<const F> field) {
    const typename F::Values y = field->start(problem.initial);
    return std::make_unique<SmoothStepper<F>>(std::move(field), SmoothSteps(problem.system),
                                              problem.start, y,
                                              step_control(problem.system, problem.start, method));
  };
  if (method.precision == Precision::compensated)
    return made(std::make_shared<const Field<double>>(problem.system));
  return made(std::make_shared<const Field<DoubleDouble>>(problem.system));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
