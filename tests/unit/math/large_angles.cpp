// SPDX-License-Identifier: MIT
// Angles beyond the reduction in 32 digits keep those of double: no table is read past its end.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
namespace {

TEST(DoubleDouble, SinesOfLargeAnglesHaveTheDigitsOfDouble) {
  for (const double size : {1.1e10, 1e15, 1e17, 1e100, 1e300, std::numeric_limits<double>::max()})
    for (const double x : {size, -size}) {
      const SinCos<DoubleDouble> r = sincos(DoubleDouble(x));
      EXPECT_EQ(r.sin.hi, std::sin(x)) << x;
      EXPECT_EQ(r.cos.hi, std::cos(x)) << x;
    }
}

TEST(DoubleDouble, TheLowPartOfALargeAngleCounts) {
  const DoubleDouble x{1e17, 5.0};  // half an ulp of 1e17 is 8
  const SinCos<DoubleDouble> r = sincos(x);
  EXPECT_NEAR(r.sin.hi, std::sin(1e17) * std::cos(5.0) + std::cos(1e17) * std::sin(5.0),
              budget::large_angle);
  EXPECT_NEAR(r.cos.hi, std::cos(1e17) * std::cos(5.0) - std::sin(1e17) * std::sin(5.0),
              budget::large_angle);
}

}  // namespace
}  // namespace polhode
