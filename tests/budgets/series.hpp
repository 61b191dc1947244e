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

}  // namespace polhode::budget
