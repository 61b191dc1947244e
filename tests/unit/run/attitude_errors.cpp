// SPDX-License-Identifier: MIT
// Errors of an attitude about the axes, of covariances that are rounded or not known.
#include "run/detail/attitude_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace polhode {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Mat3 diagonal(double x, double y, double z) {
  Mat3 c;
  c(0, 0) = x;
  c(1, 1) = y;
  c(2, 2) = z;
  return c;
}

TEST(AttitudeErrors, AVarianceThatIsRoundedBelowZeroIsZero) {
  const Mat3 c = diagonal(0.25, -1e-20, nan);
  EXPECT_EQ(detail::error_about(c, 0), 0.5);
  EXPECT_EQ(detail::error_about(c, 1), 0.0);
  EXPECT_TRUE(std::isnan(detail::error_about(c, 2)));
}

TEST(AttitudeErrors, AnErrorThatIsNotKnownIsOpenAboutAnyAxis) {
  EXPECT_FALSE(detail::is_open(diagonal(1.0, 0.5, -1e-20)));
  for (const double open : {1.5, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(detail::is_open(diagonal(open, 0.5, 0.5))) << open;
    EXPECT_TRUE(detail::is_open(diagonal(0.5, open, 0.5))) << open;
    EXPECT_TRUE(detail::is_open(diagonal(0.5, 0.5, open))) << open;
  }
}

}  // namespace
}  // namespace polhode
