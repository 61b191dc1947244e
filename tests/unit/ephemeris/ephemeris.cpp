// SPDX-License-Identifier: MIT
// Positions of Sun, Moon and planets: against the values that ERFA's own tests state, against low
// precision formulas of other origin, and their tables.
#include "polhode/ephemeris/ephemeris.hpp"

#include <erfa.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "polhode/error.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using enum ephemeris::Planetary;
using polhode::test::larger;
using polhode::test::Worst;

constexpr double au = 149597870.7;
constexpr double arcsec = std::numbers::pi / 648000.0;
constexpr double degree = std::numbers::pi / 180.0;

ephemeris::Date tdb(double mjd) { return {ephemeris::TimeScale::TDB, 2400000.5, mjd}; }

// t_epv00, t_plan94 of ERFA's t_erfa_c.c
TEST(Ephemeris, IsThatOfErfa) {
  const Vec3 earth_there{-0.7757238809297706813, 0.5598052241363340596, 0.2426998466481686993};
  EXPECT_LT(norm((1.0 / au) * ephemeris::planetary_position(earth, sun, tdb(53411.52501161)) -
                 earth_there),
            budget::ephemeris_stated);
  const Vec3 mercury_there{0.2945293959257430832, -0.2452204176601049596, -0.1615427700571978153};
  EXPECT_LT(
      norm((1.0 / au) * ephemeris::planetary_position(mercury, sun, tdb(43999.9)) - mercury_there),
      budget::ephemeris_stated);
}

// Astronomical Almanac, page C5: the Sun to 0.01 deg from 1950 to 2050.
TEST(Ephemeris, TheSunIsWhereTheAlmanacPutsIt) {
  for (int k = -12; k <= 12; ++k) {
    const double n = 730.3 * k;
    const double L = 280.460 + 0.9856474 * n, g = (357.528 + 0.9856003 * n) * degree;
    const double longitude =
        L + 1.915 * std::sin(g) + 0.020 * std::sin(2.0 * g) - 1.397 * n / 36525.0;  // to J2000
    const double R = 1.00014 - 0.01671 * std::cos(g) - 0.00014 * std::cos(2.0 * g);
    const Vec3 x = ephemeris::planetary_position(sun, earth, tdb(51544.5 + n));
    const double obliquity = 23.4393 * degree;
    const double there =
        std::atan2(std::cos(obliquity) * x.y + std::sin(obliquity) * x.z, x.x) / degree;
    EXPECT_NEAR(std::remainder(there - longitude, 360.0), 0.0, budget::ephemeris_sun_deg);
    EXPECT_NEAR(norm(x) / au, R, budget::ephemeris_sun_distance);
  }
}

// Astronomical Almanac, page D22: the Moon to 0.3 deg.
TEST(Ephemeris, TheMoonIsWhereTheAlmanacPutsIt) {
  const auto turn = [](double constant, double rate, double T) {
    return std::sin((constant + rate * T) * degree);
  };
  for (int k = -12; k <= 12; ++k) {
    const double T = 0.0403 * k;
    const double longitude = 218.32 + 481267.881 * T + 6.29 * turn(135.0, 477198.87, T) -
                             1.27 * turn(259.3, -413335.36, T) + 0.66 * turn(235.7, 890534.22, T) +
                             0.21 * turn(269.9, 954397.74, T) - 0.19 * turn(357.5, 35999.05, T) -
                             0.11 * turn(186.5, 966404.03, T) - 1.397 * T;
    const double latitude = 5.13 * turn(93.3, 483202.02, T) + 0.28 * turn(228.2, 960400.89, T) -
                            0.28 * turn(318.3, 6003.15, T) - 0.17 * turn(217.6, -407332.21, T);
    const Vec3 x = ephemeris::planetary_position(moon, earth, tdb(51544.5 + 36525.0 * T));
    const double e = 23.4393 * degree;
    const double y = std::cos(e) * x.y + std::sin(e) * x.z;
    const double z = std::cos(e) * x.z - std::sin(e) * x.y;
    EXPECT_NEAR(std::remainder(std::atan2(y, x.x) / degree - longitude, 360.0), 0.0,
                budget::ephemeris_moon_deg);
    EXPECT_NEAR(std::asin(z / norm(x)) / degree, latitude, budget::ephemeris_moon_deg);
    const double parallax = 0.9508 + 0.0518 * turn(225.0, 477198.87, T) +
                            0.0095 * turn(349.3, -413335.36, T) +
                            0.0078 * turn(325.7, 890534.22, T) + 0.0028 * turn(359.9, 954397.74, T);
    EXPECT_NEAR(norm(x) * std::sin(parallax * degree) / 6378.14, 1.0,
                budget::ephemeris_moon_distance);
  }
}

