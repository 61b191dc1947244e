// SPDX-License-Identifier: MIT
#include "text/civil_time.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "polhode/ephemeris/date.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::int64_t nano_per_second = 1'000'000'000;
constexpr std::int64_t nano_per_day = 86400 * nano_per_second;
constexpr double julian_date_2000 = 2451544.5;  // 2000-01-01T00:00
constexpr std::int64_t furthest_day = 4'000'000;
constexpr std::chrono::sys_days origin{std::chrono::year{2000} / 1 / 1};

// The number at the front, of exactly this many digits; -1 for none.
int taken_number(std::string_view& text, std::size_t digits) {
  if (text.size() < digits) return -1;
  int number = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return -1;
    number = 10 * number + (text[i] - '0');
  }
  text.remove_prefix(digits);
  return number;
}

bool taken(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

// 2029-04-13 or, by the number of digits before the T, 2029-103.
std::optional<std::int64_t> taken_day(std::string_view& text) {
  const int year = taken_number(text, 4);
  if (year < 0 || !taken(text, '-')) return std::nullopt;
  const std::chrono::year y{year};
  const std::size_t end = std::min(text.find('T'), text.size());
  if (end == 3) {
    const int number = taken_number(text, 3);
    if (number < 1 || number > (y.is_leap() ? 366 : 365)) return std::nullopt;
    return (std::chrono::sys_days{y / 1 / 1} - origin).count() + number - 1;
  }
  const int month = taken_number(text, 2);
  if (month < 0 || !taken(text, '-')) return std::nullopt;
  const int day = taken_number(text, 2);
  if (day < 0) return std::nullopt;
  const std::chrono::year_month_day date{y, std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return (std::chrono::sys_days{date} - origin).count();
}

// Digits behind the point, rounded to nanoseconds; -1 for no digits.
std::int64_t taken_fraction(std::string_view& text) {
  std::int64_t nano = 0, place = nano_per_second / 10;
  std::size_t i = 0;
  for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i) {
    if (place > 0)
      nano += (text[i] - '0') * place;
    else if (i == 9 && text[i] >= '5')
      ++nano;
    place /= 10;
  }
  if (i == 0) return -1;
  text.remove_prefix(i);
  return nano;
}

// hh:mm, hh:mm:ss, hh:mm:ss.fff
std::optional<std::int64_t> taken_clock(std::string_view& text, bool leap) {
  const int hour = taken_number(text, 2);
  if (hour < 0 || hour > 23 || !taken(text, ':')) return std::nullopt;
  const int minute = taken_number(text, 2);
  if (minute < 0 || minute > 59) return std::nullopt;
  int second = 0;
  std::int64_t nano = 0;
  if (taken(text, ':')) {
    second = taken_number(text, 2);
    const bool sixtieth = leap && hour == 23 && minute == 59 && second == 60;
    if (second < 0 || (second > 59 && !sixtieth)) return std::nullopt;
    if (taken(text, '.') && (nano = taken_fraction(text)) < 0) return std::nullopt;
  }
  return (std::int64_t{hour} * 3600 + minute * 60 + second) * nano_per_second + nano;
}

std::chrono::year_month_day date_of(std::int64_t day) {
  return std::chrono::year_month_day{origin + std::chrono::days{day}};
}

// TAI - UTC at the start of a day; whole seconds from 1972 on.
std::int64_t leap_nano(std::int64_t day) {
  const std::chrono::year_month_day on = date_of(day);
  if (on.year() < std::chrono::year{1972})
    throw DomainError("UTC has whole leap seconds from 1972 on only; expected TT, TDB or TAI");
  const Date utc = polhode::calendar_date(
      TimeScale::UTC, {static_cast<int>(on.year()), static_cast<int>(unsigned{on.month()}),
                       static_cast<int>(unsigned{on.day()})});
  const Date tai = converted(utc, TimeScale::TAI);
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
  std::string_view text = epoch.substr(0, epoch.rfind(' '));
  const bool utc = scale_of_epoch(epoch) == "UTC";
  if (text.starts_with("JD ")) {
    text.remove_prefix(3);
    // days and their fraction apart: together a double would hold them to 40 us
    const std::size_t point = std::min(text.find('.'), text.size());
    double whole = 0.0, part = 0.0;
    std::from_chars(text.data(), text.data() + point, whole);
    std::from_chars(text.data() + point, text.data() + text.size(), part);
    if (text.find_first_not_of("0123456789.") != std::string_view::npos)  // -1.5e3
      std::from_chars(text.data(), text.data() + text.size(), whole), part = 0.0;
    if (!(std::fabs(whole - julian_date_2000) < furthest_day))
      throw DomainError("a date far from our time");
    const double days = std::floor(whole - julian_date_2000);
    const double rest = (whole - julian_date_2000 - days) + part;
    return normalized_time(static_cast<std::int64_t>(days),
                           std::llround(rest * static_cast<double>(nano_per_day)), nano_per_day);
  }
  const std::optional<std::int64_t> day = taken_day(text);
  std::optional<std::int64_t> nano = 0;
  if (!text.empty()) {
    text.remove_prefix(1);
    nano = taken_clock(text, utc);
  }
  if (!day || !nano || !text.empty()) throw DomainError("not a date: " + std::string(epoch));
  return {*day, *nano};
}

std::optional<CivilTime> civil_time(std::string_view text, bool leap) {
  const std::optional<std::int64_t> day = taken_day(text);
  if (!day || !taken(text, 'T')) return std::nullopt;
  const std::optional<std::int64_t> nano = taken_clock(text, leap);
  taken(text, 'Z');
  if (!nano || !text.empty()) return std::nullopt;
  if (*nano >= nano_per_day && !has_leap_second(*day)) return std::nullopt;
  return CivilTime{*day, *nano};
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
}  // namespace v0
}  // namespace polhode
