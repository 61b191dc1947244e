// SPDX-License-Identifier: MIT
#include "polhode/ephemeris/date.hpp"

#include <erfa.h>

#include <array>
#include <chrono>
#include <cmath>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ephemeris {
namespace {

constexpr std::array<std::string_view, 5> names = {"UTC", "TAI", "TT", "TDB", "UT1"};
constexpr double day_in_s = 86400.0;
constexpr int nanoseconds = 9;

[[noreturn]] void fail(const char* function, const std::string& what) {
  throw DomainError(std::string(function) + ": " + what);
}

std::string text(const CalendarTime& t) {
  const auto two = [](int x) { return (x < 10 ? "0" : "") + std::to_string(x); };
  return std::to_string(t.year) + "-" + two(t.month) + "-" + two(t.day) + " " + two(t.hour) + ":" +
         two(t.minute) + ":" + polhode::detail::number_text(t.second);
}

// The first of its numbers that no date has: ", its month 13 from 1 to 12".
std::string out_of_range(const CalendarTime& t) {
  const auto named = [](const char* what, int x, int first, int last) {
    return std::string(", its ") + what + " " + std::to_string(x) + " from " +
           std::to_string(first) + " to " + std::to_string(last);
  };
  if (t.month < 1 || t.month > 12) return named("month", t.month, 1, 12);
  const std::chrono::year_month_day_last end{
      std::chrono::year(t.year),
      std::chrono::month_day_last(std::chrono::month(static_cast<unsigned>(t.month)))};
  const int days = static_cast<int>(static_cast<unsigned>(end.day()));
  if (t.day < 1 || t.day > days) return named("day", t.day, 1, days);
  if (t.hour < 0 || t.hour > 23) return named("hour", t.hour, 0, 23);
  if (t.minute < 0 || t.minute > 59) return named("minute", t.minute, 0, 59);
  return {};
}

// ERFA's answers: negative is an error, 1 a dubious year.
void require_there(int status, const Date& date) {
  if (status < 0 || !std::isfinite(date.day + date.fraction))
    fail("converted", "the date " + polhode::detail::number_text(date.day + date.fraction) + " " +
                          std::string(name(date.scale)) + " must be one of the calendar");
}

double offset(std::optional<double> dut1) {
  if (!dut1)
    fail("converted", "UT1 - UTC must be given: it is observed, and no list of it is at hand");
  return *dut1;
}

// TDB - TT at the geocentre; the argument may be either.
double excess(const Date& date) { return eraDtdb(date.day, date.fraction, 0.0, 0.0, 0.0, 0.0); }

Date to_tt(const Date& d, std::optional<double> dut1) {
  Date utc = d, tai = d, tt{TimeScale::TT, d.day, d.fraction};
  switch (d.scale) {
    case TimeScale::TT:
      return d;
    case TimeScale::TDB:
      require_there(eraTdbtt(d.day, d.fraction, excess(d), &tt.day, &tt.fraction), d);
      return tt;
    case TimeScale::UT1:
      require_there(eraUt1utc(d.day, d.fraction, offset(dut1), &utc.day, &utc.fraction), d);
      [[fallthrough]];
    case TimeScale::UTC:
      require_there(eraUtctai(utc.day, utc.fraction, &tai.day, &tai.fraction), d);
      [[fallthrough]];
    case TimeScale::TAI:
      require_there(eraTaitt(tai.day, tai.fraction, &tt.day, &tt.fraction), d);
  }
  return tt;
}

}  // namespace

std::string_view name(TimeScale scale) { return names[static_cast<std::size_t>(scale)]; }

std::optional<TimeScale> time_scale(std::string_view name) {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) return static_cast<TimeScale>(k);
  return std::nullopt;
}

Date calendar_date(TimeScale scale, const CalendarTime& t) {
  Date result{scale, 0.0, 0.0};
  const std::string of_scale(name(scale));
  const int status = eraDtf2d(of_scale.c_str(), t.year, t.month, t.day, t.hour, t.minute, t.second,
                              &result.day, &result.fraction);
  // 2 and 3: a second beyond the end of the day
  if (status < 0 || status >= 2 || !std::isfinite(t.second))
    fail("calendar_date", "the time " + text(t) + " " + of_scale + " must be one of the calendar" +
                              out_of_range(t) +
                              (t.second >= 60.0 ? ", and a 60th second a leap second of UTC" : ""));
  return result;
}

CalendarTime calendar_time(const Date& d) {
  const std::string of_scale(name(d.scale));
  CalendarTime t;
  std::array<int, 4> clock{};
  require_there(eraD2dtf(of_scale.c_str(), nanoseconds, d.day, d.fraction, &t.year, &t.month,
                         &t.day, clock.data()),
                d);
  t.hour = clock[0];
  t.minute = clock[1];
  t.second = clock[2] + 1e-9 * clock[3];
  return t;
}

Date converted(const Date& d, TimeScale scale, std::optional<double> dut1) {
  if (d.scale == scale) return d;
  const Date tt = to_tt(d, dut1);
  Date tai{TimeScale::TAI, 0.0, 0.0}, utc{TimeScale::UTC, 0.0, 0.0}, result{scale, 0.0, 0.0};
  if (scale == TimeScale::TT) return tt;
  if (scale == TimeScale::TDB) {
    require_there(eraTttdb(tt.day, tt.fraction, excess(tt), &result.day, &result.fraction), d);
    return result;
  }
  require_there(eraTttai(tt.day, tt.fraction, &tai.day, &tai.fraction), d);
  if (scale == TimeScale::TAI) return tai;
  require_there(eraTaiutc(tai.day, tai.fraction, &utc.day, &utc.fraction), d);
  if (scale == TimeScale::UTC) return utc;
  require_there(eraUtcut1(utc.day, utc.fraction, offset(dut1), &result.day, &result.fraction), d);
  return result;
}

double seconds_between(const Date& from, const Date& to, std::optional<double> dut1) {
  const Date a = converted(from, TimeScale::TT, dut1), b = converted(to, TimeScale::TT, dut1);
  return ((b.day - a.day) + (b.fraction - a.fraction)) * day_in_s;
}

Date date_after(const Date& date, double seconds, std::optional<double> dut1) {
  Date tt = converted(date, TimeScale::TT, dut1);
  const double days = std::floor(seconds / day_in_s);
  tt.day += days;
  tt.fraction += (seconds - days * day_in_s) / day_in_s;
  return tt;
}

bool is_dubious(const Date& d) {
  if (d.scale != TimeScale::UTC) return false;
  double day = 0.0, fraction = 0.0;
  return eraUtctai(d.day, d.fraction, &day, &fraction) == 1;
}

}  // namespace ephemeris
}  // namespace v0
}  // namespace polhode
