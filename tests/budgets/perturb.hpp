// SPDX-License-Identifier: MIT
// Tolerances of tests: torques.
#pragma once

namespace polhode::budget {

// --- light and air on facets (tests/unit/perturb/surface.cpp) ---
inline constexpr double surface_eps = 40.0;
inline constexpr double surface_ball = 1e-4;
// Of a ball of 512 facets, across the stream.
inline constexpr double surface_mesh = 1e-3;
inline constexpr double surface_slope = 1e-7;
inline constexpr double shadow_counted = 1e-4;
// Discs on the sphere as circles in a plane, 400 km above the Earth.
inline constexpr double shadow_plane = 2.3e-4;
// Against 600 x 600 points; error of the library relative to area times size.
inline constexpr double yorp_brute_force = 1e-3;
inline constexpr double yorp_quadrature = 1e-12;
inline constexpr double yorp_not_zero = 1e-4;  // what a body that emits has at least
// Of the series to degree 3000, whose terms fall with the third power.
inline constexpr double yorp_series = 5e-12;

// --- perturbation terms (tests/unit/perturb), over the size of the torque ---
// Effects in double, in eps, and in double-double against differences at 76 digits.
inline constexpr double perturb_eps = 4.0;
inline constexpr double perturb_difference = 2e-31;
// The cubic of a table, in eps: numbers up to 9.
inline constexpr double cubic_table_eps = 64.0;
// An average over an orbit by equal steps of time.
inline constexpr double perturb_average = 4e-15;
// Exponential of a damping matrix, over the larger momentum, in eps.
inline constexpr double damping_flow_eps = 4.0;

// --- gravity of degree 3 and 4, and of an oblate body (tests/unit/perturb/{higher,oblate}_gravity)

// --- The torque and the energy over the sum of those of every point mass, in units of eps.
inline constexpr double higher_gravity_eps = 16.0;
// Central differences at 76 digits, relative.
inline constexpr double higher_gravity_difference = 1e-15;
// The exponent with which a remainder falls between 1000 and 2000 radii.
inline constexpr double higher_gravity_slope = 0.02;

// --- tides (tests/unit/perturb/dissipation.cpp), relative ---
// Over the sum of its three parts, in units of eps.
inline constexpr double tidal_eps = 16.0;
// A difference over a lag of 1e-4, of its own rounding and of the third order in the lag.
inline constexpr double tidal_lag = 1e-6;
inline constexpr double tidal_average = 1e-12;

// --- magnetic torques (tests/unit/perturb/magnetic.cpp) ---
// Of a field and of a torque against differences of the potential at 76 digits.
inline constexpr double magnetic_field_eps = 16.0;
// Of g after a flow; beyond |h A| = 1/2 over 1 + h.
inline constexpr double affine_change_eps = 8.0;
// A sphere that loses its spin: some ten turns.
inline constexpr double magnetic_decay = 4e-14;
inline constexpr double magnetic_secular = 1e-15;
// Of the mean: second order in a strength of 1e-7.
inline constexpr double magnetic_average = 1e-5;
inline constexpr double splitting_affine_order = 0.3;
inline constexpr double splitting_affine = 1e-10;
inline constexpr double splitting_affine_composed = 1e-8;

}  // namespace polhode::budget
