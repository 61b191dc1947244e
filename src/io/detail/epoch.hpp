// SPDX-License-Identifier: MIT
// Dates of files as instants.
#pragma once

#include <optional>
#include <string_view>

#include "io/detail/values.hpp"
#include "polhode/io/epoch.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Each throws DomainError with what is wrong.
// "2013-01-05", "2013-01-05T00:00:00.25"; a Z at the end says what UTC says.
Date date_in(std::string_view text, TimeScale scale);
// "2456297.5", to all its digits; `zero` is what 0 stands for.
Date julian_date(std::string_view text, TimeScale scale, double zero = 0.0);

// When t = 0 of a scenario is, and how long its unit of time.
struct Clock {
  Date epoch;                  // in TT
  std::optional<double> dut1;  // s
  double second;               // in core units of time

  double core_time(const Date& date) const { return seconds_between(epoch, date, dut1) * second; }
};
// Refuses at the place of `path` where the file has no epoch.
Clock clock_of(const Values& values, const Units& units, std::string_view path,
               const std::string& name);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
