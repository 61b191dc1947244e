// SPDX-License-Identifier: MIT
// Dates in files, as text and as instants.
#pragma once

#include <string>
#include <string_view>

#include "polhode/text/epoch.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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
CalendarTime calendar_in(std::string_view text, bool utc);
// The same as an instant; a Z at the end says what UTC says.
Date date_in(std::string_view text, TimeScale scale);
// "2456297.5", to all its digits; `zero` is what 0 stands for. Of UTC a quasi-JD as in Date, in
// which a day that ends in a leap second has 86401 s.
Date julian_date(std::string_view text, TimeScale scale, double zero = 0.0);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
