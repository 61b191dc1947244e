// SPDX-License-Identifier: MIT
// Kepler's equation at M = 0, where nothing is left to solve.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace polhode::test
