// SPDX-License-Identifier: MIT
#include "polhode/free/rounding_sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "budgets.hpp"

namespace {

using namespace polhode;
constexpr double eps = std::numeric_limits<double>::epsilon();

// A sphere at rate w = g / I: one rounding of g or I turns it by eps w t / 2 to eps w t more.
TEST(RoundingSensitivity, OfASphereIsThatOfItsAngle) {
  const FreeRotation motion(Body(1.5, 1.5, 1.5), {{1, 0, 0, 0}, {0, 0, 3.3}});
  const double w = 3.3 / 1.5;
  for (const double t : {1e3, 1e6, 1e9}) {
    const double moved = rounding_sensitivity(motion, t);
    EXPECT_GE(moved, budget::sensitivity_least * eps * w * t);
    EXPECT_LE(moved, budget::sensitivity_most * eps * w * t);
  }
}

TEST(RoundingSensitivity, IsAtLeastARoundingOfTheState) {
  const FreeRotation motion(Body(1.0, 1.7, 2.1), {{1, 0, 0, 0}, {0.3, 0.2, 1.0}});
  EXPECT_LE(rounding_sensitivity(motion, 0.0), budget::sensitivity_most * eps);
  EXPECT_GT(rounding_sensitivity(motion, 1e6), budget::sensitivity_of_a_turn * eps * 1e6);
}

// Next to the middle axis the next flip comes by -ln(g1)/n: a rounding of a moment moves the
// distance from the separatrix by eps G^2, that is by all of it.
TEST(RoundingSensitivity, IsEverythingWhereTheSeparatrixIsARoundingAway) {
  const FreeRotation near(Body(0.32200176517297396, 0.3789751609709488, 0.661517593383879),
                          {{1, 0, 0, 0}, {0.8233251531952871, -0.3, 0.5299161674818204}});
  const FreeRotation far(Body(1.0, 1.7, 2.1), {{1, 0, 0, 0}, {0.3, 0.2, 1.0}});
  EXPECT_GT(rounding_sensitivity(near, 200.0),
            budget::sensitivity_at_separatrix * rounding_sensitivity(far, 200.0));
}

TEST(RoundingSensitivity, IsHalfATurnWhereNoPhaseIsLeft) {
  const Body body(1.0, 2.0, 3.0);
  for (const Vec3& g : {Vec3{1e30, 0.0, 0.0}, Vec3{1e30, 2.0, 3.0}, Vec3{0.3, 0.2, 1.0}})
    EXPECT_EQ(rounding_sensitivity(FreeRotation(body, {{1, 0, 0, 0}, g}), 1e30), std::acos(-1.0));
}

TEST(RoundingSensitivity, TakesFlatBodiesAndRefusesNoTime) {
  const FreeRotation flat(Body(1.0, 2.0, 3.0), {{1, 0, 0, 0}, {0.3, 0.2, 1.0}});
  EXPECT_TRUE(std::isfinite(rounding_sensitivity(flat, 10.0)));
  EXPECT_TRUE(std::isnan(rounding_sensitivity(flat, HUGE_VAL)));
  EXPECT_TRUE(std::isnan(rounding_sensitivity(flat, std::nan(""))));
}

}  // namespace
