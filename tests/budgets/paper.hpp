// SPDX-License-Identifier: MIT
// Tolerances of tests: the paper's equations.
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
// Poisson brackets of Serret's and Sadov's sets, which grow towards the separatrix.
inline constexpr double paper_library_brackets = 2e-14;
// dT/dI of Sadov's actions, by differences of order 8.
inline constexpr double paper_library_slopes = 4e-12;
// Of Serret's and Sadov's sets, at |D2| > 0.02 G^2.
inline constexpr double paper_library_adapted = 1e-14;

}  // namespace polhode::budget
