// SPDX-License-Identifier: MIT
// Tolerances of tests: elliptic kernels.
#pragma once

namespace polhode::budget {

// --- elliptic kernels (tests/unit/elliptic): relative errors in units of epsilon<T>(), 2^-52 of
// double and 2^-104 of DoubleDouble ---
inline constexpr double elliptic_carlson = 4.0;
inline constexpr double elliptic_carlson_derivative = 10.0;
inline constexpr double elliptic_complete = 4.0;
inline constexpr double elliptic_complete_derivative = 16.0;
inline constexpr double elliptic_nome = 4.0;
inline constexpr double elliptic_heuman = 4.0;
inline constexpr double elliptic_legendre = 4.0;
inline constexpr double elliptic_legendre_derivative = 6.0;
// Any angle, m < 0, m > 1, n > 1, ends of the range.
inline constexpr double elliptic_beyond = 8.0;
inline constexpr double elliptic_beyond_derivative = 40.0;
// From Python, against mpmath, relative.
inline constexpr double elliptic_python = 4e-15;
// Of sn, cn, dn: over |f| + |u f'|, what one rounding of f and of u does. Of their derivatives:
// over
// 1 + |u|.
inline constexpr double elliptic_jacobi = 3.0;
inline constexpr double elliptic_jacobi_derivative = 20.0;
// sn, cn, dn in lanes, by more multiplications than divisions.
inline constexpr double elliptic_jacobi_lanes = 8.0;

}  // namespace polhode::budget