TEST(Ephemeris, PairsAddUp) {
  const ephemeris::Date at = tdb(58000.25);
  const Vec3 around = ephemeris::planetary_position(moon, earth, at) +
                      ephemeris::planetary_position(earth, sun, at) +
                      ephemeris::planetary_position(sun, jupiter, at) +
                      ephemeris::planetary_position(jupiter, moon, at);
  EXPECT_LT(norm(around), budget::ephemeris_rounding_km);
  EXPECT_EQ(ephemeris::planetary_position(earth, moon, at),
            -ephemeris::planetary_position(moon, earth, at));
}

TEST(Ephemeris, TablesHoldPositionsBetweenRows) {
  const ephemeris::Date epoch = ephemeris::calendar_date(ephemeris::TimeScale::UTC, {2010, 3, 4});
  struct Pair {
    ephemeris::Planetary target, centre;
  };
  for (const auto& [target, centre] :
       {Pair{moon, earth}, Pair{sun, earth}, Pair{mercury, sun}, Pair{jupiter, mars}}) {
    const double last = 400.0 * 86400.0;
    const ephemeris::EphemerisTable table =
        ephemeris::planetary_table(target, centre, epoch, -86400.0, last, 1e-12);
    const TableOrbit orbit(table.rows, table.order);
    Worst worst;
    double distance = 0.0;
    for (int k = 0; k <= 157; ++k) {
      const double t = -86400.0 + (last + 86400.0) * k / 157.0;
      const Vec3 truth =
          ephemeris::planetary_position(target, centre, ephemeris::date_after(epoch, t));
      worst.add(norm(orbit.position(t) - truth) / norm(truth));
      distance = larger(distance, norm(truth));
    }
    EXPECT_LT(worst.value(), budget::ephemeris_table);
    EXPECT_LT(table.error, budget::ephemeris_table * distance);
    EXPECT_TRUE(orbit.covers(-86400.0, last));
    EXPECT_TRUE(orbit.is_evenly_spaced());
  }
}

ephemeris::Date in_year(double year) { return tdb(51544.5 + 365.25 * (year - 2000.0)); }

// The theory of the planets has the barycentre of Earth and Moon; of other origin than that of the
// Earth, it is no worse in far years.
TEST(Ephemeris, TheEarthIsWhereTheTheoryOfThePlanetsPutsIt) {
  constexpr double share = 1.0 / (1.0 + 81.300569);
  Worst far, near;
  for (int k = 0; k < 3000; ++k) {
    const ephemeris::Date at = in_year(1000.5 + 1999.0 * k / 2999.0);
    double pv[2][3];
    ASSERT_LE(eraPlan94(at.day, at.fraction, 3, pv), 1);
    const Vec3 barycentre{au * pv[0][0], au * pv[0][1], au * pv[0][2]};
    const Vec3 there = barycentre - share * ephemeris::planetary_position(moon, earth, at);
    const Vec3 here = ephemeris::planetary_position(earth, sun, at);
    const double apart = norm(cross(here, there)) / dot(here, here) / arcsec;
    const double year = 1000.5 + 1999.0 * k / 2999.0;
    (year > 1900.0 && year < 2100.0 ? near : far).add(apart);
  }
  EXPECT_LE(near.value(), budget::ephemeris_near_arcsec);
  EXPECT_LE(far.value(), budget::ephemeris_far_arcsec);
}

