// SPDX-License-Identifier: MIT
// Dates as text: instants in time scales, and calendar dates.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Dates of a calendar with 86400 s a day: TT, TDB and TAI by plain arithmetic, UTC through its leap
// seconds.
struct CivilTime {
  std::int64_t day = 0;   // from 2000-01-01
  std::int64_t nano = 0;  // nanoseconds of the day; beyond 86400 s in a leap second of UTC
  auto operator<=>(const CivilTime&) const = default;
};

// The word of `state.epoch` behind its last blank, "TDB".
std::string_view scale_of_epoch(std::string_view epoch);
// The date of the calendar of such an epoch, to a nanosecond, in its scale.
CivilTime time_of_epoch(std::string_view epoch);

// 2029-04-13T21:46:00.5, 2029-103T21:46:00.5, with or without Z; nothing for any other text. A
// 60th second only where `leap` allows it and UTC had one.
std::optional<CivilTime> civil_time(std::string_view text, bool leap);
// "2029-04-13T21:46:00.000000000": the year has four digits, so it is from 0 to 9999.
std::string civil_text(const CivilTime& time);
bool has_text(const CivilTime& time);

// Elapsed seconds of the scale "TT", "TDB", "TAI", "GPS" or "UTC", and back.
double seconds_between(std::string_view scale, const CivilTime& from, const CivilTime& to);
CivilTime after(std::string_view scale, const CivilTime& from, double seconds);

// Whether a text begins as a date does: "2013-", or "JD ".
bool is_dated(std::string_view text);
// "2013-01-05T00:00:00Z" with its scale as a word: "2013-01-05T00:00:00 UTC". Others as they are.
std::string with_scale(std::string_view text);
// The same with the scale of an epoch where it has none.
std::string with_scale(std::string_view text, std::string_view epoch);

// Each throws DomainError with what is wrong.
// Requires a date with its scale.
void require_epoch(std::string_view text);
// "2013-01-05", "2013-01-05T00:00:00.25", "2013-005T00:00:00.25"; a 60th second only of UTC.
ephemeris::CalendarTime calendar_in(std::string_view text, bool utc);
// The same as an instant; a Z at the end says what UTC says.
ephemeris::Date date_in(std::string_view text, ephemeris::TimeScale scale);
// "2456297.5", to all its digits; `zero` is what 0 stands for. Of UTC a quasi-JD as in Date, in
// which a day that ends in a leap second has 86401 s.
ephemeris::Date julian_date(std::string_view text, ephemeris::TimeScale scale, double zero = 0.0);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
