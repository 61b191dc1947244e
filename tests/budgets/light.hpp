// SPDX-License-Identifier: MIT
// Tolerances of tests: how bright a body looks.
#pragma once

namespace polhode::budget {}  // namespace polhode::budget

namespace polhode::budget {

// --- light curves (tests/unit/light/light_curve.cpp) ---
inline constexpr double light_flux = 1e-14;       // relative
inline constexpr double light_magnitude = 1e-14;  // mag, of 25
inline constexpr double light_aspect = 4e-16;     // rad, and relative of small angles
inline constexpr double light_time_s = 5e-9;      // of times of 1e7 s
inline constexpr double light_time_km = 1e-7;     // of vectors of 2e8 km

// --- light curves in files (tests/unit/tables/light_curves.cpp) ---
inline constexpr double light_date_s = 1e-8;  // a decimal of a day, in seconds
inline constexpr double light_tdb_s = 1e-3;   // of TT for TDB, over some hours
inline constexpr double light_mars_km = 2e4;  // as published, to four digits, and 40 arcsec

}  // namespace polhode::budget
