// SPDX-License-Identifier: MIT
// Tolerances of tests: Poisson series.
#pragma once

namespace polhode::budget {

// --- Poisson series (tests/unit/series/fourier.cpp) ---
// Of the sum of |C a^n|, in eps.
inline constexpr double compiled_series_eps = 5.0;
// Relative, of 2^-168, after products of some terms.
inline constexpr double series_of_50_digits = 1e-47;
// Of coefficients of size 1.
inline constexpr double fourier_series = 1e-14;

// python/tests/test_series.py: relative, of three terms.
inline constexpr double series_values = 1e-13;

// python/tests/test_series_functions.py. Of the logarithm of two errors.
inline constexpr double series_function_slope = 0.5;
inline constexpr double series_function_theory_slope = 0.2;
// Of polynomials of degree 6 (5) at a displacement of 0.06 (0.02), and of central differences.
inline constexpr double series_function_error = 1e-6;
inline constexpr double series_function_difference = 1e-8;

}  // namespace polhode::budget
