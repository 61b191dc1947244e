// SPDX-License-Identifier: MIT
// When t = 0 of a scenario is, and how long its unit of time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "polhode/ephemeris/date.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct Clock {
  ephemeris::Date epoch;       // in TT
  std::optional<double> dut1;  // s
  double second;               // in core units of time

  double core_time(const ephemeris::Date& date) const {
    return ephemeris::seconds_between(epoch, date, dut1) * second;
  }
};
// Refuses at the place of `path` where the file has no epoch.
Clock clock_of(const FileValues& file, std::string_view path);
// The core time of a date as text, in the scale of the epoch where it has none. DomainError where
// there is no epoch, and for what is no date.
double time_of_date(const FileValues& file, const std::string& date);
// A core time for messages: "t = 1234.5 d", and where the file has an epoch the date to a minute,
// "t = 1234.5 d, 2031-05-01T12:34 TT".
std::string time_and_date(const FileValues& file, double t);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
