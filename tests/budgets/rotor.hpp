// SPDX-License-Identifier: MIT
// Tolerances of tests: bodies and charts.
#pragma once

namespace polhode::budget {

// --- body and charts (tests/unit/rotor, tests/property/chart_*), G = 1 ---
// Moments and reassembled tensor against the tensor given, relative to the largest moment.
inline constexpr double body_tensor = 4e-15;
// Direction of principal axes whose moments differ by a fifth.
inline constexpr double body_axes = 1e-14;
// A rotation matrix rounded to float.
inline constexpr double float_matrix = 2e-7;
// A few roundings: conversions at points where they are well conditioned.
inline constexpr double chart_rounding = 3e-15;
// Charts in lanes against one state at a time, in eps: angles, and what goes with |q| and |g|.
inline constexpr double lane_charts_eps = 4.0;
// Andoyer round trip of the hub where sin I, sin J > 0.09, relative.
inline constexpr double andoyer_generic = 5e-14;
// What L, G, H cannot hold: attitude and momentum within min(eps x this / J, andoyer_pole).
inline constexpr double andoyer_pole_eps = 3.0;
inline constexpr double andoyer_pole = 3e-8;
// g +- l +- h near the poles, and its limit at 1e-9 from them.
inline constexpr double andoyer_sum = 4e-15;
inline constexpr double andoyer_limit = 4e-9;
// Transverse momentum near theta = 0, pi: eps x this |Psi| / sin theta.
inline constexpr double euler_pole_eps = 2.0;
// Poincare-type sets, round trip of the hub within 90 degrees of their poles.
inline constexpr double poincare = 1e-14;
// At the poles that a set is not made for.
inline constexpr double poincare_far_pole = 1e-7;
// Chart to chart and back: floor + eps x this x what the inverse Jacobians make of the sizes.
inline constexpr double round_trip_floor = 1e-14;
inline constexpr double round_trip_eps = 20.0;
// |M J M^T - J| in units of eps (|M| |J| |M^T|), entry by entry; at a hub state, and of B at the
// chart's own numbers.
inline constexpr double symplectic_eps = 4.0;
inline constexpr double own_symplectic_eps = 4.0;
// A product of Jacobians rounded to double, in eps of its terms.
inline constexpr double given_jacobian_eps = 4.0;
// Entries of B, relative, and what a zero of the differences may be.
inline constexpr double jacobian_eps = 1.0;
inline constexpr double jacobian_zero = 1e-30;
// Within 2^-40 of a pole of the chart; the entries that grow or stay.
inline constexpr double pole_jacobian_eps = 4.0;

// Roll, pitch and yaw, rad, and their matrix (tests/unit/rotor/roll_pitch_yaw.cpp).
inline constexpr double roll_pitch_yaw = 5e-15;
}  // namespace polhode::budget
