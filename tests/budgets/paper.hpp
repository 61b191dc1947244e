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

// --- generating functions (tests/unit/free/generating_function.cpp, sadov_generating_function.cpp)
// Each derivative against differences of the eighth order at fixed other arguments.
inline constexpr double generating_gradient = 1e-10;
// dS/dt + H(q, dS/dq), over T.
inline constexpr double generating_jacobi = 4e-15;
// Momenta and constants against those of the motion, away from caustics; constants of a branch.
inline constexpr double generating_motion = 6e-14;
inline constexpr double generating_branches = 5e-15;
// S along a motion over many periods, relative.
inline constexpr double generating_continuity = 2e-15;
// The paper's quadratures of Sadov's variables in double.
inline constexpr double generating_quadrature = 5e-14;
// W along a motion, ends of librations included, where it loses the 3/2 power of eps at most.
inline constexpr double generating_turning = 5e-15;
// Kinoshita's and Fukushima and Ishizaki's sets (tests/unit/free/named_sets.cpp): states again, and
// inverse times Jacobian.
inline constexpr double named_sets_round_trip = 5e-15;
inline constexpr double named_sets_canonical = 4e-14;

}  // namespace polhode::budget
