// SPDX-License-Identifier: MIT
// Tolerances of tests: dates, planets, satellites.
#pragma once

namespace polhode::budget {

// --- dates and positions of the planets (tests/unit/ephemeris) ---
inline constexpr double date_second = 2e-10;
inline constexpr double date_tdb = 5e-5;           // s: what two terms leave out
inline constexpr double ephemeris_stated = 1e-13;  // au, ERFA's own tests
inline constexpr double ephemeris_sun_deg = 0.012;
inline constexpr double ephemeris_sun_distance = 1e-4;
inline constexpr double ephemeris_moon_deg = 0.35;
inline constexpr double ephemeris_moon_distance = 3e-3;
inline constexpr double ephemeris_rounding_km = 1e-6;
inline constexpr double ephemeris_orbit = 1e-10;  // of the distance, of scenarios
inline constexpr double ephemeris_gm = 1e-4;
// Terms read from a text against formulas in NumPy (python/tests/test_scenario_terms.py), relative.
inline constexpr double scenario_torque = 1e-13;
inline constexpr double ephemeris_table = 5e-12;  // of the distance
inline constexpr double teme_arcsec = 0.06;       // 1990 to 2030

// --- orbits and the Earth from Python (python/tests/test_ephemeris.py, test_satellites.py) ---
inline constexpr double python_table = 1e-13;
inline constexpr double python_table_slope = 2e-10;
inline constexpr double published_precession = 1e-3;
inline constexpr double published_nutation = 2e-3;
// The averaged torque to first order leaves out evection and variation of the Moon.
inline constexpr double averaged_precession = 5e-3;
inline constexpr double ephemeris_near_arcsec = 10.0;  // of the theory of the planets, 9 and 1
inline constexpr double ephemeris_far_arcsec = 12.0;
inline constexpr double ephemeris_far_earth_km = 300.0;  // along the line of sight: 247 and 42
inline constexpr double ephemeris_far_moon_km = 45.0;
// Of Mars at its nearest, times that seen from the Sun: the Earth's own is 0.002 of it.
inline constexpr double ephemeris_error_growth = 0.01;
inline constexpr double ephemeris_error_margin = 1.1;  // what is said over what was measured
inline constexpr double sgp4_km = 2e-8;                // its verification run prints 1e-8
inline constexpr double sgp4_km_s = 2e-9;
inline constexpr double sgp4_slope = 2e-3;             // km/s
inline constexpr double sgp4_plain_difference = 5e-7;  // km/s, of a second
inline constexpr double sgp4_between_rows = 1e-5;      // km; where SGP4 has kinks they are larger
inline constexpr double spice_time_s = 5e-7;  // doubles of 1e9 s, and TT for TDB in its own formula
inline constexpr double teme_km = 1.2e-3;
inline constexpr double tle_epoch = 1e-3;  // s, its last digit
inline constexpr double omm_km = 1e-2;

// --- Moon and Sun in Delaunay's arguments (tests/unit/ephemeris/earth.cpp) ---
// Over the distance; the Sun: perturbations of the Earth by the planets, 30 arcsec.
inline constexpr double delaunay_moon = 5e-11;
inline constexpr double delaunay_sun = 1.5e-4;
// Relative, of differences over 2e-4 centuries.
inline constexpr double delaunay_rates = 1e-9;

// rad: a rounding of the date, times the rates of the arguments.
inline constexpr double iau_nutation = 1e-16;

// Orientation and dipole of the Earth (tests/unit/ephemeris/earth.cpp); the oracles are rough.
inline constexpr double earth_meridian_deg = 0.002;
inline constexpr double earth_pole_arcsec = 20.0;
inline constexpr double igrf_nT = 0.1;
inline constexpr double earth_rotation = 1e-14;

}  // namespace polhode::budget
