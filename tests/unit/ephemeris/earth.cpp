// SPDX-License-Identifier: MIT
// The Earth's orientation and dipole at a date. Oracles: the Earth rotation angle of the IAU 2000,
// rows of the IGRF-14, precession of the pole.
#include "polhode/ephemeris/earth.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "message_of.hpp"

namespace {

using namespace polhode;
using ::testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;

TEST(Earth, TurnsByTheEarthRotationAngle) {
  for (const int year : {1975, 2000, 2013, 2024}) {
    const Date utc = calendar_date(TimeScale::UTC, {year, 5, 7, 10, 57, 14.5});
    const Mat3 R = j2000_from_earth(utc, 0.0);
    const Date ut1 = converted(utc, TimeScale::UT1, 0.0);
    const double days = (ut1.day - 2451545.0) + ut1.fraction;
    const double angle = 360.0 * (0.7790572732640 + 1.00273781191135448 * days);
    // of Greenwich on the equator of J2000, from which that of date is 0.006 deg a year
    EXPECT_NEAR(std::remainder(std::atan2(R(1, 0), R(0, 0)) / degree - angle, 360.0), 0.0,
                budget::earth_meridian_deg)
        << year;
    // the pole: general precession, 20.04" a year towards the equinox, and nutation of 9"
    const double years = days / 365.25;
    EXPECT_NEAR(R(0, 2) * 3600.0 / degree, 20.04 * years, budget::earth_pole_arcsec) << year;
    EXPECT_NEAR(R(1, 2) * 3600.0 / degree, 0.0, budget::earth_pole_arcsec) << year;
    EXPECT_NEAR(norm(Vec3{R(0, 0), R(1, 0), R(2, 0)}), 1.0, budget::earth_rotation);
  }
}

// IGRF-14 as published; between its epochs linear: DGRF 2010 and 2015 at the middle of 2012.
TEST(Earth, DipoleIsThatOfTheIgrf) {
  const auto at = [](int year, int month, int day) {
    return igrf_dipole(calendar_date(TimeScale::TT, {year, month, day}));
  };
  const Vec3 of_2020 = at(2020, 1, 1);
  EXPECT_NEAR(of_2020.x, -29403.41, budget::igrf_nT);
  EXPECT_NEAR(of_2020.y, -1451.37, budget::igrf_nT);
  EXPECT_NEAR(of_2020.z, 4653.35, budget::igrf_nT);
  EXPECT_NEAR(at(2012, 7, 1).x, 0.5 * (-29496.57 - 29441.46), budget::igrf_nT);
  EXPECT_NEAR(at(1900, 1, 2).z, 5922.0, budget::igrf_nT);
  EXPECT_NEAR(at(2029, 12, 30).y, -1360.3, budget::igrf_nT);
  EXPECT_REJECTED(at(1899, 12, 1), "must be from 1900 to 2030, which the IGRF-14 covers");
  EXPECT_REJECTED(at(2030, 2, 1), "the year 2030.08");
}

}  // namespace
