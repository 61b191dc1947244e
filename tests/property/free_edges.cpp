// SPDX-License-Identifier: MIT
// FreeRotation where digits are easily lost without a word: next to the middle axis down to the
// smallest double, as near to the separatrix as doubles come, after 1e9 turns there, and beyond
// 2^52 periods.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "oracle/free_accuracy.hpp"

namespace {

namespace budget = polhode::budget;
using oracle::FreeCase;

void expect_exact(const FreeCase& c, double allowed = budget::free_state) {
  const oracle::FreeError e = oracle::free_error(c);
  EXPECT_LE(e.angle, allowed) << description(c);
  EXPECT_LE(e.momentum, allowed) << description(c);
}

FreeCase case_of(const polhode::Vec3& moments, const polhode::Vec3& g, double turns) {
  FreeCase c{moments, {{0.5, 0.5, -0.125, 0.75}, g}, 0.0, 0.0};
  set_time(c, turns);
  return c;
}

TEST(FreeEdges, NextToTheMiddleAxisDownToTheSmallestDouble) {
  expect_exact(case_of({1.0, 1.7, 2.1}, {1e-170, 1.0, 0.0}, 1.0));
  expect_exact(case_of({1.0, 1.7, 2.1}, {1e-170, 1.0, 0.7e-170}, 1000.0));
  // the squares, and the quotient, of these are no doubles
  expect_exact(case_of({1.0, 1.7, 2.1}, {1e-300, 1e300, -3e-299}, 1000.0));
}

// The distance is 4e-21 of G^2: every digit of it hangs on the last ones of the moments.
TEST(FreeEdges, AsNearToTheSeparatrixAsDoublesCome) {
  for (const double turns : {32.0, 1e6, 1e12})
    expect_exact(case_of({0.32200176517297396, 0.3789751609709488, 0.661517593383879},
                         {0.8233251531952871, -0.3, 0.5299161674818204}, turns));
}

// The phase loses some 2^-104 of itself, and no half period.
TEST(FreeEdges, BeyondTheIntegersThatADoubleCounts) {
  for (const double turns : {1e16, -3e17, 1e18, 0.7e19, -1e20})
    expect_exact(
        case_of({1.0, 1.7, 2.1}, {0.3, 1.0, 0.284}, turns),
        budget::free_state + budget::free_phase * 2.0 * std::numbers::pi * std::abs(turns));
}

}  // namespace
