// SPDX-License-Identifier: MIT
// Dates of a light curve as seconds of TT from an epoch, and as Julian dates.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "polhode/ephemeris/date.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class LightTimes {
 public:
  // Without an epoch: midnight before the first date that comes. Throws DomainError with the reason
  // alone, as all of its functions do.
  LightTimes(TimeScale scale, const std::optional<Date>& epoch, double julian_zero = 0.0);

  double of_julian_date(std::string_view field);
  double of_date(std::string_view field);
  // None before the first date.
  const std::optional<Date>& epoch() const { return epoch_; }

 private:
  double seconds(const Date& date);

  TimeScale scale_;
  double julian_zero_;
  std::optional<Date> epoch_;
  std::optional<Date> epoch_in_tt_;
};

// The same for a file: the reason comes behind its name.
LightTimes light_times(const std::string& shown, TimeScale scale, const std::optional<Date>& epoch);

// The Julian date in the scale of a date, with 12 decimals, of which zeros at the end are left out.
std::string julian_text(const Date& date);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