// JD in TDB, Earth from Sun and Moon from Earth in km: JPL DE406, by jplephem 2.24.
struct Integrated {
  double day;
  Vec3 earth_there;
  Vec3 moon_there;
};
const Integrated de406[] = {{2086545.25,
                             {148714123.133, -20342947.592, -8857764.089},
                             {18453.3334, 326641.6731, 174595.1694}},
                            {2196545.75,
                             {96361131.069, 102971702.908, 44849216.073},
                             {-279202.0519, 223734.0060, 96902.0523}},
                            {2305445.00,
                             {-33135507.071, 131416962.399, 57115904.865},
                             {88334.6949, 322673.1251, 168737.5398}},
                            {2378496.50,
                             {-33662013.991, 131343329.088, 57013854.710},
                             {387373.7993, -44706.4555, -46572.1039}},
                            {2451545.00,
                             {-26499034.227, 132757417.666, 57556717.448},
                             {-291608.3885, -266716.8292, -76102.4813}},
                            {2524593.50,
                             {-19287170.020, 133839660.336, 57956132.729},
                             {-26013.1372, 381261.7252, 132108.8671}},
                            {2597641.50,
                             {-10736263.303, 134710962.157, 58260657.810},
                             {304740.8027, -247230.2446, -95039.0469}},
                            {2707545.25,
                             {84436108.042, 111602637.733, 48159690.421},
                             {-363014.3401, 69737.3463, -4409.7176}},
                            {2816545.75,
                             {-129585682.332, -69687698.273, -29986484.135},
                             {364080.5351, -52920.8487, 5241.2851}}};

TEST(Ephemeris, TheEarthAndTheMoonAreWhereAnIntegrationPutsThem) {
  for (const Integrated& one : de406) {
    const ephemeris::Date at{ephemeris::TimeScale::TDB, one.day, 0.0};
    const Vec3 e = ephemeris::planetary_position(earth, sun, at),
               m = ephemeris::planetary_position(moon, earth, at);
    const auto apart = [](const Vec3& a, const Vec3& b) {
      return norm(cross(a, b)) / dot(b, b) / arcsec;
    };
    EXPECT_LE(apart(e, one.earth_there), ephemeris::planetary_error(earth, sun, at)) << one.day;
    EXPECT_LE(apart(m, one.moon_there), ephemeris::planetary_error(moon, earth, at)) << one.day;
    EXPECT_LE(std::abs(norm(e) - norm(one.earth_there)), budget::ephemeris_far_earth_km) << one.day;
    EXPECT_LE(std::abs(norm(m) - norm(one.moon_there)), budget::ephemeris_far_moon_km) << one.day;
  }
}

TEST(Ephemeris, ErrorsAreThoseOfTheTheories) {
  EXPECT_EQ(ephemeris::best_years(earth, sun).first, 1900);
  EXPECT_EQ(ephemeris::best_years(moon, earth).first, 1950);
  EXPECT_EQ(ephemeris::best_years(mars, sun).first, 1800);
  EXPECT_LT(ephemeris::planetary_error(earth, sun, in_year(2000.0)), 0.1);
  EXPECT_GT(ephemeris::planetary_error(earth, sun, in_year(1000.5)), 0.8);
  EXPECT_GT(ephemeris::planetary_error(moon, earth, in_year(1000.5)),
            ephemeris::planetary_error(moon, earth, in_year(2000.0)));
  EXPECT_GT(ephemeris::planetary_error(jupiter, sun, in_year(2200.0)),
            ephemeris::planetary_error(jupiter, sun, in_year(2000.0)));
  EXPECT_LT(ephemeris::planetary_error(moon, sun, in_year(2000.0)), 0.1);
  EXPECT_TRUE(std::isnan(ephemeris::planetary_error(mars, sun, in_year(900.0))));
}

