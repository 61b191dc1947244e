// SPDX-License-Identifier: MIT
// Positions of Sun, Moon and planets: against the values that ERFA's own tests state, against low
// precision formulas of other origin, and their tables.
#include "polhode/ephemeris/ephemeris.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "polhode/error.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using enum Planetary;
using polhode::test::larger;
using polhode::test::Worst;

constexpr double au = 149597870.7;
constexpr double degree = std::numbers::pi / 180.0;

Date tdb(double mjd) { return {TimeScale::TDB, 2400000.5, mjd}; }

// t_epv00, t_plan94 of ERFA's t_erfa_c.c
TEST(Ephemeris, IsThatOfErfa) {
  const Vec3 earth_there{-0.7757238809297706813, 0.5598052241363340596, 0.2426998466481686993};
  EXPECT_LT(norm((1.0 / au) * planetary_position(earth, sun, tdb(53411.52501161)) - earth_there),
            budget::ephemeris_stated);
  const Vec3 mercury_there{0.2945293959257430832, -0.2452204176601049596, -0.1615427700571978153};
  EXPECT_LT(norm((1.0 / au) * planetary_position(mercury, sun, tdb(43999.9)) - mercury_there),
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
    const Vec3 x = planetary_position(sun, earth, tdb(51544.5 + n));
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
    const Vec3 x = planetary_position(moon, earth, tdb(51544.5 + 36525.0 * T));
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
  const Date at = tdb(58000.25);
  const Vec3 around = planetary_position(moon, earth, at) + planetary_position(earth, sun, at) +
                      planetary_position(sun, jupiter, at) + planetary_position(jupiter, moon, at);
  EXPECT_LT(norm(around), budget::ephemeris_rounding_km);
  EXPECT_EQ(planetary_position(earth, moon, at), -planetary_position(moon, earth, at));
}

TEST(Ephemeris, TablesHoldPositionsBetweenRows) {
  const Date epoch = calendar_date(TimeScale::UTC, {2010, 3, 4});
  struct Pair {
    Planetary target, centre;
  };
  for (const auto& [target, centre] :
       {Pair{moon, earth}, Pair{sun, earth}, Pair{mercury, sun}, Pair{jupiter, mars}}) {
    const double last = 400.0 * 86400.0;
    const EphemerisTable table = planetary_table(target, centre, epoch, -86400.0, last, 1e-12);
    const TableOrbit orbit(table.rows, table.order);
    Worst worst;
    double distance = 0.0;
    for (int k = 0; k <= 157; ++k) {
      const double t = -86400.0 + (last + 86400.0) * k / 157.0;
      const Vec3 truth = planetary_position(target, centre, date_after(epoch, t));
      worst.add(norm(orbit.position(t) - truth) / norm(truth));
      distance = larger(distance, norm(truth));
    }
    EXPECT_LT(worst.value(), budget::ephemeris_table);
    EXPECT_LT(table.error, budget::ephemeris_table * distance);
    EXPECT_TRUE(orbit.covers(-86400.0, last));
    EXPECT_TRUE(orbit.is_evenly_spaced());
  }
}

TEST(Ephemeris, DatesOutsideAreRefused) {
  EXPECT_THROW(planetary_position(earth, sun, tdb(-100000.0)), DomainError);
  EXPECT_THROW(planetary_position(moon, earth, tdb(100000.0)), DomainError);
  EXPECT_THROW(planetary_position(mars, sun, tdb(500000.0)), DomainError);
  EXPECT_NO_THROW(planetary_position(mars, sun, tdb(-100000.0)));
  EXPECT_THROW(planetary_position(mars, mars, tdb(50000.0)), DomainError);
  EXPECT_THROW(planetary_table(moon, earth, tdb(50000.0), 1.0, 0.0), DomainError);
  EXPECT_THROW(planetary_table(moon, earth, tdb(88000.0), 0.0, 1e9), DomainError);
}

TEST(Ephemeris, BodiesHaveNames) {
  EXPECT_EQ(planetary("moon"), moon);
  EXPECT_EQ(planetary("pluto"), std::nullopt);
  EXPECT_EQ(name(uranus), "uranus");
  // the mass of the Earth relative to that of the Moon, 81.3
  EXPECT_NEAR(planetary_gm(earth) / planetary_gm(moon), 81.3006, budget::ephemeris_gm);
}

}  // namespace
}  // namespace polhode
