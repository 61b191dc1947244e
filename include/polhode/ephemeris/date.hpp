// SPDX-License-Identifier: MIT
// Date: an instant in one of the time scales of astronomy, and the change from scale to scale.
//
// Equations   TAI = UTC + leap seconds (before 1972 a drifting offset), TT = TAI + 32.184 s, TDB =
//             TT + the 787 terms of Fairhead and Bretagnon (1990) at the geocentre, UT1 = UTC +
//             dut1; all by ERFA.
// Units       days; `seconds_between` gives SI seconds of TT.
// Domain      UTC from 1960; a day that ends in a leap second has 86401 s, and 23:59:60 is a time
//             of it. UT1 needs dut1 = UT1 - UTC in s, which is observed. Gregorian calendar, years
//             -4799 to 9999.
// Accuracy    two parts hold an instant to 1e-11 s. TDB - TT: some microseconds.
// Errors      DomainError for a day or time that is not there, UT1 without dut1.
// Cost        0.1 us; to and from TDB 8 us (benchmarks/ephemeris.cpp).
#pragma once

#include <optional>
#include <string_view>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace ephemeris {

enum class TimeScale { UTC, TAI, TT, TDB, UT1 };
std::string_view name(TimeScale scale);
std::optional<TimeScale> time_scale(std::string_view name);

// A Julian date in two parts, whose sum it is; of UTC the quasi-JD of ERFA, in which the day of a
// leap second is stretched.
struct Date {
  TimeScale scale = TimeScale::TT;
  double day = 2451545.0;
  double fraction = 0.0;

  constexpr bool operator==(const Date&) const = default;
};

struct CalendarTime {
  int year = 2000;
  int month = 1;
  int day = 1;
  int hour = 0;
  int minute = 0;
  double second = 0.0;

  constexpr bool operator==(const CalendarTime&) const = default;
};

Date calendar_date(TimeScale scale, const CalendarTime& time);
CalendarTime calendar_time(const Date& date);

// dut1 = UT1 - UTC in s, for UT1 alone.
Date converted(const Date& date, TimeScale scale, std::optional<double> dut1 = std::nullopt);
// From `from` to `to`, in TT.
double seconds_between(const Date& from, const Date& to, std::optional<double> dut1 = std::nullopt);
// `seconds` of TT after a date, in TT.
Date date_after(const Date& date, double seconds, std::optional<double> dut1 = std::nullopt);

// Whether the leap seconds of a UTC date are a guess: before 1960, or so long after the list of
// leap seconds was made that more may have come.
bool is_dubious(const Date& date);

}  // namespace ephemeris
}  // namespace v0
}  // namespace polhode
