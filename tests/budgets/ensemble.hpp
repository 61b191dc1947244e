// SPDX-License-Identifier: MIT
// Tolerances of tests: statistics of ensembles.
#pragma once

namespace polhode::budget {

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
