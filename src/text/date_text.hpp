// SPDX-License-Identifier: MIT
// Dates in files, as text and as instants.
#pragma once

#include <string_view>

#include "polhode/text/epoch.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Each throws DomainError with what is wrong.
// Requires a date with its scale.
void require_epoch(std::string_view text);
// "2013-01-05", "2013-01-05T00:00:00.25"; a Z at the end says what UTC says.
Date date_in(std::string_view text, TimeScale scale);
// "2456297.5", to all its digits; `zero` is what 0 stands for.
Date julian_date(std::string_view text, TimeScale scale, double zero = 0.0);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
