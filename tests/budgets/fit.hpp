// SPDX-License-Identifier: MIT
// Tolerances of tests: fits.
#pragma once

namespace polhode::budget {

// --- losses (tests/unit/fit): their values and slopes, of the value ---
inline constexpr double loss = 1e-14;

}  // namespace polhode::budget
