// SPDX-License-Identifier: MIT
// Tolerances of tests: shapes.
#pragma once

namespace polhode::budget {

// --- facet shapes (tests/unit/shape), in eps of mass x size^degree; extrapolated ellipsoid ---
inline constexpr double shape_mass = 8.0;
inline constexpr double shape_limit = 1e-6;

// --- inertia integrals of degree 3 and 4 (tests/unit/shape/mass_moments.cpp), on sums of order 100
// ---
inline constexpr double mass_moments_rotated = 2e-12;

}  // namespace polhode::budget
