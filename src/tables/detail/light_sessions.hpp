// SPDX-License-Identifier: MIT
// What readers of light curves share: magnitudes become fluxes, what a file may hold, and dates.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "polhode/ephemeris/date.hpp"
#include "polhode/tables/light_curve_file.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

constexpr std::size_t largest_light_file = std::size_t{256} << 20;

// DomainError for more bytes than that.
void require_size(std::string_view text, const std::string& shown);
// A magnitude beyond 100 is none: the reason, or nothing.
std::string magnitude_flaw(double magnitude);
// Points that hold magnitudes and their errors get fluxes in their place. Relative ones have the
// mean 1 then.
void take_magnitudes(LightSession& session);

// Dates of a light curve as seconds of TT from an epoch, and as Julian dates.
class LightTimes {
 public:
  // Without an epoch: midnight before the first date that comes. Throws DomainError with the reason
  // alone, as all of its functions do.
  LightTimes(ephemeris::TimeScale scale, const std::optional<ephemeris::Date>& epoch,
             double julian_zero = 0.0);

  double of_julian_date(std::string_view field);
  double of_date(std::string_view field);
  // None before the first date.
  const std::optional<ephemeris::Date>& epoch() const { return epoch_; }

 private:
  double seconds(const ephemeris::Date& date);

  ephemeris::TimeScale scale_;
  double julian_zero_;
  std::optional<ephemeris::Date> epoch_;
  std::optional<ephemeris::Date> epoch_in_tt_;
};

// The same for a file: the reason comes behind its name.
LightTimes light_times(const std::string& shown, ephemeris::TimeScale scale,
                       const std::optional<ephemeris::Date>& epoch);

// The Julian date in the scale of a date, with 12 decimals, of which zeros at the end are left out.
std::string julian_text(const ephemeris::Date& date);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
