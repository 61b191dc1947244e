// SPDX-License-Identifier: MIT
// Tolerances of tests: ensembles.
#pragma once

namespace polhode::budget {

// --- draws (tests/unit/ensemble): a probability over fixed seeds between these two ---
inline constexpr double improbable = 1e-3, too_good = 0.999;

// --- normal_quantile against 50 digits, in ulp, from 2.3e-308 to 1 - 2^-53 ---
inline constexpr double normal_quantile_ulp = 6.0;

// --- distributions of one number: in eps of max(1, ln(high / low)); of max(1, |z|); absolute, of a
// mean and a sigma below 5 ---
inline constexpr double log_uniform = 2.0;
inline constexpr double truncated_normal = 8.0, truncated_normal_scaled = 1e-13;

// --- JointNormal: F F^T beside the covariance, in n eps of its correlations; flat, absolute ---
inline constexpr double joint_normal = 8.0, joint_normal_flat = 1e-14;

// --- lengths of directions and attitudes, in eps ---
inline constexpr double unit_length = 4.0;

// --- errors of means over Sobol's points: over those of as many random ones, of a 16th of them ---
inline constexpr double sobol_over_random = 0.02, sobol_over_fewer = 0.1;

}  // namespace polhode::budget
