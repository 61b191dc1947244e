// SPDX-License-Identifier: MIT
// Tolerances of tests: the Runge-Kutta pair.
#pragma once

namespace polhode::budget {

// --- the Runge-Kutta pair and its control (tests/unit/ode) ---
// Published coefficients against the conditions, and double ones settled on the first of them.
inline constexpr double ode_condition = 1e-30;
inline constexpr double ode_not_of_order = 1e-6;
inline constexpr double ode_rounded_condition = 1e-17;
inline constexpr double ode_rounded_coefficient = 1e-15;
inline constexpr double ode_order = 0.3;
inline constexpr double ode_per_tolerance = 20.0;
inline constexpr double ode_tightest = 2e-15;
inline constexpr double ode_double_double = 1e-28;
inline constexpr double ode_clock = 2e-15;
inline constexpr double ode_edge = 1e-9;
// Behind the first of jumps at every rounding of t: each step at the rounding passes some.
inline constexpr double ode_jumps = 1e-7;
// A jump by 1e9 that a step at the rounding of t passes.
inline constexpr double ode_jump = 1e-12;

}  // namespace polhode::budget
