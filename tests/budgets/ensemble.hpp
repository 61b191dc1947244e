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

// --- statistics (tests/unit/ensemble) ---
// Covariances of 20,000 against 50 digits, in eps sqrt(1 + (mean/deviation)^2) of the product of
// deviations; means in eps of the largest number. In chunks of 1000; of 1 and 7, and in one.
inline constexpr double number_moments_eps = 4.0;
inline constexpr double number_moments_long_eps = 40.0;
// Second moments of quaternions against 50 digits, 10,000 attitudes.
inline constexpr double attitude_moments_eps = 40.0;
// An attitude put in against the mean found, rad; eigenvalues.
inline constexpr double attitude_mean = 2e-15;
inline constexpr double attitude_values = 4e-15;
// Frechet means that settled against the one put in, rad; covariances relative to their trace.
inline constexpr double attitude_spread = 4e-15;
inline constexpr double attitude_covariance = 2e-14;
// Resultants and means of angles, in eps.
inline constexpr double angle_moments_eps = 8.0;
// Phases of free tumblers, covariances relative to the variances.
inline constexpr double spreading_phases = 1e-9;
// Of edges of bins about 1.
inline constexpr double bin_rounding = 1e-12;
// Bounds of a survival of rate 1 from bins of 0.01: the part of the events in one.
inline constexpr double survival_bounds = 0.02;
// Tests by chance: a p-value below this, or above 1 minus it, fails. Seeds are fixed.
inline constexpr double least_chance = 1e-3;

}  // namespace polhode::budget
