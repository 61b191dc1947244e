// SPDX-License-Identifier: MIT
#include "text/civil_time.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "polhode/ephemeris/date.hpp"
#include "polhode/error.hpp"
#include "polhode/text/epoch.hpp"
#include "text/date_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::int64_t nano_per_second = 1'000'000'000;
constexpr std::int64_t nano_per_day = 86400 * nano_per_second;
constexpr std::int64_t furthest_day = 4'000'000;
constexpr std::chrono::sys_days origin{std::chrono::year{2000} / 1 / 1};

CivilTime civil_of(const CalendarTime& t) {
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
  return civil_of(calendar_time(epoch_date(epoch)));
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
}  // namespace v0
}  // namespace polhode
