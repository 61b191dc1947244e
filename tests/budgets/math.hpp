// SPDX-License-Identifier: MIT
// Tolerances of tests: numbers.
#pragma once

namespace polhode::budget {

// --- numbers (tests/unit/math): relative errors in units of epsilon<T>(), 2^-52 of double and
// 2^-104 of DoubleDouble ---
inline constexpr double double_double_constant = 0.125;
inline constexpr double double_double_arithmetic = 1.0;
inline constexpr double double_double_functions = 2.0;
inline constexpr double dual_derivative = 4.0;

// --- numbers with an exponent of their own (tests/unit/math/wide_range.cpp), relative ---
inline constexpr double wide_range = 4e-16;

// --- angles beyond the 32-digit reduction (tests/unit/math) ---
inline constexpr double large_angle = 2e-16;

// --- functions of packs (tests/unit/math/pack_functions.cpp), in units in the last place ---
inline constexpr double pack_sincos_ulp = 0.9;
inline constexpr double pack_atan2_ulp = 0.6;
inline constexpr double pack_exp_ulp = 1.5;
inline constexpr double pack_small_atan_ulp = 1.0;
// Of a logarithm, over the larger of itself and 1.
inline constexpr double pack_log = 4e-16;

}  // namespace polhode::budget
