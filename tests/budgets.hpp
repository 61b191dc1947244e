// SPDX-License-Identifier: MIT
// Every tolerance of every test, by name. Nothing is typed in a test.
#pragma once

namespace polhode::budget {

// --- the paper's equations, at 50 digits (tests/paper) ---
// Identities without a derivative or an integral.
inline constexpr double paper_exact = 1e-45;
// Identities with central differences of step 1e-16, at most of a quadrature.
inline constexpr double paper_derivative = 1e-28;
// Identities with a quadrature.
inline constexpr double paper_quadrature = 1e-33;
// A printed form counts as wrong when it misses by at least this much.
inline constexpr double paper_misprint = 1e-2;
// The library's doubles against 50 digits, at states where no chart is near a pole.
inline constexpr double paper_library = 4e-15;

// --- the oracle of free rotation, 76 digits (tests/oracle) ---
// Against typed digits of another program (30 of them).
inline constexpr double oracle_typed_digits = 1e-30;
// Between two of its own ways, near the separatrix and after 1e12 radians too.
inline constexpr double oracle_agreement = 1e-56;
// Of a transition matrix against central differences of step 1e-25.
inline constexpr double oracle_differences = 1e-45;

// --- free rotation (tests/property) ---
// Rotation angle, rad, and |dg|/G: every case of the random set and of the exact separatrix.
inline constexpr double free_attitude = 1e-14;
inline constexpr double free_attitude_median = 1e-15;
// Hard cases: free_attitude + free_separatrix_growth (N + 1) G^2/|D2| after N half periods.
inline constexpr double free_separatrix_growth = 3.0 * 2.220446049250313e-16;
// After 1e6 and 1e9 turns, for |2 T I2/G^2 - 1| > 1e-3.
inline constexpr double free_attitude_1e6_turns = 1e-14;
inline constexpr double free_attitude_1e9_turns = 1e-12;
// State transition matrix over ten turns, each 3x3 block relative to its norm.
inline constexpr double free_transition = 1e-12;

}  // namespace polhode::budget