// Each planet where it is farthest from DE406, from the Sun in km: tools/orbits/far_years.py. What
// is claimed is no less than that, and not much more.
TEST(Ephemeris, ThePlanetsAreAsFarFromAnIntegrationAsIsSaid) {
  struct Row {
    ephemeris::Planetary body;
    double day;
    Vec3 there;
  };
  const Row farthest[] = {{mercury, 2443318.60, {22238584.7, 36743093.8, 17317440.8}},
                          {venus, 2089073.80, {-76976909.8, 66469463.9, 34606315.4}},
                          {mars, 2101795.60, {138591974.5, -139277468.9, -67870405.0}},
                          {jupiter, 2408483.80, {369724915.4, 603830651.6, 249854307.1}},
                          {saturn, 2271274.00, {-1110473790.5, 732927476.8, 349148032.3}},
                          {uranus, 2259298.40, {-2070009235.9, -1719465559.6, -723716056.1}},
                          {neptune, 2102960.40, {4217894482.1, 1384105884.7, 461776878.9}}};
  for (const Row& one : farthest) {
    const ephemeris::Date at{ephemeris::TimeScale::TDB, one.day, 0.0};
    const Vec3 here = ephemeris::planetary_position(one.body, sun, at);
    const double apart = norm(cross(here, one.there)) / dot(one.there, one.there) / arcsec;
    const double said = ephemeris::planetary_error(one.body, sun, at);
    EXPECT_LE(apart, said) << ephemeris::name(one.body);
    EXPECT_GE(apart, said / budget::ephemeris_error_margin) << ephemeris::name(one.body);
  }
}

// Mars was 0.37272 au from the Earth, and 1.3814 au from the Sun, on 2003-08-27 (Astronomical
// Almanac); at the conjunction of 2002-08-10 it was behind the Sun.
TEST(Ephemeris, ErrorsGrowSeenFromNearby) {
  const ephemeris::Date near = tdb(52878.41), far = tdb(52496.9);
  const double from_sun = ephemeris::planetary_error(mars, sun, near);
  EXPECT_NEAR(ephemeris::planetary_error(mars, earth, near) / from_sun, 1.3814 / 0.37272,
              budget::ephemeris_error_growth);
  EXPECT_LT(ephemeris::planetary_error(mars, earth, far), from_sun);
  EXPECT_EQ(ephemeris::planetary_error(mars, earth, near),
            ephemeris::planetary_error(earth, mars, near));
  EXPECT_THROW(ephemeris::planetary_error(mars, mars, near), DomainError);
}

TEST(Ephemeris, DatesOutsideAreRefused) {
  EXPECT_NO_THROW(ephemeris::planetary_position(earth, sun, in_year(1001.0)));
  EXPECT_NO_THROW(ephemeris::planetary_position(moon, earth, in_year(2999.0)));
  EXPECT_THROW(ephemeris::planetary_position(earth, sun, in_year(999.0)), DomainError);
  EXPECT_THROW(ephemeris::planetary_position(moon, earth, in_year(3001.0)), DomainError);
  EXPECT_THROW(ephemeris::planetary_position(mars, sun, tdb(500000.0)), DomainError);
  EXPECT_NO_THROW(ephemeris::planetary_position(mars, sun, tdb(-100000.0)));
  EXPECT_THROW(ephemeris::planetary_position(mars, mars, tdb(50000.0)), DomainError);
  EXPECT_THROW(ephemeris::planetary_table(moon, earth, tdb(50000.0), 1.0, 0.0), DomainError);
  EXPECT_THROW(ephemeris::planetary_table(moon, earth, in_year(2999.0), 0.0, 1e9), DomainError);
}

TEST(Ephemeris, BodiesHaveNames) {
  EXPECT_EQ(ephemeris::planetary("moon"), moon);
  EXPECT_EQ(ephemeris::planetary("pluto"), std::nullopt);
  EXPECT_EQ(name(uranus), "uranus");
  // the mass of the Earth relative to that of the Moon, 81.3
  EXPECT_NEAR(ephemeris::planetary_gm(earth) / ephemeris::planetary_gm(moon), 81.3006,
              budget::ephemeris_gm);
}

}  // namespace
}  // namespace polhode
