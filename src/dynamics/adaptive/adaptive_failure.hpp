// SPDX-License-Identifier: MIT
// Why a step could not be made, in words: the term that gives no number, or what the step says.
#pragma once

#include <string>

#include "dynamics/adaptive/rotor_values.hpp"
#include "dynamics/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/ode/adaptive_runge_kutta.hpp"
#include "polhode/ode/verner98.hpp"
#include "polhode/system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The first term, or the frame, that is not finite in the step tried; empty when all are.
template <class Field>
std::string not_finite_text(const Field& field, const DoubleDouble& t,
                            const typename Field::Values& y, double h) {
  using T = typename Field::Number;
  std::string text;
  const auto watched = [&](const DoubleDouble& at_time, const typename Field::Values& values) {
    BasicSetting<T> at = field.equations().setting(at_time, rotor_state<T>(values));
    const auto found = [&](const std::string& what) {
      if (text.empty() && is_finite(at.s.g))
        text = what + " is not a finite number at t = " + number_text(at_time.hi);
    };
    if (!field.system().frame().is_inertial()) {
      const BasicFrameMotion<T> frame = field.equations().frame_motion(at_time);
      if (!is_finite(frame.mu_S)) found("the rate of the frame");
      at.q_IS = frame.q_IS;
    }
    for (const AnyPerturbation& term : field.system().terms()) {
      const BasicEffect<T> e = term.effect(at);
      if (!is_finite(e.u)) found("the torque of term \"" + term.name() + "\"");
      if (!is_finite(e.v)) found("the rate of term \"" + term.name() + "\"");
    }
    return field(at_time, values);
  };
  runge_kutta_step<Verner98>(watched, t, y, watched(t, y), h);
  return text;
}

// The sentence of an outcome that is not `made`.
template <class Field>
std::string failure_text(const Field& field, const DoubleDouble& t, const typename Field::Values& y,
                         double h, StepOutcome outcome) {
  const std::string where = number_text(t.hi);
  if (outcome == StepOutcome::not_finite) {
    const std::string term = not_finite_text(field, t, y, h);
    if (!term.empty()) return term + ": give it a value there, or stop before";
    return "the momentum grows beyond all numbers at t = " + where +
           ": is the sign of a torque right?";
  }
  return "the step at t = " + where + " would be " + number_text(std::abs(h)) +
         ", below the rounding of t: does a torque or the frame jump there repeatedly, or grow "
         "without bound? Name the switching functions of the term, or try a larger tolerance";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
