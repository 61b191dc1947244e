// SPDX-License-Identifier: MIT
// Dates in the scales of astronomy: leap seconds, TDB, and what is refused.
#include "polhode/ephemeris/date.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"

namespace polhode {
namespace {

using enum ephemeris::TimeScale;
using ::testing::HasSubstr;

double julian(const ephemeris::Date& d) { return d.day + d.fraction; }

TEST(Dates, NoonOfTheFirstDayOf2000IsJ2000) {
  EXPECT_EQ(julian(ephemeris::calendar_date(TT, {2000, 1, 1, 12})), 2451545.0);
  EXPECT_EQ(julian(ephemeris::calendar_date(TDB, {-4712, 1, 1, 12})),
            38.0);  // the Gregorian calendar, prolonged
}

// TAI - UTC was 32 s in 2000 and is 37 s from 2017; TT - TAI is 32.184 s.
TEST(Dates, LeapSecondsStandBetweenUtcAndTt) {
  const auto ahead = [](const ephemeris::CalendarTime& t) {
    return ephemeris::seconds_between(ephemeris::calendar_date(TT, t),
                                      ephemeris::calendar_date(UTC, t));
  };
  EXPECT_NEAR(ahead({2000, 1, 1}), 64.184, budget::date_second);
  EXPECT_NEAR(ahead({2017, 1, 1}), 69.184, budget::date_second);
  EXPECT_NEAR(ahead({2016, 12, 31, 23, 59, 59.5}), 68.184, budget::date_second);
  EXPECT_NEAR(ahead({1972, 1, 1}), 42.184, budget::date_second);
}

TEST(Dates, ALeapSecondIsASecond) {
  const ephemeris::Date before = ephemeris::calendar_date(UTC, {2016, 12, 31, 23, 59, 59.0});
  const ephemeris::Date leap = ephemeris::calendar_date(UTC, {2016, 12, 31, 23, 59, 60.0});
  const ephemeris::Date after_it = ephemeris::calendar_date(UTC, {2017, 1, 1});
  EXPECT_NEAR(ephemeris::seconds_between(before, leap), 1.0, budget::date_second);
  EXPECT_NEAR(ephemeris::seconds_between(leap, after_it), 1.0, budget::date_second);
  const ephemeris::CalendarTime back = ephemeris::calendar_time(ephemeris::converted(
      ephemeris::converted(ephemeris::calendar_date(UTC, {2016, 12, 31, 23, 59, 60.5}), TT), UTC));
  EXPECT_EQ(back.day, 31);
  EXPECT_EQ(back.minute, 59);
  EXPECT_NEAR(back.second, 60.5, budget::date_second);
}

TEST(Dates, WhatIsNoTimeIsRefused) {
  const auto error = [](ephemeris::TimeScale scale, const ephemeris::CalendarTime& t) {
    return test::message_of([&] { ephemeris::calendar_date(scale, t); });
  };
  EXPECT_THAT(error(UTC, {2015, 12, 31, 23, 59, 60.0}), HasSubstr("a 60th second a leap second"));
  EXPECT_THAT(error(TT, {2016, 12, 31, 23, 59, 60.0}), HasSubstr("must be one of the calendar"));
  EXPECT_THAT(error(UTC, {2001, 2, 29}), HasSubstr("2001-02-29 00:00:0"));
  EXPECT_THAT(error(UTC, {2001, 2, 8, 24}), HasSubstr("must be one of the calendar"));
  EXPECT_THAT(error(UTC, {2020, 13, 1}), HasSubstr("calendar, its month 13 from 1 to 12"));
  EXPECT_THAT(error(UTC, {2023, 2, 29}), HasSubstr("calendar, its day 29 from 1 to 28"));
  EXPECT_THAT(error(UTC, {2024, 2, 8, 7, 60}), HasSubstr("calendar, its minute 60 from 0 to 59"));
  EXPECT_EQ(error(UTC, {2016, 12, 31, 23, 59, 60.0}), "");
  EXPECT_THROW(ephemeris::converted({TT, std::nan(""), 0.0}, UTC), DomainError);
  EXPECT_THROW(ephemeris::converted(ephemeris::calendar_date(UT1, {2000, 1, 1}), TT), DomainError);
}

TEST(Dates, ScalesComeBack) {
  for (const ephemeris::TimeScale scale : {UTC, TAI, TT, TDB, UT1}) {
    const ephemeris::Date there = ephemeris::calendar_date(scale, {2024, 7, 3, 4, 5, 6.25});
    for (const ephemeris::TimeScale other : {UTC, TAI, TT, TDB, UT1}) {
      const ephemeris::Date back =
          ephemeris::converted(ephemeris::converted(there, other, 0.3), scale, 0.3);
      EXPECT_EQ(back.scale, scale);
      EXPECT_NEAR((back.day - there.day) + (back.fraction - there.fraction), 0.0,
                  budget::date_second / 86400.0);
    }
  }
  EXPECT_NEAR(ephemeris::seconds_between(ephemeris::calendar_date(UTC, {2024, 7, 3}),
                                         ephemeris::calendar_date(UT1, {2024, 7, 3}), 0.3),
              -0.3, budget::date_second);
}

// Its largest term: 1.657 ms sin g with the mean anomaly of the Earth (Astronomical Almanac); the
// others make some 40 us.
TEST(Dates, TdbKeepsItsYear) {
  for (int k = 0; k < 40; ++k) {
    const ephemeris::Date tt =
        ephemeris::date_after(ephemeris::calendar_date(TT, {2000, 1, 1, 12}), 86400.0 * 20 * k);
    const ephemeris::Date tdb = ephemeris::converted(tt, TDB);
    const double d = 20.0 * k, degree = std::numbers::pi / 180.0;
    const double g = (357.53 + 0.98560028 * d) * degree, L = (246.11 + 0.90251792 * d) * degree;
    EXPECT_NEAR(((tdb.day - tt.day) + (tdb.fraction - tt.fraction)) * 86400.0,
                0.001657 * std::sin(g) + 0.000022 * std::sin(L), budget::date_tdb);
  }
}

TEST(Dates, FarYearsOfUtcAreDubious) {
  EXPECT_TRUE(ephemeris::is_dubious(ephemeris::calendar_date(UTC, {1950, 1, 1})));
  EXPECT_FALSE(ephemeris::is_dubious(ephemeris::calendar_date(UTC, {2010, 1, 1})));
  EXPECT_TRUE(ephemeris::is_dubious(ephemeris::calendar_date(UTC, {2110, 1, 1})));
  EXPECT_FALSE(ephemeris::is_dubious(ephemeris::calendar_date(TT, {2110, 1, 1})));
}

}  // namespace
}  // namespace polhode
