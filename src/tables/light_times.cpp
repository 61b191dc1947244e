// SPDX-License-Identifier: MIT
#include "tables/detail/light_times.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "polhode/error.hpp"
#include "text/date_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double last_julian_date = 5373484.5;  // the end of the year 9999

}  // namespace

LightTimes::LightTimes(TimeScale scale, const std::optional<Date>& epoch, double julian_zero)
    : scale_(scale), julian_zero_(julian_zero), epoch_(epoch) {
  for (const TimeScale given : {scale, epoch ? epoch->scale : scale})
    if (given == TimeScale::UT1)
      throw DomainError(
          "times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC "
          "is observed");
  if (epoch) epoch_in_tt_ = converted(*epoch, TimeScale::TT);
}

double LightTimes::of_julian_date(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  const Date date = julian_date(field, scale_, julian_zero_);
  const double sum = date.day + date.fraction;
  if (!(sum >= 0.0 && sum <= last_julian_date))
    throw DomainError("is no Julian date from 0 to 5373484.5");
  return seconds(date);
}

double LightTimes::of_date(std::string_view field) { return seconds(date_in(field, scale_)); }

double LightTimes::seconds(const Date& date) {
  if (!epoch_) {
    epoch_ = Date{scale_, std::floor(date.day + date.fraction - 0.5) + 0.5, 0.0};
    epoch_in_tt_ = converted(*epoch_, TimeScale::TT);
  }
  return seconds_between(*epoch_in_tt_, date);
}

LightTimes light_times(const std::string& shown, TimeScale scale,
                       const std::optional<Date>& epoch) {
  try {
    return {scale, epoch};
  } catch (const DomainError& error) {
    throw DomainError(shown + ": " + error.what());
  }
}

std::string julian_text(const Date& date) {
  constexpr int decimals = 12;  // 0.1 us
  double whole = std::floor(date.day);
  double part = (date.day - whole) + date.fraction;
  whole += std::floor(part);
  part -= std::floor(part);
  std::array<char, 32> buffer;
  const auto fixed = [&](double x, int places) {
    const std::to_chars_result end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x,
                                                   std::chars_format::fixed, places);
    return std::string(buffer.data(), end.ptr);
  };
  std::string digits = fixed(part, decimals);
  if (digits.front() == '1') whole += 1.0;  // rounded up to the next day
  digits.erase(0, 1);
  digits.erase(std::max<std::size_t>(digits.find_last_not_of('0') + 1, 2));
  if (digits.size() < 2) digits += '0';
  return fixed(whole, 0) + digits;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
