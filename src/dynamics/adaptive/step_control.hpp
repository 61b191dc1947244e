// SPDX-License-Identifier: MIT
// What Adaptive asks of its steps, with what the terms of a problem know of their time scales.
#pragma once

#include "polhode/dynamics/method.hpp"
#include "polhode/ode/adaptive_runge_kutta.hpp"
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
