// SPDX-License-Identifier: MIT
// Orbits that the library brings along, and planets on them. Oracle: published numbers, of the
// Earth those of La2004 (Laskar et al. 2004, Astronomy and Astrophysics 428, 261, table
// INSOLN.LA2004.BTL).
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/insolation.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/planet.hpp"

namespace {

using namespace polhode;
using std::numbers::pi;

constexpr double deg = std::numbers::pi / 180.0;

// Time in kyr, eccentricity, obliquity in rad.
struct Published {
  double t, e, obliquity;
};
constexpr Published la2004[] = {{-100.0, 0.4006000253845324e-01, 0.4130265591582125e+00},
                                {-500.0, 0.3378300500269078e-01, 0.4137984270174458e+00},
                                {-1000.0, 0.3575988082961842e-01, 0.4123891471500025e+00},
                                {-2000.0, 0.1373706942140139e-01, 0.3946228147069096e+00},
                                {-5000.0, 0.2578105224411052e-01, 0.4179090011861261e+00},
                                {100.0, 0.1435426732520067e-01, 0.4037661658869975e+00},
                                {1000.0, 0.5183713170414291e-01, 0.3933641780960856e+00}};

double obliquity_at(double t, const secular::PrecessionRates& rates) {
  const secular::OrbitHistory orbit(secular::shipped_orbit("earth", 1e-3));
  using M = secular::SpinPrecession<secular::OrbitHistory>;
  const BasicProblem<M> problem{
      M(orbit, rates), secular::spin_axis(secular::planet_pole(secular::known_planet("earth"))),
      0.0, t, Splitting{.step = 2.0, .scheme = SplittingScheme::order8}};
  const Keep last{.samples = SaveAt::times({t}), .dense = false};
  return secular::spin_angles(integrate(problem, last).samples().back().s, orbit.at(t)).obliquity;
}

TEST(ShippedOrbit, TheEccentricityOfTheEarthIsThatOfLa2004) {
  const secular::ElementTable orbit = secular::shipped_orbit("earth", 1e-3);
  for (const auto& [t, e, obliquity] : la2004)
    EXPECT_NEAR(secular::eccentricity(orbit.at(t)), e,
                std::fabs(t) <= 1000.0 ? budget::shipped_orbit_recent : budget::shipped_orbit_5_myr)
        << t;
}

TEST(ShippedOrbit, TheObliquityOfTheEarthIsThatOfLa2004) {
  secular::PrecessionRates rates = secular::planet_rates(secular::known_planet("earth"), 1e-3);
  EXPECT_NEAR(obliquity_at(-100.0, rates) / deg, la2004[0].obliquity / deg,
              budget::shipped_orbit_100_kyr);
  rates.drift = -5.2e-7;  // per kyr: tides of the Moon
  for (const auto& [t, e, obliquity] : la2004)
    if (std::fabs(t) <= 1000.0) {
      EXPECT_NEAR(obliquity_at(t, rates) / deg, obliquity / deg, budget::shipped_orbit_1_myr) << t;
    }
}

TEST(ShippedOrbit, ReachesTwentyMillionYears) {
  for (const std::string_view name : secular::shipped_orbit_names()) {
    const secular::ElementTable orbit = secular::shipped_orbit(name);
    EXPECT_EQ(orbit.first_time(), -20e6);
    EXPECT_EQ(orbit.last_time(), 20e6);
  }
  EXPECT_REJECTED(secular::shipped_orbit("venus"), "expected earth or mars");
}

// Konopliv et al. (2016): the node goes back by 7.6083 arcsec a year. Obliquity: 25.19 degrees.
TEST(PlanetSpin, MarsPrecessesAsMeasured) {
  const secular::ElementTable orbit = secular::shipped_orbit("mars");
  const secular::PlanetSpin& mars = secular::known_planet("mars");
  const secular::OrbitElements now = orbit.at(0.0);
  const double obliquity =
      secular::spin_angles(secular::spin_axis(secular::planet_pole(mars)), now).obliquity;
  EXPECT_NEAR(obliquity / deg, 25.19, budget::planet_obliquity);
  const double rate = secular::planet_rates(mars, 1.0).torque(0.0, now.k * now.k + now.h * now.h);
  EXPECT_NEAR(rate * std::cos(obliquity) * 3600.0 / deg, 7.6083, budget::planet_rate);
  EXPECT_REJECTED(secular::known_planet("venus"), "expected earth or mars");
}

TEST(OrbitElements, TurnThereAndBack) {
  const secular::OrbitElements o = secular::orbit_elements(0.3, 1.1, 0.7, 2.2);
  const Quaternion q = rotation_z(0.4) * rotation_x(0.9);
  const secular::OrbitElements there = secular::turned(o, q),
                               back = secular::turned(there, conj(q));
  EXPECT_LT(norm(secular::orbit_normal(there) - rotate(q, secular::orbit_normal(o))),
            budget::secular_rounding);
  EXPECT_LT(
      norm(secular::pericentre_direction(there) - rotate(q, secular::pericentre_direction(o))),
      budget::secular_rounding);
  EXPECT_NEAR(secular::eccentricity(there), 0.3, budget::secular_rounding);
  EXPECT_NEAR(back.k, o.k, budget::secular_rounding);
  EXPECT_NEAR(back.h, o.h, budget::secular_rounding);
  EXPECT_NEAR(back.q, o.q, budget::secular_rounding);
  EXPECT_NEAR(back.p, o.p, budget::secular_rounding);
}

// Sunlight of a day. Oracles: the sum over the moments of the day, and the light that a sphere
// catches in a year.

constexpr secular::SpinAngles angles{0.41, 0.0, 1.8, 0.0};
constexpr double e = 0.05;

// From the direction of the star in equatorial axes, moment by moment.
double summed(const secular::InsolationPlace& place) {
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
      const secular::InsolationPlace place{latitude, longitude, 1361.0};
      EXPECT_NEAR(secular::daily_insolation(angles, e, place) / place.flux,
                  summed(place) / place.flux, budget::insolation_mean)
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
                secular::daily_insolation(angles, e, {std::asin(std::cos(theta)), longitude});
    }
    sum += of_day * r * r / std::sqrt(1.0 - e * e) / longitudes;  // equal times
  }
  EXPECT_NEAR(sum, 0.25 / std::sqrt(1.0 - e * e), budget::insolation_mean);
}

TEST(Insolation, PolesAndNightsAreOrdinary) {
  const double summer = secular::daily_insolation(angles, 0.0, {0.5 * pi, 0.5 * pi});
  EXPECT_NEAR(summer, std::sin(angles.obliquity), budget::insolation_flux);
  EXPECT_EQ(secular::daily_insolation(angles, 0.0, {-0.5 * pi, 0.5 * pi}), 0.0);
  EXPECT_TRUE(std::isnan(secular::daily_insolation(angles, 0.0, {1.6, 0.0})));
  const secular::SpinAngles upright{0.0, std::nan(""), 0.3, 0.0};
  EXPECT_NEAR(secular::daily_insolation(upright, 0.0, {0.0, 1.0}), 1.0 / pi,
              budget::insolation_flux);
}

}  // namespace
