// SPDX-License-Identifier: MIT
// Which mutant a test program runs with: POLHODE_MUTANT, read once; 0 is none. Included before
// everything else in every source of the tree that tools/mutate builds, and nowhere else.
#pragma once

#include <cstdlib>
#include <type_traits>

namespace polhode_mutants {

constexpr int most = 10000;

inline const int chosen = [] {
  const char* number = std::getenv("POLHODE_MUTANT");
  return number != nullptr ? std::atoi(number) : 0;
}();

// Where a test has been: read by recorder.cpp.
inline short reached[most];

// A constant keeps its value: no mutant is active while the compiler computes.
[[gnu::always_inline]] constexpr inline bool active(int number) noexcept {
  if (std::is_constant_evaluated()) return false;
  reached[number] = 1;
  return chosen == number;
}

}  // namespace polhode_mutants
