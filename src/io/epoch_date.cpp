// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "io/detail/epoch.hpp"
#include "io/detail/value_access.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// The whole text as a number.
double number_in(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw DomainError("is not a number of days");
  return value;
}

// Digits at the front, as a number; they and one character behind them are taken off.
double taken(std::string_view& text, double otherwise) {
  if (text.empty()) return otherwise;
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const double value = number_in(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return value;
}

}  // namespace

Date date_in(std::string_view text, TimeScale scale) {
  const std::string whole = std::string(text) + " " + std::string(name(scale));
  if (text.ends_with('Z') && scale == TimeScale::UTC) {
    text.remove_suffix(1);
    return date_in(text, scale);
  }
  require_epoch(whole);
  CalendarTime time;
  time.year = static_cast<int>(taken(text, 2000.0));
  time.month = static_cast<int>(taken(text, 1.0));
  time.day = static_cast<int>(taken(text, 1.0));
  time.hour = static_cast<int>(taken(text, 0.0));
  time.minute = static_cast<int>(taken(text, 0.0));
  time.second = taken(text, 0.0);
  return calendar_date(scale, time);
}

// Whole days and their fraction apart: a double of both keeps 40 us.
Date julian_date(std::string_view text, TimeScale scale, double zero) {
  const std::size_t point = text.find('.');
  const bool plain = text.find_first_of("eE-") == std::string_view::npos;
  if (point == std::string_view::npos || !plain || point == 0)
    return {scale, zero, number_in(text)};
  const double whole = number_in(text.substr(0, point));
  const double rest =
      text.size() == point + 1 ? 0.0 : number_in("0" + std::string(text.substr(point)));
  return {scale, zero + whole, rest};
}

Clock clock_of(const Values& values, const Units& units, std::string_view path,
               const std::string& name) {
  if (!there(values, "state.epoch"))
    refuse(values, path, name, "expected a key state.epoch, the date of t = 0");
  std::optional<double> dut1;
  const double second =
      built(values, path, name, [&] { return units.to_core(1.0, "s", Dimension::time); });
  if (there(values, "state.dut1")) dut1 = number(values, "state.dut1") / second;
  const Date epoch = built(values, "state.epoch", name, [&] {
    const Date own = epoch_date(word(values, "state.epoch"));
    if (own.scale == TimeScale::UT1 && !dut1)
      throw DomainError("expected a key state.dut1 beside it: UT1 - UTC, which is observed");
    return converted(own, TimeScale::TT, dut1);
  });
  return {epoch, dut1, second};
}

}  // namespace detail

Date epoch_date(std::string_view text) {
  detail::require_epoch(text);
  const std::size_t space = text.rfind(' ');
  const TimeScale scale = *time_scale(text.substr(space + 1));
  text = text.substr(0, space);
  return text.starts_with("JD ") ? detail::julian_date(text.substr(3), scale)
                                 : detail::date_in(text, scale);
}

}  // namespace v0
}  // namespace polhode
