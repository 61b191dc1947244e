// SPDX-License-Identifier: MIT
// Orbits that the library brings along, and planets on them. Oracle: published numbers, of the
// Earth those of La2004 (Laskar et al. 2004, Astronomy and Astrophysics 428, 261, table
// INSOLN.LA2004.BTL).
#include "polhode/secular/shipped_orbit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/planet.hpp"

namespace {

using namespace polhode;

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

double obliquity_at(double t, const PrecessionRates& rates) {
  const OrbitHistory orbit(shipped_orbit("earth", 1e-3));
  using M = SpinPrecession<OrbitHistory>;
  const BasicProblem<M> problem{M(orbit, rates), spin_axis(planet_pole(known_planet("earth"))), 0.0,
                                t, Splitting{.step = 2.0, .scheme = SplittingScheme::order8}};
  const Keep last{.samples = SaveAt::times({t}), .dense = false};
  return spin_angles(integrate(problem, last).samples().back().s, orbit.at(t)).obliquity;
}

TEST(ShippedOrbit, TheEccentricityOfTheEarthIsThatOfLa2004) {
  const ElementTable orbit = shipped_orbit("earth", 1e-3);
  for (const auto& [t, e, obliquity] : la2004)
    EXPECT_NEAR(eccentricity(orbit.at(t)), e,
                std::fabs(t) <= 1000.0 ? budget::shipped_orbit_recent : budget::shipped_orbit_5_myr)
        << t;
}

TEST(ShippedOrbit, TheObliquityOfTheEarthIsThatOfLa2004) {
  PrecessionRates rates = planet_rates(known_planet("earth"), 1e-3);
  EXPECT_NEAR(obliquity_at(-100.0, rates) / deg, la2004[0].obliquity / deg,
              budget::shipped_orbit_100_kyr);
  rates.drift = -5.2e-7;  // per kyr: tides of the Moon
  for (const auto& [t, e, obliquity] : la2004)
    if (std::fabs(t) <= 1000.0) {
      EXPECT_NEAR(obliquity_at(t, rates) / deg, obliquity / deg, budget::shipped_orbit_1_myr) << t;
    }
}

TEST(ShippedOrbit, ReachesTwentyMillionYears) {
  for (const std::string_view name : shipped_orbit_names()) {
    const ElementTable orbit = shipped_orbit(name);
    EXPECT_EQ(orbit.first_time(), -20e6);
    EXPECT_EQ(orbit.last_time(), 20e6);
  }
  EXPECT_REJECTED(shipped_orbit("venus"), "expected earth or mars");
}

// Konopliv et al. (2016): the node goes back by 7.6083 arcsec a year. Obliquity: 25.19 degrees.
TEST(PlanetSpin, MarsPrecessesAsMeasured) {
  const ElementTable orbit = shipped_orbit("mars");
  const PlanetSpin& mars = known_planet("mars");
  const OrbitElements now = orbit.at(0.0);
  const double obliquity = spin_angles(spin_axis(planet_pole(mars)), now).obliquity;
  EXPECT_NEAR(obliquity / deg, 25.19, budget::planet_obliquity);
  const double rate = planet_rates(mars, 1.0).torque(0.0, now.k * now.k + now.h * now.h);
  EXPECT_NEAR(rate * std::cos(obliquity) * 3600.0 / deg, 7.6083, budget::planet_rate);
  EXPECT_REJECTED(known_planet("venus"), "expected earth or mars");
}

TEST(OrbitElements, TurnThereAndBack) {
  const OrbitElements o = orbit_elements(0.3, 1.1, 0.7, 2.2);
  const Quaternion q = rotation_z(0.4) * rotation_x(0.9);
  const OrbitElements there = turned(o, q), back = turned(there, conj(q));
  EXPECT_LT(norm(orbit_normal(there) - rotate(q, orbit_normal(o))), budget::secular_rounding);
  EXPECT_LT(norm(pericentre_direction(there) - rotate(q, pericentre_direction(o))),
            budget::secular_rounding);
  EXPECT_NEAR(eccentricity(there), 0.3, budget::secular_rounding);
  EXPECT_NEAR(back.k, o.k, budget::secular_rounding);
  EXPECT_NEAR(back.h, o.h, budget::secular_rounding);
  EXPECT_NEAR(back.q, o.q, budget::secular_rounding);
  EXPECT_NEAR(back.p, o.p, budget::secular_rounding);
}

}  // namespace
