// SPDX-License-Identifier: MIT
// Tolerances of tests: text and files.
#pragma once

namespace polhode::budget {

// --- text and files (tests/unit/text, tables, output, scenario, run) ---
// A state read from text against the same state built directly; momentum of order ten.
inline constexpr double io_state = 4e-15;
// Serret elements of two states of one motion.
inline constexpr double io_elements = 4e-14;
// Columns of a row of `convert` after a round trip through another chart, numbers of order one.
inline constexpr double io_convert = 4e-15;

// The rate of a fit to 41 rates and angles with noise, rad/s: some errors of it.
inline constexpr double measured_rate = 0.002;

// --- ensembles: numbers of a file in their units, lengths of directions ---
inline constexpr double ensemble_rounding = 1e-14;

}  // namespace polhode::budget
