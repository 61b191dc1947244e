// SPDX-License-Identifier: MIT
// The stepper of Adaptive for a field that is made of a System: its steps end where a term is not
// smooth.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "dynamics/adaptive/switching_step.hpp"
#include "dynamics/steppers.hpp"
#include "polhode/detail/ode/adaptive_runge_kutta.hpp"
#include "polhode/dynamics/detail/adaptive_stepper.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The shortest quarter of a period among what the terms follow, and of the frame at the start;
// infinite where none is known.
double time_scale(const System& system, double start);

inline StepControl step_control(const System& system, double start, const Adaptive& method) {
  const bool is_limited = method.largest_step < std::numeric_limits<double>::infinity();
  return {method.tolerance, method.first_step,
          is_limited ? method.largest_step : time_scale(system, start)};
}

// `jumps`: see SwitchWatch.
class SwitchingSteps {
 public:
  explicit SwitchingSteps(const System& system, const char* jumps = nullptr)
      : breakpoints_(system), switches_(system, jumps) {}

  template <class Field>
  SmoothField<Field> rates(std::shared_ptr<const Field> field) const {
    return {std::move(field)};
  }
  template <class Solver, class Field>
  std::string advance(Solver& solver, const Field& field, double stop) {
    return SwitchingStep<Solver, Field>(solver, field, breakpoints_, switches_, grading_, stop)
        .made();
  }
  template <class Rates>
  void serialize(Archive& bytes, Rates& rates) {
    bytes.all(rates.stretch.from, rates.stretch.to);  // of the step made last
    switches_.serialize(bytes);
    switches_.serialize(bytes, rates.sides);
    grading_.serialize(bytes);
  }

 private:
  Breakpoints breakpoints_;
  SwitchWatch switches_;
  SwitchStepControl grading_;
};

template <class Field>
using SwitchingStepper = AdaptiveStepper<Field, SwitchingSteps>;

// The stepper of Adaptive for a field of a System, from its numbers at a time. `jumps`: see
// SwitchWatch.
template <class Field>
std::unique_ptr<BasicStepper<typename Field::State>> switching_stepper(
    std::shared_ptr<const Field> field, double start, const typename Field::Values& y,
    const Adaptive& method, const char* jumps = nullptr) {
  const System& system = field->system();
  const StepControl control = step_control(system, start, method);
  return std::make_unique<SwitchingStepper<Field>>(std::move(field), SwitchingSteps(system, jumps),
                                                   start, y, control);
}

// The same of a field with a damper or without. Each is made in a source of its own: next to the
// other, the compiler takes less of the inner loop in line.
template <template <class> class Field>
std::unique_ptr<Stepper> term_stepper(const Problem& problem, const Adaptive& method) {
  require_valid(method);
  const auto made = [&]<class F>(std::shared_ptr<const F> field) {
    const typename F::Values y = field->start(problem.initial);
    return switching_stepper(std::move(field), problem.start, y, method);
  };
  if (method.precision == Precision::compensated)
    return made(std::make_shared<const Field<double>>(problem.system));
  return made(std::make_shared<const Field<DoubleDouble>>(problem.system));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
