// SPDX-License-Identifier: MIT
// StepControl: what the steps of an adaptive integrator keep to, and how long one may be.
//
// Units       those of the problem.
// Domain      tolerance > 0; steps and rests are lengths, without sign.
// Accuracy    smallest_step is eight roundings of t.
// Cost        a few comparisons.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {

struct StepControl {
  double tolerance;
  double first_step = 0.0;  // 0: chosen
  double largest_step = std::numeric_limits<double>::infinity();
};

// The whole rest, half of it, or the step h that control asks for: no tiny step at the end.
inline double step_towards(double rest, double wanted, const StepControl& control) {
  const double h = std::min(wanted, control.largest_step);
  if (h * (1.0 + 1e-9) >= rest) return rest;
  return h > 0.5 * rest ? 0.5 * rest : h;
}

// Below it a step is lost in the rounding of t.
inline double smallest_step(const DoubleDouble& t) {
  return std::max(8.0 * epsilon<double>() * std::abs(t.hi), std::numeric_limits<double>::min());
}

}  // namespace v0
}  // namespace polhode
