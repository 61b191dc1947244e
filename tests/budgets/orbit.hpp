// SPDX-License-Identifier: MIT
// Tolerances of tests: orbits.
#pragma once

namespace polhode::budget {

// --- orbits (tests/unit/orbit), in eps of the number type ---
// The eccentric anomaly and 1 - cos E, relative; sin E over what a rounding of E does.
inline constexpr double kepler_anomaly_eps = 2.0;
inline constexpr double kepler_sine_eps = 2.0;
inline constexpr double kepler_versine_eps = 5.0;
// Position and velocity of an orbit, relative to their lengths, after any number of orbits.
inline constexpr double kepler_position_eps = 4.0;
// The same for e <= 0.5, from a table; and before it is turned into the axes of the elements.
inline constexpr double kepler_tabulated_eps = 1.5;
inline constexpr double kepler_tabulated_plane_eps = 0.6;
inline constexpr double kepler_velocity_eps = 10.0;
inline constexpr double kepler_wide_eps = 16.0;
inline constexpr double kepler_rounded = 1e-15;  // functions of a rounded anomaly, relative
// Elements of a state where they are well conditioned.
inline constexpr double kepler_elements = 1e-13;
// The node of a published sun-synchronous orbit, first order in J2.
inline constexpr double sun_synchronous_deg_per_day = 5e-4;
inline constexpr double j2_rates_eps = 4.0;
// Against orbits integrated with the force of J2 (tests/oracle/oblate_motion.hpp): the rates
// relative to their scale, in J2; the mean axis relative to itself, in J2^2; km in ten days.
inline constexpr double j2_rates_relative = 5.0;
inline constexpr double j2_mean_axis = 3.0;
inline constexpr double j2_low_orbit_km = 30.0;
inline constexpr double j2_eccentric_orbit_km = 40.0;

// Over the distance of the pericentre (tests/unit/orbit/precessing_kepler_orbit.cpp).
inline constexpr double mean_ellipse = 2e-14;

// --- tabulated orbits (tests/unit/orbit/table_orbit.cpp), on numbers of order one ---
inline constexpr double table_orbit_polynomial = 6e-15;
inline constexpr double table_orbit_slope = 1e-13;
inline constexpr double table_orbit_order = 0.4;
inline constexpr double table_orbit_kepler = 1e-12;
inline constexpr double table_orbit_kepler_velocity = 1e-9;
inline constexpr double table_orbit_file = 1e-11;  // a circle by 20 rows per radian
inline constexpr double table_orbit_overhang = 1e-11;
inline constexpr double table_orbit_dates = 2e-6;  // of 1e-5 rad/s: 0.1 s, half of 2 ms, 1e-8 d
inline constexpr double table_orbit_estimate_least = 0.4;    // of the error
inline constexpr double table_orbit_estimate_most = 1e3;     // it is that of a lower order
inline constexpr double table_orbit_estimate_coarse = 1e-2;  // the limit for allow_coarse
inline constexpr double table_orbit_ends = 5e-14;            // a wave, whatever the order
inline constexpr double table_orbit_continuous = 6e-14;

}  // namespace polhode::budget
