// SPDX-License-Identifier: MIT
// The stepper of Adaptive for a field that is made of a System: its steps end where a term is not
// smooth.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "dynamics/adaptive/smooth_step.hpp"
#include "dynamics/adaptive/step_control.hpp"
#include "polhode/dynamics/detail/adaptive_stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// `jumps`: see SwitchWatch.
class SmoothSteps {
 public:
  explicit SmoothSteps(const System& system, const char* jumps = nullptr)
      : breakpoints_(system), switches_(system, jumps) {}

  template <class Field>
  SmoothField<Field> rates(std::shared_ptr<const Field> field) const {
    return {std::move(field)};
  }
  template <class Solver, class Field>
  std::string advance(Solver& solver, const Field& field, double stop) {
    return SmoothStep<Solver, Field>(solver, field, breakpoints_, switches_, grading_, stop).made();
  }
  template <class Rates>
  void transfer(StateBytes& bytes, Rates& rates) {
    bytes.all(rates.stretch.from, rates.stretch.to);  // of the step made last
    switches_.transfer(bytes);
    switches_.transfer(bytes, rates.sides);
    grading_.transfer(bytes);
  }

 private:
  Breakpoints breakpoints_;
  SwitchWatch switches_;
  EdgeGrading grading_;
};

template <class Field>
using SmoothStepper = AdaptiveStepper<Field, SmoothSteps>;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
