// SPDX-License-Identifier: MIT
// Dates of a calendar with 86400 s a day: TT, TDB and TAI by plain arithmetic, UTC through its leap
// seconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
