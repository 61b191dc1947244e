// SPDX-License-Identifier: MIT
// Tolerances of tests: frames and osculation.
#pragma once

namespace polhode::budget {

// --- frames and osculation (src/system): tests/paper/section4_library.cpp,
// tests/property/osculation*.cpp, tests/unit/system ---
// Rates, energies and momenta of order one against 50-digit Hamilton's equations.
inline constexpr double paper_perturbed = 1e-14;
// Angles of the osculating momentum, of axes that may stand near a pole.
inline constexpr double paper_osculating_elements = 1e-14;
// Convective terms carried through the free transition matrix and back.
inline constexpr double paper_modified = 2e-14;
// Angular velocities of order one after 1e4 turns, against 76 digits.
inline constexpr double osculation_rate = 1e-13;
// How far canonical and osculating momentum are apart at least, for the frames of those tests.
inline constexpr double osculation_apart = 1e-3;
// Rates of Andoyer's variables on the way, where I comes near 0 too.
inline constexpr double osculation_rates = 1e-12;
// Slopes of log-log lines; rates by fourth-order differences of step 2^-6.
inline constexpr double osculation_slope = 0.005;
inline constexpr double osculation_differences = 1e-12;
// Osculating to canonical and back, and the modified set, relative.
inline constexpr double osculation_round_trip = 2e-14;
// Rates of elements in every gauge, by differences of order 8 with a step of 0.04; maps to and from
// elements; attitude after 100 revolutions in elements, rad.
inline constexpr double element_rates = 1e-11;
inline constexpr double element_maps = 1e-14;
inline constexpr double element_motion = 1e-12;
// The generating function of section 3.1 and its derivatives, actions of order one.
inline constexpr double paper_generating = 1e-14;
// Two ways to the same rate of order one; by fourth-order differences of step 1e-3; 1e-7 off a
// pole.
inline constexpr double rates_rounding = 2e-15;
inline constexpr double rates_by_differences = 5e-12;
inline constexpr double rates_next_to_pole = 1e-7;
// Derivatives of canonical states by osculating ones and back; the same states in double-double.
inline constexpr double osculation_derivatives = 1e-14;
inline constexpr double osculation_double_double = 1e-29;
// Elements of a satellite, of order one: rates beside differences of order 8; there and back; mean
// rates by 64 places of the orbit; ten orbits.
inline constexpr double orbital_rates = 1e-10;
inline constexpr double orbital_maps = 1e-14;
inline constexpr double orbital_secular = 1e-15;
inline constexpr double orbital_motion = 1e-12;
// Lagrange brackets and what follows from them, relative; and what is not canonical.
inline constexpr double andoyer_method = 2e-15;
inline constexpr double not_canonical = 1e-2;

// A deviation through one splitting step against the derivative of the step: entries of order one.
inline constexpr double splitting_deviation = 1e-14;

}  // namespace polhode::budget
