// SPDX-License-Identifier: MIT
// A point of an ellipse by its mean anomaly against the orbit that moves there.
#include "polhode/orbit/mean_ellipse.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "budgets.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;

TEST(MeanEllipse, IsWhereTheOrbitIs) {
  test::Worst worst;
  for (const double e : {0.0, 0.017, 0.5, 0.97})
    for (const double pericentre : {0.0, 0.3, -2.0})
      for (const double M : {0.0, 0.7, 3.0, -1.1}) {
        const KeplerOrbit orbit({.gm = 1.0,
                                 .pericentre = 1.5 * (1.0 - e),
                                 .eccentricity = e,
                                 .argument = pericentre,
                                 .mean_anomaly = M});
        worst.add(norm(on_ellipse(1.5, e, M, pericentre) - orbit.position(0.0)) /
                  (1.5 * (1.0 - e)));
      }
  EXPECT_LT(worst.value(), budget::mean_ellipse);
}

TEST(MeanEllipse, IsNaNWhereThereIsNone) {
  for (const double e : {-0.1, 1.0, std::nan("")})
    EXPECT_TRUE(std::isnan(on_ellipse(1.0, e, 0.5, 0.0).x)) << e;
}

}  // namespace
