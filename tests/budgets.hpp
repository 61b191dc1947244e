// SPDX-License-Identifier: MIT
// Every tolerance of every test, by name. Nothing is typed in a test.
#pragma once

namespace polhode::budget {

// --- the paper's equations, at 50 digits (tests/paper) ---
// Identities without a derivative or an integral.
inline constexpr double paper_exact = 1e-44;
// Identities with central differences of step 1e-16, at most of a quadrature.
inline constexpr double paper_derivative = 1e-26;
// Identities with a quadrature.
inline constexpr double paper_quadrature = 1e-32;
// A printed form counts as wrong when it misses by at least this much.
inline constexpr double paper_misprint = 1e-2;

}  // namespace polhode::budget
