// SPDX-License-Identifier: MIT
// Tolerances of tests: fits.
#pragma once

namespace polhode::budget {

// --- losses (tests/unit/fit): their values and slopes, of the value ---
inline constexpr double loss = 1e-14;

// --- least squares: a straight line, and what is on a bound or near one ---
inline constexpr double fit_line = 1e-9, fit_bounded = 1e-7;
inline constexpr double fit_narrow_prior = 1e-4;  // what the other unknown leaves to it
inline constexpr double fit_robust = 0.15, fit_robust_gradient = 1e-4;

}  // namespace polhode::budget
