// SPDX-License-Identifier: MIT
// Dates as text: epochs and instants in time scales, and calendar dates.
#include "text/dates.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "polhode/ephemeris/date.hpp"
#include "polhode/error.hpp"
#include "polhode/text/units.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

namespace detail {
namespace {

constexpr std::string_view scales[] = {"UTC", "TAI", "TT", "TDB", "UT1"};

// Exactly `digits` digits at the front of text, which are taken off.
std::optional<int> take_number(std::string_view& text, std::size_t digits) {
  if (text.size() < digits) return std::nullopt;
  int number = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    number = 10 * number + (text[i] - '0');
  }
  text.remove_prefix(digits);
  return number;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

// 2013-01-05 or, by the number of digits before the T, 2013-005.
ephemeris::CalendarTime taken_day(std::string_view& text) {
  const auto year = take_number(text, 4);
  const bool dash = take(text, '-');
  const auto refuse = [](const char* what, int x, unsigned last) {
    throw DomainError("there is no such day in the calendar: " + std::string(what) + " " +
                      std::to_string(x) + " must be from 1 to " + std::to_string(last));
  };
  if (year && dash && text.find('T') == 3) {
    const std::chrono::year y(*year);
    const unsigned days = y.is_leap() ? 366 : 365;
    const int number = take_number(text, 3).value_or(0);
    if (number < 1 || number > static_cast<int>(days)) refuse("day", number, days);
    const std::chrono::year_month_day on{std::chrono::sys_days{y / 1 / 1} +
                                         std::chrono::days{number - 1}};
    return {*year, static_cast<int>(unsigned{on.month()}), static_cast<int>(unsigned{on.day()})};
  }
  const auto month = take_number(text, 2);
  const bool second_dash = take(text, '-');
  const auto day = take_number(text, 2);
  if (!year || !dash || !month || !second_dash || !day)
    throw DomainError("it does not start with a date like 2013-01-05");
  if (*month < 1 || *month > 12) refuse("month", *month, 12);
  const std::chrono::month_day_last month_end{std::chrono::month(static_cast<unsigned>(*month))};
  const unsigned days{std::chrono::year_month_day_last(std::chrono::year(*year), month_end).day()};
  if (*day < 1 || *day > static_cast<int>(days)) refuse("day", *day, days);
  return {*year, *month, *day};
}

// hh:mm, hh:mm:ss or hh:mm:ss.fff; a 60th second only where UTC may have one.
void read_clock(ephemeris::CalendarTime& time, std::string_view text, bool utc) {
  const auto hour = take_number(text, 2);
  const bool colon = take(text, ':');
  const auto minute = take_number(text, 2);
  if (!hour || !colon || !minute) throw DomainError("the time of day is not like 18:30:00");
  if (take(text, ':')) {
    std::string_view rest = text;
    if (!take_number(rest, 2)) throw DomainError("the time of day is not like 18:30:00");
    if (take(rest, '.')) {
      const std::size_t end = rest.find_first_not_of("0123456789");
      if (rest.empty() || end == 0) throw DomainError("the seconds end in a point");
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end);
    }
    std::from_chars(text.data(), rest.data(), time.second);
    text = rest;
  }
  if (!text.empty()) throw DomainError("the time of day is not like 18:30:00");
  const bool leap = utc && *hour == 23 && *minute == 59 && time.second < 61.0;
  if (*hour > 23 || *minute > 59 || (time.second >= 60.0 && !leap))
    throw DomainError("there is no such time of day");
  time.hour = *hour;
  time.minute = *minute;
}

void require_julian_date(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw DomainError("after JD there is no number");
}

// The whole text as a number.
double number_in(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw DomainError("is not a number of days");
  return value;
}

// The last word, where it has only letters: "UTC".
std::string_view scale_word(std::string_view text) {
  const std::size_t space = text.rfind(' ');
  if (space == std::string_view::npos) return {};
  const std::string_view word = text.substr(space + 1);
  const bool letter = !word.empty() && (word[0] < '0' || word[0] > '9');
  return letter ? word : std::string_view();
}

}  // namespace

bool is_dated(std::string_view text) {
  if (text.starts_with("JD ")) return true;
  std::string_view rest = text;
  return take_number(rest, 4) && rest.starts_with('-');
}

