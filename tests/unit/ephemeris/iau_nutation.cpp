// SPDX-License-Identifier: MIT
// IAU 2000A against the published test value of SOFA and ERFA.
#include "polhode/ephemeris/iau_nutation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "budgets.hpp"

namespace {

// MJD 53736.0 TT: t_sofa_c.c, t_nut00a.
TEST(IauNutation, IsThatOfSofa) {
  const polhode::IauNutation at = polhode::iau_nutation((53736.0 - 51544.5) / 36525.0);
  EXPECT_NEAR(at.longitude, -0.9630909107115518431e-5, polhode::budget::iau_nutation);
  EXPECT_NEAR(at.obliquity, 0.4063239174001678710e-4, polhode::budget::iau_nutation);
  EXPECT_TRUE(
      std::isnan(polhode::iau_nutation(std::numeric_limits<double>::quiet_NaN()).longitude));
}

}  // namespace
