// SPDX-License-Identifier: MIT
// Kepler's equation at M = 0, where nothing is left to solve.
#include <gtest/gtest.h>

#include <cmath>

#include "budgets.hpp"
#include "polhode/orbit/kepler_equation.hpp"

namespace polhode::test {
namespace {

template <Real T>
void at_periapsis(double e) {
  for (const double M : {0.0, -0.0}) {
    const BasicKeplerAnomaly<T> x = eccentric_anomaly(T(M), BasicEccentricity<T>::of(T(e)));
    EXPECT_EQ(to_double(x.anomaly), 0.0) << e;
    EXPECT_EQ(to_double(x.sine), 0.0) << e;
    EXPECT_EQ(to_double(x.versine), 0.0) << e;
  }
}

TEST(KeplerEquation, NothingIsLeftAtPeriapsis) {
  for (const double e : {0.0, 0.3, 0.999, 1.001, 2.0, 1e6}) {
    at_periapsis<double>(e);
    at_periapsis<DoubleDouble>(e);
  }
}

// The exceptions for M = 0 are for no other M: e sinh H - H = M at whole numbers.
TEST(KeplerEquation, WholeMeanAnomaliesOfHyperbolas) {
  for (const double M : {1.0, -1.0, 2.0, 100.0}) {
    for (const double e : {1.5, 4.0}) {
      const auto x = eccentric_anomaly(DoubleDouble(M), BasicEccentricity<DoubleDouble>::of(e));
      EXPECT_LE(std::abs((e * sinh(x.anomaly) - x.anomaly - M).hi),
                budget::kepler_wide_eps * epsilon<DoubleDouble>() * e * std::cosh(x.anomaly.hi) *
                    std::abs(M));
      EXPECT_NEAR(x.sine.hi, std::sinh(x.anomaly.hi), std::abs(x.sine.hi) * budget::kepler_rounded);
      const double half = std::sinh(0.5 * x.anomaly.hi);
      EXPECT_NEAR(x.versine.hi, 2.0 * half * half, x.versine.hi * budget::kepler_rounded);
    }
  }
}

}  // namespace
}  // namespace polhode::test