std::string with_scale(std::string_view text) {
  if (!is_dated(text) || text.starts_with("JD ") || !text.ends_with('Z')) return std::string(text);
  return std::string(text.substr(0, text.size() - 1)) + " UTC";
}

std::string with_scale(std::string_view text, std::string_view epoch) {
  std::string whole = with_scale(text);
  if (scale_word(whole).empty()) whole += " " + std::string(scale_word(epoch));
  return whole;
}

void require_epoch(std::string_view text) {
  const std::size_t space = text.rfind(' ');
  if (space == std::string_view::npos) throw DomainError("the time scale is missing");
  const std::string_view scale = text.substr(space + 1);
  const bool known = std::find(std::begin(scales), std::end(scales), scale) != std::end(scales);
  if (!known) {
    const std::string_view near = nearest(scale, scales);
    throw DomainError("\"" + printable(scale) + "\" is not a time scale" +
                      (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
  }
  text = text.substr(0, space);
  if (text.starts_with("JD ")) {
    require_julian_date(text.substr(3));
    return;
  }
  calendar_in(text, scale == "UTC");
}

ephemeris::CalendarTime calendar_in(std::string_view text, bool utc) {
  ephemeris::CalendarTime time = taken_day(text);
  if (text.empty()) return time;  // midnight
  if (!take(text, 'T') && !take(text, ' '))
    throw DomainError("between date and time there is no T");
  read_clock(time, text, utc);
  return time;
}

ephemeris::Date date_in(std::string_view text, ephemeris::TimeScale scale) {
  const bool utc = scale == ephemeris::TimeScale::UTC;
  if (utc && text.ends_with('Z')) text.remove_suffix(1);
  return ephemeris::calendar_date(scale, calendar_in(text, utc));
}

// Whole days and their fraction apart: a double of both keeps 40 us.
ephemeris::Date julian_date(std::string_view text, ephemeris::TimeScale scale, double zero) {
  const std::size_t point = text.find('.');
  const bool plain = text.find_first_of("eE-") == std::string_view::npos;
  if (point == std::string_view::npos || !plain || point == 0)
    return {scale, zero, number_in(text)};
  const double whole = number_in(text.substr(0, point));
  const double rest =
      text.size() == point + 1 ? 0.0 : number_in("0" + std::string(text.substr(point)));
  return {scale, zero + whole, rest};
}

}  // namespace detail

ephemeris::Date epoch_date(std::string_view given) {
  const std::string whole = detail::with_scale(given);
  std::string_view text = whole;
  detail::require_epoch(text);
  const std::size_t space = text.rfind(' ');
  const ephemeris::TimeScale scale = *ephemeris::time_scale(text.substr(space + 1));
  text = text.substr(0, space);
  return text.starts_with("JD ") ? detail::julian_date(text.substr(3), scale)
                                 : detail::date_in(text, scale);
}

namespace detail {

namespace {

constexpr std::int64_t nano_per_second = 1'000'000'000;
constexpr std::int64_t nano_per_day = 86400 * nano_per_second;
constexpr std::int64_t furthest_day = 4'000'000;
constexpr std::chrono::sys_days origin{std::chrono::year{2000} / 1 / 1};

CivilTime civil_of(const ephemeris::CalendarTime& t) {
  const std::chrono::sys_days on{std::chrono::year(t.year) /
                                 std::chrono::month(static_cast<unsigned>(t.month)) /
                                 std::chrono::day(static_cast<unsigned>(t.day))};
  return {(on - origin).count(),
          (std::int64_t{t.hour} * 3600 + std::int64_t{t.minute} * 60) * nano_per_second +
              std::llround(t.second * static_cast<double>(nano_per_second))};
}

std::chrono::year_month_day date_of(std::int64_t day) {
  return std::chrono::year_month_day{origin + std::chrono::days{day}};
}

// TAI - UTC at the start of a day; whole seconds from 1972 on.
std::int64_t leap_nano(std::int64_t day) {
  const std::chrono::year_month_day on = date_of(day);
  if (on.year() < std::chrono::year{1972})
    throw DomainError("UTC has whole leap seconds from 1972 on only; expected TT, TDB or TAI");
  const ephemeris::Date utc =
      ephemeris::calendar_date(ephemeris::TimeScale::UTC,
                               {static_cast<int>(on.year()), static_cast<int>(unsigned{on.month()}),
                                static_cast<int>(unsigned{on.day()})});
  const ephemeris::Date tai = ephemeris::converted(utc, ephemeris::TimeScale::TAI);
  const double days = (tai.day - utc.day) + (tai.fraction - utc.fraction);
  return std::llround(86400.0 * days) * nano_per_second;
}

std::int64_t offset(std::string_view scale, std::int64_t day) {
  return scale == "UTC" ? leap_nano(day) : 0;
}

// UTC had a 60th second at the end of this day.
bool has_leap_second(std::int64_t day) {
  constexpr std::int64_t day_1972 = -10227;
  return day >= day_1972 && leap_nano(day + 1) - leap_nano(day) == nano_per_second;
}

CivilTime normalized_time(std::int64_t day, std::int64_t nano, std::int64_t length) {
  while (nano < 0) nano += nano_per_day, --day;
  while (nano >= length) nano -= nano_per_day, ++day;
  return {day, nano};
}

}  // namespace

std::string_view scale_of_epoch(std::string_view epoch) {
  return epoch.substr(epoch.rfind(' ') + 1);
}

CivilTime time_of_epoch(std::string_view epoch) {
  return civil_of(ephemeris::calendar_time(epoch_date(epoch)));
}

std::optional<CivilTime> civil_time(std::string_view text, bool leap) {
  if (text.ends_with('Z')) text.remove_suffix(1);
  if (text.find('T') == std::string_view::npos) return std::nullopt;
  try {
    const CivilTime time = civil_of(calendar_in(text, leap));
    if (time.nano >= nano_per_day && !has_leap_second(time.day)) return std::nullopt;
    return time;
  } catch (const DomainError&) {
    return std::nullopt;
  }
}

bool has_text(const CivilTime& time) {
  if (time.day < -furthest_day || time.day > furthest_day) return false;
  const int year{date_of(time.day).year()};
  return year >= 0 && year <= 9999;
}

std::string civil_text(const CivilTime& time) {
  const std::chrono::year_month_day date = date_of(time.day);
  std::int64_t second = time.nano / nano_per_second;
  const bool sixtieth = second >= 86400;  // 23:59:60
  if (sixtieth) second -= 1;
  std::array<char, 64> text{};
  const int length =
      std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%09lld",
                    static_cast<int>(date.year()), unsigned{date.month()}, unsigned{date.day()},
                    static_cast<int>(second / 3600), static_cast<int>(second / 60 % 60),
                    static_cast<int>(second % 60) + (sixtieth ? 1 : 0),
                    static_cast<long long>(time.nano % nano_per_second));
  return {text.data(), static_cast<std::size_t>(length)};
}

double seconds_between(std::string_view scale, const CivilTime& from, const CivilTime& to) {
  const std::int64_t nano =
      (to.nano + offset(scale, to.day)) - (from.nano + offset(scale, from.day));
  const std::int64_t whole = nano / nano_per_second;
  return static_cast<double>((to.day - from.day) * 86400 + whole) +
         static_cast<double>(nano - whole * nano_per_second) / static_cast<double>(nano_per_second);
}

CivilTime after(std::string_view scale, const CivilTime& from, double seconds) {
  if (!(std::fabs(seconds) < static_cast<double>(furthest_day) * 86400.0))
    throw DomainError("a date far from our time");
  const double days = std::floor(seconds / 86400.0);
  const double rest = seconds - 86400.0 * days;
  const std::int64_t atomic = from.nano + offset(scale, from.day) +
                              std::llround(rest * static_cast<double>(nano_per_second));
  const CivilTime plain =
      normalized_time(from.day + static_cast<std::int64_t>(days), atomic, nano_per_day);
  if (scale != "UTC") return plain;
  // TAI on that day; UTC may still be the day before, whose last second may be the 60th
  std::int64_t day = plain.day, nano = plain.nano - leap_nano(day);
  if (nano >= 0) return {day, nano};
  --day;
  return {day, plain.nano + nano_per_day - leap_nano(day)};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
