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

// --- local vertical (tests/unit/frame/local_vertical.cpp) ---
// Axes against those from position and velocity by hand; rates relative to mu.
inline constexpr double local_vertical_axes = 5e-14;
inline constexpr double local_vertical_differences = 1e-6;
}  // namespace polhode::budget
