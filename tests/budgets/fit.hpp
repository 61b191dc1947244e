// SPDX-License-Identifier: MIT
// Tolerances of tests: fits.
#pragma once

namespace polhode::budget {

// --- losses (tests/unit/fit): their values and slopes, of the value ---
inline constexpr double loss = 1e-14;

// --- scans: chi-square over that of no harmonics, against long double; against another origin of
// time and another unit ---
inline constexpr double fourier_scan = 1e-10, fourier_shift = 1e-10;

// --- frequencies of a scan beside those of the motion: in errors, scaled; periods of labels ---
inline constexpr double scanned_frequency = 6.0, labelled_period = 1e-2;
// --- power in lines that symmetry forbids; rise of chi-square an error off ---
inline constexpr double forbidden_lines = 1e-4, unit_rise = 0.1;

// --- least P_psi/P_phi of an ellipsoid with c/a = 1e-3 in short-axis mode, b/a = 0.05 in long-axis
// mode
inline constexpr double flat_ratio = 1.001, thin_ratio = 0.01;

// --- times of sessions; peaks of the window, in turns over the time base ---
inline constexpr double scan_times = 1e-9, window_peak = 0.1;

// --- periods of bodies made for them, in eps; their moments, angles and periods of labels against
// those put in ---
inline constexpr double periods_of_body = 8.0, moments_of_body = 1e-12;

}  // namespace polhode::budget
