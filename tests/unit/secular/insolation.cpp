// SPDX-License-Identifier: MIT
// Sunlight of a day. Oracles: the sum over the moments of the day, and the light that a sphere
// catches in a year.
#include "polhode/secular/insolation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"

namespace {

using namespace polhode;
using std::numbers::pi;

constexpr SpinAngles angles{0.41, 0.0, 1.8, 0.0};
constexpr double e = 0.05;

// From the direction of the star in equatorial axes, moment by moment.
double summed(const InsolationPlace& place) {
  const double sine = std::sin(angles.obliquity) * std::sin(place.longitude);
  const double cosine = std::sqrt(1.0 - sine * sine);
  // seen from the star the planet is opposite, and its true anomaly counts from the pericentre
  const double anomaly = place.longitude + pi - angles.pericentre;
  const double distance = (1.0 - e * e) / (1.0 + e * std::cos(anomaly));
  constexpr int moments = 4000;
  double sum = 0.0;
  for (int k = 0; k < moments; ++k) {
    const double height =
        std::sin(place.latitude) * sine +
        std::cos(place.latitude) * cosine * std::cos(2.0 * pi * (k + 0.5) / moments);
    if (height > 0.0) sum += height;
  }
  return place.flux * sum / moments / (distance * distance);
}

TEST(Insolation, IsTheMeanOverTheMomentsOfADay) {
  for (double latitude = -1.5; latitude < 1.6; latitude += 0.25)
    for (double longitude = 0.0; longitude < 6.2; longitude += 0.4) {
      const InsolationPlace place{latitude, longitude, 1361.0};
      EXPECT_NEAR(daily_insolation(angles, e, place) / place.flux, summed(place) / place.flux,
                  budget::insolation_mean)
          << latitude << " " << longitude;
    }
}

// A quarter of the flux at the semi-major axis over sqrt(1 - e^2): of any obliquity.
TEST(Insolation, OverSphereAndYearIsAQuarter) {
  constexpr int latitudes = 400, longitudes = 200;
  double sum = 0.0;
  for (int j = 0; j < longitudes; ++j) {
    const double longitude = 2.0 * pi * j / longitudes;
    const double anomaly = longitude + pi - angles.pericentre;
    const double r = (1.0 - e * e) / (1.0 + e * std::cos(anomaly));
    double of_day = 0.0;  // Gauss-Chebyshev in sin(latitude): smooth at the poles
    for (int i = 0; i < latitudes; ++i) {
      const double theta = pi * (i + 0.5) / latitudes;
      of_day += std::sin(theta) * (pi / latitudes) / 2.0 *
                daily_insolation(angles, e, {std::asin(std::cos(theta)), longitude});
    }
    sum += of_day * r * r / std::sqrt(1.0 - e * e) / longitudes;  // equal times
  }
  EXPECT_NEAR(sum, 0.25 / std::sqrt(1.0 - e * e), budget::insolation_mean);
}

TEST(Insolation, PolesAndNightsAreOrdinary) {
  const double summer = daily_insolation(angles, 0.0, {0.5 * pi, 0.5 * pi});
  EXPECT_NEAR(summer, std::sin(angles.obliquity), budget::insolation_flux);
  EXPECT_EQ(daily_insolation(angles, 0.0, {-0.5 * pi, 0.5 * pi}), 0.0);
  EXPECT_TRUE(std::isnan(daily_insolation(angles, 0.0, {1.6, 0.0})));
  const SpinAngles upright{0.0, std::nan(""), 0.3, 0.0};
  EXPECT_NEAR(daily_insolation(upright, 0.0, {0.0, 1.0}), 1.0 / pi, budget::insolation_flux);
}

}  // namespace
