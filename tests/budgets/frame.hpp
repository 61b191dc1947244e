// SPDX-License-Identifier: MIT
// Tolerances of tests: frames.
#pragma once

namespace polhode::budget {

// --- frames (tests/unit/frame), in eps ---
// Attitude, rad, and rate over max(1, |mu|), against matrices at 76 digits and their differences.
inline constexpr double frame_attitude_eps = 4.0;
inline constexpr double frame_rate_eps = 2.0;
// The same in double-double.
inline constexpr double frame_wide = 2e-31;

// --- local vertical (tests/unit/frame/orbit_frames.cpp) ---
// Axes against those from position and velocity by hand; rates relative to mu.
inline constexpr double local_vertical_axes = 5e-14;
inline constexpr double local_vertical_differences = 1e-6;

// --- orbit plane (tests/unit/frame/orbit_frames.cpp) ---

inline constexpr double orbit_plane_axes = 5e-14;
inline constexpr double orbit_plane_differences = 2e-11;  // rad/s
inline constexpr double orbit_plane_table = 1e-11;
inline constexpr double orbit_plane_table_rate = 1e-12;  // rad/s

// --- frames from Python (python/tests/test_frames.py) ---
inline constexpr double frame_slope = 1e-13;  // rad/s, of the Moon over 200 s
// One motion in two frames, of a table's second derivatives; rad/s of a rotation of 3e-5 rad/s.
inline constexpr double frame_of_date = 1e-8;
inline constexpr double frame_of_date_rate = 3e-13;
// Attitude and rate of a frame whose rate is a formula, or a table of 15 rows of one.
inline constexpr double frame_rate_formula = 1e-15;
inline constexpr double frame_rate_table = 1e-12;

}  // namespace polhode::budget
